// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "harness/measure/surface.hpp"
#include "harness/measure/surface_bootstrap.hpp"
#include "harness/measure/surface_fit.hpp"
#include "harness/measure/surface_law.hpp"
#include "harness/measure/surface_path.hpp"

namespace sphverify {

std::string_view const surface_rules =
    R"(grid       runs over at least three resolutions and three smoothing_ratios, smoothing_exponent 0; each
           field's error in region all, l1 where the solution jumps, l2 elsewhere, mean over seeds.
           A place of which a run failed has no error, and a row or column without any is left out
law        e = F + sqrt(S^2 + Q^2 + 2 c S Q), S = A (r d)^p, Q = B r^-s d^t or B(r) d^t, r = h/dx, d = dx;
           of 16 such laws that of the least criterion (docs/decisions/0010). None where it misses
           the errors by more than half
best       h/dx of least error at a resolution by the law, with its 95% interval (<=, >=: the grid's
           end). Where another place erred least and the law's misfit is larger than what it
           claims to gain over that, what was measured is taken; where it is smaller, both are named
path       the N and h/dx of least cost for ever smaller errors: neighbours ~ N^k, k = (p - t)/(p + s)
rules      h/dx kept, and neighbours ~ N^0.5, beside that path: the error at its cost, the cost at its
           error)";

namespace {

constexpr double largest_misfit = 0.405;  ///< ln(1.5)
constexpr double rival_criterion = 4.0;
constexpr std::size_t most_rivals = 3;
constexpr std::array<double, 2> rules{0.0, 0.5};

struct CostUnit {
  char const* name;
  std::optional<double> SurfaceCell::*member;
};
constexpr std::array<CostUnit, 2> cost_units{
    {{"pair_interactions", &SurfaceCell::pair_interactions}, {"seconds", &SurfaceCell::seconds}}};

bool is_known(SurfaceCell const& cell) { return cell.error && *cell.error > 0.0; }

/// Cells that have an error, with rows and columns counted among them.
std::vector<SurfaceDatum> data_of(std::vector<SurfaceCell> const& cells) {
  std::map<int, std::size_t> rows;
  std::map<double, std::size_t> columns;
  for (SurfaceCell const& cell : cells) {
    if (!is_known(cell)) continue;
    rows.emplace(cell.resolution, 0);
    columns.emplace(cell.smoothing_ratio, 0);
  }
  std::size_t next = 0;
  for (auto& [resolution, row] : rows) row = next++;
  next = 0;
  for (auto& [ratio, column] : columns) column = next++;
  std::vector<SurfaceDatum> data;
  for (SurfaceCell const& cell : cells) {
    if (is_known(cell))
      data.push_back({cell.spacing, cell.smoothing_ratio, *cell.error, rows[cell.resolution],
                      columns[cell.smoothing_ratio]});
  }
  return data;
}

/// Whether enough spacings and h/dx have errors to tell one from the other.
bool spans_a_grid(std::vector<SurfaceDatum> const& data) {
  constexpr std::size_t least = 3;
  std::size_t rows = 0, columns = 0;
  for (SurfaceDatum const& datum : data) {
    rows = std::max(rows, datum.row + 1);
    columns = std::max(columns, datum.column + 1);
  }
  return rows >= least && columns >= least;
}

/// Of the cells that have an error: where all runs failed nothing is known.
SurfaceRange range_of(std::vector<SurfaceCell> const& cells) {
  SurfaceRange range;
  range.coarsest = range.lowest = INFINITY;
  for (SurfaceCell const& cell : cells) {
    if (!is_known(cell)) continue;
    range.lowest = std::min(range.lowest, cell.smoothing_ratio);
    range.highest = std::max(range.highest, cell.smoothing_ratio);
    range.coarsest = std::min<double>(range.coarsest, cell.resolution);
    if (cell.resolution >= range.finest) {
      range.finest = cell.resolution;
      range.finest_spacing = cell.spacing;
    }
  }
  return range;
}

/// What no law is needed for: the cell of least error at each resolution that has any.
std::vector<BestRatio> best_of_grid(std::vector<SurfaceCell> const& cells) {
  std::map<int, BestRatio> best;
  for (SurfaceCell const& cell : cells) {
    if (!cell.error) continue;
    BestRatio& entry = best[cell.resolution];
    entry.resolution = cell.resolution;
    if (entry.grid_error && *entry.grid_error <= *cell.error) continue;
    entry.grid_error = cell.error;
    entry.grid_ratio = cell.smoothing_ratio;
  }
  std::vector<BestRatio> all;
  for (auto const& [resolution, entry] : best) all.push_back(entry);
  return all;
}

/// The cells that no other beats: none has less error at no more cost.
std::vector<SurfacePlace> unbeaten(std::vector<SurfaceCell> const& cells, CostUnit const& unit) {
  std::vector<SurfacePlace> places;
  for (SurfaceCell const& cell : cells) {
    std::optional<double> const cost = cell.*unit.member;
    if (cell.error && cost)
      places.push_back({static_cast<double>(cell.resolution), cell.smoothing_ratio, *cell.error, *cost, ""});
  }
  std::vector<SurfacePlace> front;
  for (SurfacePlace const& place : places) {
    bool const is_beaten = std::any_of(places.begin(), places.end(), [&](SurfacePlace const& other) {
      return other.error < place.error && other.cost <= place.cost;
    });
    if (!is_beaten) front.push_back(place);
  }
  return front;
}

/// The answers of one law, by name: what the bootstrap draws.
class Answerer {
 public:
  Answerer(ErrorSurface const& surface, SurfaceRange const& range, std::vector<CostLaw> const& costs)
      : surface_(surface), range_(range), costs_(costs) {}

