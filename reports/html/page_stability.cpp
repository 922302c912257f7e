// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_stability.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "reports/html/page_runs.hpp"

namespace sphverify::page {

namespace {

// Numbers that a page may hold of eigenvalues, as of its other curves.
constexpr std::size_t most_spectrum_numbers = 60000;

/// The largest real part: the replicate that grows most is the one to look at.
double growth(RunRecord const& run) {
  double largest = -INFINITY;
  for (auto const& lambda : run.spectrum) {
    if (!lambda.empty()) largest = std::max(largest, lambda[0]);
  }
  return largest;
}

/// How many of a run's modes grow: the document has these first. Of a large operator the outermost modes
/// alone are known, and not how many others grow; but if any does, so does the first. Empty where not even
/// that is known.
std::optional<std::size_t> growing_modes(RunRecord const& run) {
  if (!run.stability || (!run.stability->growing_modes && !run.stability->worst_mode)) return std::nullopt;
  return run.stability->growing_modes.value_or(1);
}

/// Which modes to draw: those that grow first, each part by falling growth, thinned out so that the first and
/// the last stay.
/// @param growths of all modes of the run, in the order of the document
/// @param growing how many of them grow
std::vector<std::size_t> modes_to_draw(std::vector<double> const& growths, std::size_t growing,
                                       std::size_t points) {
  std::vector<std::size_t> order(growths.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if ((a < growing) != (b < growing)) return a < growing;
    return growths[a] > growths[b];
  });
  std::vector<std::size_t> kept;
  for (std::size_t const k : spread_evenly(order.size(), points)) kept.push_back(order[k]);
  return kept;
}

/// How many of the modes that were kept grow; null where that is not known.
Json growing_among(std::vector<std::size_t> const& kept, std::optional<std::size_t> const& growing) {
  if (!growing) return nullptr;
  return std::count_if(kept.begin(), kept.end(), [&](std::size_t k) { return k < *growing; });
}

/// [growth, frequency, wavelength, share near walls, centre], in the units of the document.
Json mode_json(Mode const& mode) {
  return {number(mode.growth), number(mode.frequency), number(mode.wavelength), number(mode.wall_share),
          numbers(mode.centre)};
}

double abscissa(RunRecord const& run) { return run.stability->spectral_abscissa.value_or(-INFINITY); }

/// [size, time, place]
Json breach_json(Breach const& breach) {
  return {number(breach.size), number(breach.time), numbers(breach.position)};
}

}  // namespace

Json spectra_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return !run.spectrum.empty(); }, growth);
  std::size_t const points = points_each(most_spectrum_numbers / share, 2 * chosen.size());
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    auto spectrum = results.runs[index].spectrum;
    std::erase_if(spectrum, [](auto const& lambda) { return lambda.size() != 2; });
    std::vector<double> growths;
    for (auto const& lambda : spectrum) growths.push_back(lambda[0]);
    auto const growing = growing_modes(results.runs[index]);
    auto const kept = modes_to_draw(growths, growing.value_or(0), points);
    list.push_back({{"series", series},
                    {"run", index},
                    {"modes", spectrum.size()},
                    {"growing", growing_among(kept, growing)},
                    {"real", picked(spectrum, 0, kept)},
                    {"imaginary", picked(spectrum, 1, kept)}});
  }
  return list;
}

Json stabilities_json(Results const& results, Dictionary& word) {
  auto const is_told = [](RunRecord const& run) {
    return run.stability && (run.stability->worst_mode || !run.stability->stable_steps.empty());
  };
  auto const is_explained = [](RunRecord const& run) {
    return run.stability && !run.stability->remark.empty();
  };
  Json list = Json::array();
  for (Series const& one : results.series) {
    auto chosen = finest_runs(results, one, is_told);
    if (chosen.empty()) chosen = finest_runs(results, one, is_explained);
    for (std::size_t const index : chosen) {
      Stability const& s = *results.runs[index].stability;
      Json steps = Json::array();
      for (auto const& [method, step] : s.stable_steps) {
        steps.push_back(
            {word(method), number(step.theory), number(step.measured), word.or_null(step.remark)});
      }
      // Of a large operator it is not known how many modes grow: a worst one without their number does.
      bool const grows = s.growing_modes ? *s.growing_modes > 0 : s.worst_mode.has_value();
      list.push_back({{"run", index},
                      {"grows", grows},
                      {"growing", s.growing_modes ? Json(*s.growing_modes) : Json(nullptr)},
                      {"unseen", s.unseen_modes ? Json(*s.unseen_modes) : Json(nullptr)},
                      {"method", word.or_null(s.method)},
                      {"remark", word.or_null(s.remark)},
                      {"worst", s.worst_mode ? mode_json(*s.worst_mode) : Json(nullptr)},
                      {"steps", std::move(steps)}});
    }
  }
  return list;
}

Json perturbations_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return run.stability && !run.stability->modes.empty(); }, abscissa);
  std::size_t const points = points_each(most_spectrum_numbers / share, 3 * chosen.size());
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    Stability const& s = *results.runs[index].stability;
    auto const growing = growing_modes(results.runs[index]);
    std::size_t growing_and_drawn = 0;
    std::vector<Mode const*> modes;
    for (std::size_t k = 0; k < s.modes.size(); ++k) {
      if (!(s.modes[k].frequency >= 0.0) || s.modes[k].centre.empty()) continue;
      modes.push_back(&s.modes[k]);
      if (k < growing.value_or(0)) ++growing_and_drawn;
    }
    auto const still =
        std::count_if(s.modes.begin(), s.modes.end(), [](Mode const& mode) { return mode.centre.empty(); });
    Json json = {{"series", series},
                 {"run", index},
                 {"modes", s.modes.size()},
                 {"still", still},
                 {"wavelength", Json::array()},
                 {"growth", Json::array()},
                 {"frequency", Json::array()}};
    std::vector<double> growths;
    for (Mode const* mode : modes) growths.push_back(mode->growth);
    auto const kept = modes_to_draw(growths, growing_and_drawn, points);
    for (std::size_t const k : kept) {
      json["wavelength"].push_back(number(modes[k]->wavelength));
      json["growth"].push_back(number(modes[k]->growth));
      json["frequency"].push_back(number(modes[k]->frequency));
    }
    json["growing"] = growing_among(kept, growing ? std::optional(growing_and_drawn) : std::nullopt);
    list.push_back(std::move(json));
  }
  return list;
}

Json second_laws_json(Results const& results, Dictionary& word) {
  Json list = Json::array();
  for (Series const& one : results.series) {
    for (std::size_t const index :
         finest_runs(results, one, [](RunRecord const& run) { return run.second_law.has_value(); })) {
      SecondLaw const& s = *results.runs[index].second_law;
      list.push_back({{"run", index},
                      {"overshoot", breach_json(s.overshoot)},
                      {"undershoot", breach_json(s.undershoot)},
                      {"cold_to_hot", breach_json(s.cold_to_hot)},
                      {"entropy", number(s.smallest_entropy_production)},
                      {"remark", word.or_null(s.remark)}});
    }
  }
  return list;
}

}  // namespace sphverify::page
