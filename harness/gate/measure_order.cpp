// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/gate/measure.hpp"
#include "harness/gate/measuring.hpp"
#include "reports/find_error.hpp"
#include "reports/norm_of.hpp"

namespace sphverify {

namespace {

/// How far rounding of the errors may move an order: what it may change their logarithms by, over that of the
/// refinement.
Number order_round_off(Measuring const& measuring, Measured const& m, OrderEntry const& entry) {
  double worst = 0.0;
  double coarsest = 0.0;
  double finest = 0.0;
  for (std::size_t const index : m.series->runs) {
    RunRecord const& run = measuring.results.runs[index];
    RegionError const* const error = find_error(run, entry.field, entry.region);
    if (error == nullptr) return std::nullopt;
    double const norm = norm_of(error->error, entry.norm);
    if (!(norm > 0.0) || !(run.spacing > 0.0)) return std::nullopt;
    worst = std::max(worst, error->round_off / norm);
    coarsest = std::max(coarsest, run.spacing);
    finest = finest > 0.0 ? std::min(finest, run.spacing) : run.spacing;
  }
  if (!(coarsest > finest)) return std::nullopt;
  return 2.0 * worst / std::log(coarsest / finest);
}

}  // namespace

void measure_order(Measuring& measuring, Measured& m) {
  std::string const field = field_of(measuring.gate, m);
  OrderEntry const* const entry = find_entry(measuring, m.series->orders, field);
  if (entry == nullptr) {
    m.problem = fmt::format("no order of {} in '{}'", field, measuring.gate.region);
    return;
  }
  ObservedOrder const& observed = entry->observed;
  m.word = observed.verdict;
  m.remark = observed.reason;
  put(m, observed.order,
      fmt::format("no order: {}", observed.reason.empty() ? observed.verdict : observed.reason));
  m.lower = observed.lower;
  m.upper = observed.upper;
  m.round_off = order_round_off(measuring, m, *entry);
}

}  // namespace sphverify
