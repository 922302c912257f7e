#include "reports/html/page_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>

#include "reports/mean_time.hpp"
#include "reports/norm_of.hpp"
#include "reports/table/series_row.hpp"
#include "reports/table/time_ratio.hpp"

namespace sphverify {

namespace {

// Numbers that a page may hold of each kind; with about 7 bytes each they leave room for the rest.
constexpr std::size_t most_profile_numbers = 120000;
constexpr std::size_t most_history_numbers = 40000;
constexpr std::size_t most_spectrum_numbers = 60000;
constexpr std::size_t fewest_points = 16;

/// Five digits are more than a plot can show.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}
Json number(Number const& value) { return value ? number(*value) : Json(nullptr); }

/// Words that occur often are written once and then named by their number.
class Dictionary {
 public:
  Json operator()(std::string const& word) {
    auto const [place, is_new] = numbers_.try_emplace(word, numbers_.size());
    if (is_new) words_.push_back(word);
    return place->second;
  }
  Json const& words() const { return words_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  Json words_ = Json::array();
};

/// `count` indices spread evenly over [0, size), the first and the last among them.
std::vector<std::size_t> spread_evenly(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices;
  if (size <= count) {
    for (std::size_t i = 0; i < size; ++i) indices.push_back(i);
    return indices;
  }
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * (size - 1) / (count - 1));
  return indices;
}

Json picked(std::vector<double> const& values, std::vector<std::size_t> const& indices) {
  Json list = Json::array();
  for (std::size_t const i : indices) list.push_back(i < values.size() ? number(values[i]) : Json(nullptr));
  return list;
}

/// Component k of every particle; null where there is none.
Json picked(std::vector<std::vector<double>> const& values, std::size_t k,
            std::vector<std::size_t> const& indices) {
  Json list = Json::array();
  for (std::size_t const i : indices) {
    bool const exists = i < values.size() && k < values[i].size();
    list.push_back(exists ? number(values[i][k]) : Json(nullptr));
  }
  return list;
}

std::string layout_text(LayoutChoice const& layout) {
  return layout.id == "jittered" ? fmt::format("jittered {:g}", layout.amplitude) : layout.id;
}

std::string viscosity_text(ViscosityChoice const& v) {
  return v == ViscosityChoice{} ? "off" : fmt::format("{:g}, {:g}", v.alpha, v.beta);
}

/// The settings beside the formulation, in the order in which the page names them.
Json settings_json(Discretisation const& d, double smoothing_exponent, Dictionary& word) {
  return {{"density", word(d.density)},
          {"closure", word(d.closure)},
          {"face weight", word(d.face_weight)},
          {"layout", word(layout_text(d.layout))},
          {"h/dx", word(fmt::format("{:g}", d.smoothing_ratio))},
          {"refinement",
           word(smoothing_exponent == 0.0 ? "h/dx fixed" : fmt::format("h/dx ~ N^{:g}", smoothing_exponent))},
          {"smoothing", word(d.smoothing)},
          {"viscosity", word(viscosity_text(d.viscosity))},
          {"wall motion", word(d.wall_motion)},
          {"integrator", word(d.integrator)},
          {"kernel", word(d.kernel)}};
}

void put_formulation(Json& json, FormulationChoice const& f, std::string const& label, Dictionary& word) {
  json["label"] = word(label);
  json["formulation"] = word(f.id);
  json["work"] = f.work.empty() ? Json(nullptr) : word(f.work);
  json["conduction"] = f.conduction.empty() ? Json(nullptr) : word(f.conduction);
  json["walls"] = f.walls;
}

/// The same norm of the exact field at the finest level that has it.
double scale_of(Series const& series, std::vector<RunRecord> const& runs, OrderEntry const& entry) {
  int finest = -1;
  double scale = 0.0;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    auto const field = run.errors.find(entry.field);
    if (field == run.errors.end() || run.resolution <= finest) continue;
    auto const region = field->second.find(entry.region);
    if (region == field->second.end()) continue;
    finest = run.resolution;
    scale = norm_of(region->second.scale, entry.norm);
  }
  return scale;
}

/// [seconds, low, high]: the median and the interval of it where repeats give one, else the shortest.
Json time_json(Number const& shortest, MedianSeconds const& m) {
  if (!m.median) return {number(shortest), nullptr, nullptr};
  return {number(m.median), number(m.low), number(m.high)};
}

Json levels_json(Series const& series, std::vector<RunRecord> const& runs, Dictionary& word) {
  struct Level {
    double spacing = NAN;
    int replicates = 0, failed = 0;
    std::string status;
    std::vector<Cost const*> timed;
  };
  std::map<int, Level> levels;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    Level& level = levels[run.resolution];
    level.spacing = run.spacing;
    ++level.replicates;
    if (run.status != "ok") {
      ++level.failed;
      level.status = run.status;
    } else if (run.cost) {
      level.timed.push_back(&*run.cost);
    }
  }
  Json list = Json::array();
  for (auto const& [resolution, level] : levels) {
    MeanTime const time = mean_time(level.timed);
    list.push_back({resolution, number(level.spacing), level.replicates, level.failed,
                    level.failed > 0 ? word(level.status) : Json(nullptr),
                    time_json(time.seconds, time.median)});
  }
  return list;
}