  static std::string best(int resolution) { return fmt::format("best {}", resolution); }
  static std::string point(std::string const& unit, double cost) {
    return fmt::format("point {} {}", unit, cost);
  }
  static std::string rule(std::string const& unit, double exponent, char const* what) {
    return fmt::format("rule {} {} {}", unit, exponent, what);
  }

  SurfaceBootstrap::Answers operator()(SurfaceLaw const& law) const {
    SurfaceBootstrap::Answers answers;
    if (law.smoothing_coefficient > 0.0) answers["p"] = law.smoothing_exponent;
    if (law.sampling_coefficient > 0.0 || !law.sampling.empty()) {
      answers["s"] = law.sampling_exponent;
      answers["t"] = law.spacing_exponent;
      // At the least cost of an error the ratio of the two terms is the same everywhere.
      if (law.smoothing_coefficient > 0.0) {
        answers["k"] = (law.smoothing_exponent - law.spacing_exponent) /
                       (law.smoothing_exponent + law.sampling_exponent);
      }
    }
    SurfaceWalk const walk(law, range_);
    for (BestRatio const& entry : surface_.best)
      answers[best(entry.resolution)] = walk.best(entry.resolution).ratio;
    for (SurfacePath const& path : surface_.paths) {
      for (PathPoint const& at : path.points)
        answers[point(path.cost.unit, at.cost)] = walk.best_for(at.cost, path.cost).ratio;
    }
    for (CostLaw const& cost : costs_) {
      auto const start = walk.path(cost, 1);
      if (start.empty()) continue;
      for (double const k : rules) {
        PathRule const followed = follow_rule(k, walk, start.front(), cost, range_);
        answers[rule(cost.unit, k, "error")] = *followed.error_ratio.value;
        if (followed.cost_ratio.value) answers[rule(cost.unit, k, "cost")] = *followed.cost_ratio.value;
      }
    }
    return answers;
  }

 private:
  ErrorSurface const& surface_;
  SurfaceRange const& range_;
  std::vector<CostLaw> const& costs_;
};

SurfacePath path_of(SurfaceWalk const& walk, CostLaw const& cost, SurfaceRange const& range) {
  SurfacePath path;
  path.cost = cost;
  auto const places = walk.path(cost);
  constexpr std::size_t step = 4;  // of what the exponent is taken from, to show
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k % step != 0 && k + 1 != places.size()) continue;
    SurfacePlace const& place = places[k];
    path.points.push_back({place.error, place.resolution, {place.ratio, {}, {}}, place.cost, place.edge});
  }
  if (places.empty()) {
    path.reason = "spending more buys nothing within the grid";
    return path;
  }
  auto const on_edge = [](SurfacePlace const& place) { return !place.edge.empty(); };
  if (std::all_of(places.begin(), places.end(), on_edge)) {
    path.reason = fmt::format("all of it runs along the grid's {} end, h/dx {:.3g}", places.back().edge,
                              places.back().ratio);
  }
  for (double const k : rules) path.rules.push_back(follow_rule(k, walk, places.front(), cost, range));
  return path;
}

