// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/find_error.hpp"
#include "reports/json/results_json.hpp"
#include "reports/norm_of.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

/// Every value of a record by where it stands, without times and how they were taken.
Json values_of(RunRecord const& run) {
  Json record = to_json(run);
  if (Json& cost = record["cost"]; cost.is_object()) {
    for (char const* key : {"seconds", "cpu_seconds", "setup_seconds", "median_seconds", "low_seconds",
                            "high_seconds", "busy", "repeats", "batch", "warm_up", "occasion", "round_seconds"}) {
      cost.erase(key);
    }
    if (!run.cost->is_counted()) cost.erase("peak_bytes");  // of a process it is never twice the same
  }
  return record.flatten();
}

Number error_at(RunRecord const& run, Agreement::Difference const& place) {
  RegionError const* const error = find_error(run, place.field, place.region);
  if (error == nullptr) return std::nullopt;
  double const value = norm_of(error->error, place.norm);
  return std::isfinite(value) ? Number(value) : std::nullopt;
}

double relative_difference(Number const& a, Number const& b) {
  if (a == b) return 0.0;
  if (!a || !b) return 1.0;
  return std::abs(*a - *b) / std::max(std::abs(*a), std::abs(*b));
}

void find_worst_error(RunRecord const& before, RunRecord const& now, Agreement& found) {
  std::set<std::pair<std::string, std::string>> places;
  for (RunRecord const* run : {&before, &now}) {
    for (auto const& [field, regions] : run->errors) {
      for (auto const& [region, error] : regions) places.emplace(field, region);
    }
  }
  for (auto const& [field, region] : places) {
    for (char const* norm : {"l1", "l2", "linf"}) {
      Agreement::Difference one{field, region, norm, {}, {}};
      one.before = error_at(before, one);
      one.now = error_at(now, one);
      one.relative = relative_difference(one.before, one.now);
      if (one.relative > (found.worst_error ? found.worst_error->relative : 0.0)) found.worst_error = one;
    }
  }
}

}  // namespace

Agreement agreement(RunRecord const& before, RunRecord const& now) {
  Agreement found;
  Json const old_values = values_of(before);
  Json const new_values = values_of(now);
  auto const note = [&](std::string const& place, bool is_same) {
    ++found.numbers;
    if (is_same) return;
    if (++found.differing == 1) found.first_differing = place.substr(1);
  };
  for (auto const& [place, value] : old_values.items()) {
    auto const other = new_values.find(place);
    bool const is_in_both = other != new_values.end();
    if (value.is_number() || (is_in_both && other->is_number())) note(place, is_in_both && value == *other);
  }
  for (auto const& [place, value] : new_values.items()) {
    if (value.is_number() && !old_values.contains(place)) note(place, false);
  }
  find_worst_error(before, now, found);
  return found;
}

std::string agreement_text(Agreement const& found) {
  if (found.differing == 0) return fmt::format("all {} agree to the bit", found.numbers);
  std::string const count = fmt::format("{} of {} differ", found.differing, found.numbers);
  if (!found.worst_error)
    return fmt::format("{}, no error among them; the first is {}", count, found.first_differing);
  auto const& [field, region, norm, before, now, relative] = *found.worst_error;
  return fmt::format("{}, of the errors most {} {} {}: {} of it ({}, now {})", count, field, region, norm,
                     scientific(relative), scientific(before), scientific(now));
}

}  // namespace sphverify