Json orders_json(Series const& series, std::vector<RunRecord> const& runs, Dictionary& word) {
  Json list = Json::array();
  for (OrderEntry const& entry : series.orders) {
    // Levels of all runs are listed beside; an entry's own may be fewer.
    std::map<int, SeriesLevel const*> by_resolution;
    for (std::size_t const index : series.runs) by_resolution[runs[index].resolution] = nullptr;
    for (SeriesLevel const& level : entry.levels) {
      if (auto const place = by_resolution.find(level.resolution); place != by_resolution.end())
        place->second = &level;
    }
    Json errors = Json::array();
    Json spreads = Json::array();
    bool spread_exists = false;
    for (auto const& [resolution, level] : by_resolution) {
      errors.push_back(level ? number(level->error) : Json(nullptr));
      spreads.push_back(level ? number(level->spread) : Json(nullptr));
      spread_exists = spread_exists || !spreads.back().is_null();
    }
    Json row = {word(entry.field),
                word(entry.region),
                word(entry.norm),
                entry.allowed,
                number(entry.observed.order),
                number(entry.observed.lower),
                number(entry.observed.upper),
                word(entry.observed.verdict),
                number(scale_of(series, runs, entry)),
                errors};
    if (spread_exists) row.push_back(spreads);
    list.push_back(std::move(row));
  }
  return list;
}

Json target_json(TimeToTarget const& target) {
  return {{"time", time_json(target.seconds, target.median)}, {"is_bound", target.is_bound}};
}

Json row_json(SeriesRow const& row) {
  return {{"field", row.field},
          {"norm", row.norm},
          {"finest", row.finest},
          {"verdict", row.verdict},
          {"failures", row.failures},
          {"error", number(row.error)},
          {"relative_error", number(row.relative_error)},
          {"order", number(row.order)},
          {"half_width", number(row.half_width)},
          {"time", time_json(row.seconds, row.median)},
          {"to_percent", target_json(row.to_percent)},
          {"to_permille", target_json(row.to_permille)},
          {"wall_flux_error", number(row.wall_flux_error)},
          {"energy_drift", number(row.energy_drift)},
          {"wall_budget_defect", number(row.wall_budget_defect)},
          {"plateau_pressure", number(row.plateau_pressure)},
          {"wall_heating", number(row.wall_heating)},
          {"wall_impulse_defect", number(row.wall_impulse_defect)},
          {"momentum_drift", number(row.momentum_drift)},
          {"time_error_share", number(row.time_error_share)}};
}

Json series_json(Series const& series, SeriesRow const& row, std::vector<RunRecord> const& runs,
                 Dictionary& word) {
  Json json = {{"case", word(series.case_id)}, {"parameters", word(row.parameters)}};
  put_formulation(json, series.formulation, series.label, word);
  json["settings"] = settings_json(series.discretisation, series.smoothing_exponent, word);
  json["row"] = row_json(row);
  json["levels"] = levels_json(series, runs, word);
  json["orders"] = orders_json(series, runs, word);
  return json;
}