void answer_from(std::vector<SurfaceDatum> const& data, SurfaceFits const& all, ErrorSurface& surface) {
  SurfaceFit const& fit = all.fits.front();
  SurfaceRange const range = range_of(surface.cells);
  SurfaceWalk const walk(fit.law, range);
  surface.law = fit.law;
  surface.model = fit.model.name;
  for (SurfaceCell& cell : surface.cells)
    cell.fitted = surface_error(fit.law, cell.spacing, cell.smoothing_ratio);
  std::vector<CostLaw> costs;
  for (CostUnit const& unit : cost_units) {
    std::vector<CostDatum> cost_data;
    for (SurfaceCell const& cell : surface.cells) {
      if (auto const cost = cell.*unit.member)
        cost_data.push_back({static_cast<double>(cell.resolution), cell.smoothing_ratio, *cost});
    }
    auto const cost = fit_cost(unit.name, cost_data);
    if (!cost) continue;
    if (cost->misfit > largest_misfit) {
      surface.paths.emplace_back().cost = *cost;
      surface.paths.back().reason = fmt::format("no law of cost: C N^a (h/dx)^b misses it by {:.0f}%",
                                                100.0 * std::expm1(cost->misfit));
      continue;
    }
    costs.push_back(*cost);
    surface.paths.push_back(path_of(walk, *cost, range));
    surface.paths.back().grid_exponent = neighbour_exponent(unbeaten(surface.cells, unit));
  }

  std::vector<SurfaceFit> rivals;
  for (SurfaceFit const& rival : all.fits) {
    if (rival.criterion <= fit.criterion + rival_criterion && rivals.size() < most_rivals)
      rivals.push_back(rival);
  }
  SurfaceBootstrap const drawn(data, rivals, all.threshold, Answerer(surface, range, costs));
  surface.smoothing_exponent = drawn.estimate("p");
  surface.sampling_exponent = drawn.estimate("s");
  surface.spacing_exponent = drawn.estimate("t");
  surface.neighbour_exponent = drawn.estimate("k");
  for (BestRatio& entry : surface.best) {
    SurfacePlace const place = walk.best(entry.resolution);
    entry.ratio = drawn.estimate(Answerer::best(entry.resolution));
    entry.error = place.error;
    entry.edge = place.edge;
  }
  for (SurfacePath& path : surface.paths) {
    std::string const& unit = path.cost.unit;
    for (PathPoint& point : path.points) point.ratio = drawn.estimate(Answerer::point(unit, point.cost));
    for (PathRule& rule : path.rules) {
      rule.error_ratio = drawn.estimate(Answerer::rule(unit, rule.exponent, "error"));
      rule.cost_ratio = drawn.estimate(Answerer::rule(unit, rule.exponent, "cost"));
    }
  }
}

}  // namespace

void explain_surface(ErrorSurface& surface) {
  surface.best = best_of_grid(surface.cells);
  std::vector<SurfaceDatum> const data = data_of(surface.cells);
  SurfaceFits const all = spans_a_grid(data) ? fit_surface_models(data) : SurfaceFits{};
  if (all.fits.empty()) {
    surface.reason =
        fmt::format("{} of {} places have an error: too few for a law", data.size(), surface.cells.size());
    return;
  }
  SurfaceFit const& fit = all.fits.front();
  surface.misfit = fit.misfit;
  for (SurfaceFit const& one : all.fits) {
    surface.candidates.push_back(
        {one.model.name, static_cast<int>(one.parameters.size()), one.criterion - fit.criterion, one.misfit});
  }
  if (fit.misfit > largest_misfit) {
    surface.reason = fmt::format("no law: the closest, {}, misses the errors by {:.0f}%", fit.model.name,
                                 100.0 * std::expm1(fit.misfit));
    return;
  }
  surface.reason = fmt::format("closest of {} laws; it misses the errors by {:.0f}%", all.fits.size(),
                               100.0 * std::expm1(fit.misfit));
  answer_from(data, all, surface);
}

}  // namespace sphverify
