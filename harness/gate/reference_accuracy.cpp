// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/reference_accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/support/case.hpp"
#include "harness/gate/measure.hpp"
#include "reports/find_error.hpp"
#include "reports/norm_of.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// A norm of the exact field; 0 where the run has none.
double exact_norm(RunRecord const& run, std::string const& field, std::string const& region,
                  std::string const& norm) {
  RegionError const* const error = find_error(run, field, region);
  return error == nullptr ? 0.0 : norm_of(error->scale, norm);
}

/// The error of doing nothing; 0 where it is not known.
double initial_norm(RunRecord const& run, std::string const& field, std::string const& region,
                    std::string const& norm) {
  RegionError const* const error = find_error(run, field, region);
  return error == nullptr || !error->initial ? 0.0 : norm_of(*error->initial, norm);
}

/// What a relative accuracy of a gas counts of.
double largest_value(RunRecord const& run, std::string const& field) {
  auto const of = [&](char const* name) { return exact_norm(run, name, "all", "linf"); };
  double const own = exact_norm(run, field, "all", "linf");
  if (field != "velocity" || !(of("density") > 0.0)) return own;
  return std::max(own, std::sqrt(2.0 * of("pressure") / of("density")));
}

/// The smallest limit that makes sense, in what the gate measures; 0 where the run cannot tell.
double smallest_limit(Gate const& gate, Measured const& m, ReferenceAccuracy const& accuracy) {
  RunRecord const& run = *m.run;
  std::string const field = field_of(gate, m);
  if (gate.measure == GateMeasure::wall_flux) {
    double scale = 0.0;
    for (WallFlux const& wall : run.wall_flux) scale = std::max(scale, wall.scale);
    double const temperature = exact_norm(run, "temperature", "all", "linf");
    double const part = accuracy.relative   ? accuracy.value
                        : temperature > 0.0 ? accuracy.value / temperature
                                            : 0.0;
    return gate.relative ? part : part * scale;
  }
  double const absolute = accuracy.relative ? accuracy.value * largest_value(run, field) : accuracy.value;
  bool const is_skill = gate.measure == GateMeasure::skill;
  if (!gate.relative && !is_skill) return absolute;
  double const scale = is_skill ? initial_norm(run, field, gate.region, gate.norm)
                                : exact_norm(run, field, gate.region, gate.norm);
  return scale > 0.0 ? absolute / scale : 0.0;
}

/// The same of a target of time_to_error, which is relative to the exact field's norm.
double smallest_target(Gate const& gate, Measured const& m, ReferenceAccuracy const& accuracy) {
  if (accuracy.relative) return accuracy.value;
  std::string const field = field_of(gate, m);
  for (TimeToError const& t : m.series->time_to_error) {
    if (t.field == field && t.region == gate.region && t.norm == gate.norm)
      return accuracy.value * t.relative / t.error;
  }
  return 0.0;
}

}  // namespace

std::optional<ReferenceAccuracy> reference_accuracy(std::string const& case_id,
                                                    std::map<std::string, ParameterValue> const& parameters) {
  Case const* const found = find_case(case_id);
  if (found == nullptr) return std::nullopt;
  Parameters all(found->info.parameters);
  for (auto const& [name, value] : parameters) all.set(name, value);
  try {
    return std::visit(
        [](auto const& problem) {
          return ReferenceAccuracy{problem.accuracy, problem.gamma > 0.0};
        },
        found->problem(all));
  } catch (std::exception const&) {
    return std::nullopt;  // parameters that this program's case does not take
  }
}

void require_reachable(Gate const& gate, Measured const& m, std::string const& file) {
  bool const is_time = gate.measure == GateMeasure::time_to_error;
  bool const is_error = gate.measure == GateMeasure::error || gate.measure == GateMeasure::skill;
  if (!is_error && gate.measure != GateMeasure::wall_flux && !is_time) return;
  auto const accuracy = reference_accuracy(m.series->case_id, m.series->parameters);
  if (!accuracy) return;
  double const smallest = is_time ? smallest_target(gate, m, *accuracy) : smallest_limit(gate, m, *accuracy);
  auto const require = [&](char const* key, Number const& limit) {
    if (!limit || *limit >= smallest) return;
    throw UserError(
        file, fmt::format("{}.{}", gate.key, key), fmt::format("{:g}", *limit),
        fmt::format("at least {:.2g}: the reference of {} is no more accurate", smallest, m.series->case_id));
  };
  if (is_time) return require("target", gate.target);
  require("minimum", gate.limit.minimum);
  require("maximum", gate.limit.maximum);
  require("equals", gate.limit.equals);
  if (gate.limit.within) require("within.absolute", gate.limit.within->absolute);
}

}  // namespace sphverify