Number relative(Number const& value, Budget const& budget) {
  double const scale = std::max(std::abs(budget.initial), std::abs(budget.final));
  return value ? Number(std::abs(*value) / (scale > 0.0 ? scale : 1.0)) : Number();
}

Json runs_json(Results const& results, std::vector<std::size_t> const& series_of, Dictionary& word) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    RunRecord const& run = results.runs[i];
    Number flux_error, drift, defect;
    for (WallFlux const& wall : run.wall_flux) {
      if (wall.scale > 0.0)
        flux_error = std::max(flux_error.value_or(0.0), std::abs(wall.error) / wall.scale);
    }
    if (auto const energy = run.conservation.find("energy"); energy != run.conservation.end()) {
      drift = relative(energy->second.drift, energy->second);
      defect = relative(energy->second.wall_budget_defect, energy->second);
    }
    Cost const* cost = run.cost ? &*run.cost : nullptr;
    Stability const* stability = run.stability ? &*run.stability : nullptr;
    bool const has_seed =
        run.discretisation.layout.id == "jittered" || run.discretisation.layout.id == "glass";
    bool const has_series = series_of[i] < results.series.size();
    rows.push_back({has_series ? Json(series_of[i]) : Json(nullptr),
                    has_series ? Json(nullptr) : word(run.label),
                    has_series ? Json(nullptr) : word(run.case_id),
                    run.resolution,
                    run.particles,
                    has_seed ? Json(run.discretisation.layout.seed) : Json(nullptr),
                    word(run.status),
                    run.reason.empty() ? Json(nullptr) : word(run.reason),
                    number(run.smoothing_length),
                    cost ? time_json(cost->seconds, cost->median) : Json(nullptr),
                    cost ? Json(cost->steps) : Json(nullptr),
                    cost ? Json(cost->rate_evaluations) : Json(nullptr),
                    cost ? Json(cost->pair_interactions) : Json(nullptr),
                    cost ? Json(cost->peak_bytes) : Json(nullptr),
                    number(drift),
                    number(defect),
                    number(flux_error),
                    run.integration ? number(run.integration->time_error_share) : Json(nullptr),
                    stability ? number(stability->spectral_abscissa) : Json(nullptr),
                    stability ? number(stability->spectral_radius) : Json(nullptr),
                    stability ? number(stability->largest_stable_step) : Json(nullptr)});
  }
  return {{"columns",
           {"series",
            "label",
            "case",
            "resolution",
            "particles",
            "seed",
            "status",
            "reason",
            "smoothing_length",
            "time",
            "steps",
            "rate_evaluations",
            "pair_interactions",
            "peak_bytes",
            "energy_drift",
            "wall_budget_defect",
            "wall_flux_error",
            "time_error_share",
            "spectral_abscissa",
            "spectral_radius",
            "largest_stable_step"}},
          {"rows", rows}};
}

/// Of each series the run of the finest resolution that holds something; between replicates the one of the
/// largest `weight`, else the first.
std::vector<std::pair<std::size_t, std::size_t>> one_per_series(
    Results const& results, std::function<bool(RunRecord const&)> const& holds,
    std::function<double(RunRecord const&)> const& weight) {
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  for (std::size_t s = 0; s < results.series.size(); ++s) {
    RunRecord const* best = nullptr;
    std::size_t best_index = 0;
    for (std::size_t const index : results.series[s].runs) {
      RunRecord const& run = results.runs[index];
      if (!holds(run)) continue;
      bool const is_better = best == nullptr || run.resolution > best->resolution ||
                             (run.resolution == best->resolution && weight(run) > weight(*best));
      if (!is_better) continue;
      best = &run;
      best_index = index;
    }
    if (best != nullptr) chosen.emplace_back(s, best_index);
  }
  return chosen;
}

double no_weight(RunRecord const&) { return 0.0; }

/// Points that each of `count` curves may have.
std::size_t points_each(std::size_t most_numbers, std::size_t numbers_per_point) {
  return std::max(fewest_points, most_numbers / std::max<std::size_t>(1, numbers_per_point));
}

