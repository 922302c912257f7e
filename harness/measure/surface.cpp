// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "cases/support/case.hpp"
#include "reports/find_error.hpp"
#include "reports/norm_of.hpp"
#include "reports/timed_apart.hpp"

namespace sphverify {

namespace {

constexpr char const* region = "all";
constexpr std::size_t least_resolutions = 3;
constexpr std::size_t least_ratios = 3;

/// All that the runs of a surface have in common.
Discretisation common(Discretisation d) {
  d.layout.seed = 0;
  d.smoothing_ratio = 0.0;
  return d;
}

/// Runs of one surface, by resolution and h/dx.
using Cells = std::map<std::pair<int, double>, std::vector<RunRecord const*>>;

struct Grid {
  RunRecord const* first;
  Cells cells;

  bool takes(RunRecord const& run) const {
    return first->case_id == run.case_id && first->parameters == run.parameters &&
           first->formulation == run.formulation &&
           common(first->discretisation) == common(run.discretisation);
  }
  bool is_large_enough() const {
    std::set<int> resolutions;
    std::set<double> ratios;
    for (auto const& [place, runs] : cells) {
      resolutions.insert(place.first);
      ratios.insert(place.second);
    }
    return resolutions.size() >= least_resolutions && ratios.size() >= least_ratios;
  }
};

/// Of the numbers of all replicates; empty if one has none.
template <typename NumberOf>
Number mean_of(std::vector<RunRecord const*> const& runs, NumberOf const& number_of) {
  double sum = 0.0;
  for (RunRecord const* run : runs) {
    Number const value = number_of(*run);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    sum += *value;
  }
  return sum / static_cast<double>(runs.size());
}

/// Above round-off: below it an error says nothing.
Number error_of(RunRecord const& run, std::string const& field, std::string const& norm) {
  if (run.status != "ok") return std::nullopt;
  RegionError const* const error = find_error(run, field, region);
  if (error == nullptr) return std::nullopt;
  double const value = norm_of(error->error, norm);
  return value > error->round_off ? Number(value) : std::nullopt;
}

SurfaceCell cell_of(std::vector<RunRecord const*> const& runs, std::string const& field, std::string const& norm,
                    bool is_timed_apart) {
  RunRecord const& first = *runs.front();
  SurfaceCell cell;
  cell.resolution = first.resolution;
  cell.smoothing_ratio = first.discretisation.smoothing_ratio;
  cell.spacing = first.spacing;
  cell.replicates = static_cast<int>(runs.size());
  cell.particles =
      *mean_of(runs, [](RunRecord const& run) { return Number(static_cast<double>(run.particles)); });
  auto const error = [&](RunRecord const& run) { return error_of(run, field, norm); };
  cell.error = mean_of(runs, error);
  if (cell.error && runs.size() > 1) {
    double sum = 0.0;
    for (RunRecord const* run : runs) sum += std::pow(*error(*run) - *cell.error, 2);
    cell.spread = std::sqrt(sum / static_cast<double>(runs.size() - 1));
  }
  // A machine that has other work stretches the wall time, not the processor's.
  cell.seconds = mean_of(runs, [&](RunRecord const& run) {
    if (!run.cost || run.status != "ok" || is_timed_apart) return Number();
    return run.cost->cpu_seconds ? run.cost->cpu_seconds : Number(run.cost->seconds);
  });
  cell.pair_interactions = mean_of(runs, [](RunRecord const& run) {
    return run.cost && run.status == "ok" ? Number(static_cast<double>(run.cost->pair_interactions))
                                          : std::nullopt;
  });
  return cell;
}

void add_surfaces(Grid const& grid, bool is_timed_apart, std::vector<Surface>& all) {
  std::set<std::string> fields;
  for (auto const& [place, runs] : grid.cells) {
    for (RunRecord const* run : runs) {
      for (auto const& [field, regions] : run->errors) fields.insert(field);
    }
  }
  Case const* const known = find_case(grid.first->case_id);
  bool const jumps = known != nullptr && known->info.discontinuous;
  for (std::string const& field : fields) {
    Surface& surface = all.emplace_back();
    surface.case_id = grid.first->case_id;
    surface.label = grid.first->label;
    surface.parameters = grid.first->parameters;
    surface.formulation = grid.first->formulation;
    surface.discretisation = grid.first->discretisation;
    surface.error.field = field;
    surface.error.region = region;
    surface.error.norm = jumps ? "l1" : "l2";
    for (auto const& [place, runs] : grid.cells)
      surface.error.cells.push_back(cell_of(runs, field, surface.error.norm, is_timed_apart));
  }
}

}  // namespace

std::vector<Surface> build_surfaces(std::vector<RunRecord> const& runs) {
  bool const is_timed_apart = are_timed_apart(runs);
  std::vector<Grid> grids;
  for (RunRecord const& run : runs) {
    if (run.smoothing_exponent != 0.0) continue;
    auto found =
        std::find_if(grids.rbegin(), grids.rend(), [&](Grid const& grid) { return grid.takes(run); });
    if (found == grids.rend()) {
      grids.push_back({&run, {}});
      found = grids.rbegin();
    }
    found->cells[{run.resolution, run.discretisation.smoothing_ratio}].push_back(&run);
  }
  std::vector<Surface> surfaces;
  for (Grid const& grid : grids) {
    if (grid.is_large_enough()) add_surfaces(grid, is_timed_apart, surfaces);
  }
  tbb::parallel_for(std::size_t{0}, surfaces.size(),
                    [&](std::size_t k) { explain_surface(surfaces[k].error); });
  return surfaces;
}

}  // namespace sphverify
