// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/gate/measure.hpp"
#include "harness/gate/measuring.hpp"
#include "reports/norm_of.hpp"

namespace sphverify {

namespace {

/// The error that a gate names; null, with the problem said, if the run has none.
RegionError const* find_error(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  std::string const field = field_of(gate, m);
  std::set<std::string> fields;
  for (auto const& [known, regions] : m.run->errors) fields.insert(known);
  m.problem = fmt::format("no error of {} in '{}'", field.empty() ? "any field" : field, gate.region);
  if (!measuring.name("field", field, fields)) return nullptr;
  FieldErrors const& regions = m.run->errors.at(field);
  std::set<std::string> known;
  for (auto const& [region, error] : regions) known.insert(region);
  if (!measuring.name("region", gate.region, known)) return nullptr;
  m.problem.clear();
  return &regions.at(gate.region);
}

/// The error, and what rounding makes of it, as parts of a norm.
void put_part(Measured& m, RegionError const& error, std::string const& norm, double of,
              std::string const& missing) {
  put(m, of > 0.0 ? Number(norm_of(error.error, norm) / of) : Number(), missing);
  if (m.value) m.round_off = error.round_off / of;
}

}  // namespace

void measure_error(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  RegionError const* const error = find_error(measuring, m);
  if (error == nullptr) return;
  if (gate.relative) {
    return put_part(m, *error, gate.norm, norm_of(error->scale, gate.norm),
                    "the error is null, or the exact field's norm is zero or null");
  }
  put_part(m, *error, gate.norm, 1.0, "the error is null");
}

/// The error over that of the initial state taken for the answer.
void measure_skill(Measuring& measuring, Measured& m) {
  RegionError const* const error = find_error(measuring, m);
  if (error == nullptr) return;
  if (!error->initial) {
    m.problem = "the error of doing nothing was not measured";
    return;
  }
  put_part(m, *error, measuring.gate.norm, norm_of(*error->initial, measuring.gate.norm),
           "the error is null, or that of doing nothing is zero or null");
}

/// The share of the error that time integration made. Where it is 0 all changes were within round-off: below
/// the largest part of an error that rounding explains a share says nothing.
void measure_time_error(Measuring& measuring, Measured& m) {
  std::set<std::string> known;
  if (m.run->integration) known.insert("time_error");
  if (!measuring.name("measure", "time_error", known)) {
    m.problem = "no time was integrated";
    return;
  }
  put(m, m.run->integration->time_error_share, "the time error was not measured");
  if (!m.value) return;
  double rounding = 0.0;
  for (auto const& [field, regions] : m.run->errors) {
    for (auto const& [region, error] : regions) {
      for (double const norm : {error.error.l1, error.error.l2, error.error.linf}) {
        if (norm > 0.0) rounding = std::max(rounding, error.round_off / norm);
      }
    }
  }
  m.round_off = rounding;
}

}  // namespace sphverify