Json profiles_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return run.profile.has_value(); }, no_weight);
  std::size_t per_point = 0;
  for (auto const& [series, index] : chosen) {
    Profile const& p = *results.runs[index].profile;
    per_point += (p.position.empty() ? 0 : p.position[0].size()) + 2 * p.computed.size();
  }
  std::size_t const points = points_each(most_profile_numbers / share, per_point);
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    RunRecord const& run = results.runs[index];
    Profile const& p = *run.profile;
    auto const kept = spread_evenly(p.position.size(), points);
    Json json = {
        {"series", series}, {"run", index}, {"particles", p.position.size()}, {"position", Json::array()}};
    std::size_t const dimension = p.position.empty() ? 0 : p.position[0].size();
    for (std::size_t k = 0; k < dimension; ++k) json["position"].push_back(picked(p.position, k, kept));
    json["computed"] = Json::object();
    json["exact"] = Json::object();
    for (auto const& [field, values] : p.computed) json["computed"][field] = picked(values, 0, kept);
    for (auto const& [field, values] : p.exact) json["exact"][field] = picked(values, 0, kept);
    list.push_back(std::move(json));
  }
  return list;
}

Json histories_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return run.history.has_value(); }, no_weight);
  std::size_t per_point = 0;
  for (auto const& [series, index] : chosen) {
    History const& h = *results.runs[index].history;
    per_point += 4 + h.wall_impulse_defect.size() + h.wall_energy_defect.size();
  }
  std::size_t const points = points_each(most_history_numbers / share, per_point);
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    RunRecord const& run = results.runs[index];
    History const& h = *run.history;
    auto const kept = spread_evenly(h.time.size(), points);
    Json json = {{"series", series},
                 {"run", index},
                 {"time", picked(h.time, kept)},
                 {"energy", picked(h.energy, kept)},
                 {"exchanged", picked(h.exchanged, kept)},
                 {"drift", Json::array()}};
    // Differences of nearly equal numbers are taken before rounding.
    if (auto const energy = run.conservation.find("energy"); energy != run.conservation.end()) {
      Budget const& b = energy->second;
      for (std::size_t const i : kept) {
        bool const exists = i < h.energy.size() && i < h.exchanged.size();
        json["drift"].push_back(exists ? number(h.energy[i] - b.initial - h.exchanged[i]) : Json(nullptr));
      }
      json["scale"] = number(std::max(std::abs(b.initial), std::abs(b.final)));
    }
    if (!h.momentum.empty()) json["momentum"] = picked(h.momentum, kept);
    json["wall_impulse_defect"] = Json::array();
    json["wall_energy_defect"] = Json::array();
    for (auto const& wall : h.wall_impulse_defect) json["wall_impulse_defect"].push_back(picked(wall, kept));
    for (auto const& wall : h.wall_energy_defect) json["wall_energy_defect"].push_back(picked(wall, kept));
    list.push_back(std::move(json));
  }
  return list;
}

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

Json word_or_null(std::string const& text, Dictionary& word) {
  return text.empty() ? Json(nullptr) : word(text);
}

Json numbers(std::vector<double> const& values) {
  Json list = Json::array();
  for (double const value : values) list.push_back(number(value));
  return list;
}

/// All replicates of a series' finest resolution that has a run for which `holds` is true: of these, those
/// for which it is.
std::vector<std::size_t> finest_runs(Results const& results, Series const& series,
                                     std::function<bool(RunRecord const&)> const& holds) {
  std::vector<std::size_t> chosen;
  int finest = -1;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = results.runs[index];
    if (!holds(run) || run.resolution < finest) continue;
    if (run.resolution > finest) chosen.clear();
    finest = run.resolution;
    chosen.push_back(index);
  }
  return chosen;
}

/// [growth, frequency, wavelength, share near walls, centre], in the units of the document.
Json mode_json(Mode const& mode) {
  return {number(mode.growth), number(mode.frequency), number(mode.wavelength), number(mode.wall_share),
          numbers(mode.centre)};
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
            {word(method), number(step.theory), number(step.measured), word_or_null(step.remark, word)});
      }
      // Of a large operator it is not known how many modes grow: a worst one without their number does.
      bool const grows = s.growing_modes ? *s.growing_modes > 0 : s.worst_mode.has_value();
      list.push_back({{"run", index},
                      {"grows", grows},
                      {"growing", s.growing_modes ? Json(*s.growing_modes) : Json(nullptr)},
                      {"unseen", s.unseen_modes ? Json(*s.unseen_modes) : Json(nullptr)},
                      {"method", word_or_null(s.method, word)},
                      {"remark", word_or_null(s.remark, word)},
                      {"worst", s.worst_mode ? mode_json(*s.worst_mode) : Json(nullptr)},
                      {"steps", std::move(steps)}});
    }
  }
  return list;
}

double abscissa(RunRecord const& run) { return run.stability->spectral_abscissa.value_or(-INFINITY); }

/// Small perturbations of a gas about rest: of each conjugate pair one mode. Modes in which no particle moves
/// have no wavelength and are only counted.
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

/// [size, time, place]
Json breach_json(Breach const& breach) {
  return {number(breach.size), number(breach.time), numbers(breach.position)};
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
                      {"remark", word_or_null(s.remark, word)}});
    }
  }
  return list;
}

Json envelopes_json(Results const& results, Dictionary& word) {
  Json list = Json::array();
  for (Envelope const& e : results.envelopes) {
    Json json = {{"case", word(e.case_id)}};
    put_formulation(json, e.formulation, e.label, word);
    json["settings"] = settings_json(e.discretisation, 0.0, word);
    json["resolution"] = e.resolution;
    json["parameter"] = e.parameter;
    json["logarithmic"] = e.logarithmic;
    json["held"] = number(e.held);
    json["failed"] = number(e.failed);
    json["status"] = e.status;
    json["reason"] = e.reason;
    json["points"] = Json::array();
    for (auto const& point : e.points) json["points"].push_back({number(point.value), word(point.status)});
    list.push_back(std::move(json));
  }
  return list;
}

Json skipped_json(Results const& results) {
  Json list = Json::array();
  for (Skipped const& s : results.skipped) list.push_back({s.case_id, s.formulation, s.reason});
  return list;
}

Json document_json(NamedResults const& document, SeriesRow const* rows, std::size_t share) {
  Results const& results = document.results;
  Context const& c = results.context;
  Dictionary word;
  std::vector<std::size_t> series_of(results.runs.size(), results.series.size());
  Json series = Json::array();
  for (std::size_t s = 0; s < results.series.size(); ++s) {
    for (std::size_t const run : results.series[s].runs) series_of[run] = s;
    series.push_back(series_json(results.series[s], rows[s], results.runs, word));
  }
  Json json = {{"name", document.name},
               {"context",
                {{"version", c.version},
                 {"commit", c.commit},
                 {"compiler", c.compiler},
                 {"flags", c.flags},
                 {"processor", c.processor},
                 {"cores", c.cores},
                 {"date", c.date}}},
               {"study", Json::parse(results.study)},
               {"disturbance", disturbance({rows, rows + results.series.size()})},
               {"series", std::move(series)},
               {"runs", runs_json(results, series_of, word)},
               {"profiles", profiles_json(results, share)},
               {"histories", histories_json(results, share)},
               {"spectra", spectra_json(results, share)},
               {"stabilities", stabilities_json(results, word)},
               {"perturbations", perturbations_json(results, share)},
               {"second_laws", second_laws_json(results, word)},
               {"envelopes", envelopes_json(results, word)},
               {"skipped", skipped_json(results)}};
  json["words"] = word.words();
  return json;
}

}  // namespace

Json page_data(std::vector<NamedResults> const& documents) {
  auto const rows = series_rows(documents, "all", "");
  Json list = Json::array();
  std::size_t first_row = 0;
  for (NamedResults const& document : documents) {
    list.push_back(document_json(document, rows.data() + first_row, documents.size()));
    first_row += document.results.series.size();
  }
  return list;
}

}  // namespace sphverify
