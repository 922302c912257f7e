// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/series_json.hpp"

#include "reports/json/checked_numbers.hpp"
#include "reports/json/lists_json.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

ObservedOrder read_order(Node const& node) {
  ObservedOrder o;
  o.order = optional_number(node.at("order"));
  if (Node const interval = node.at("interval"); !interval.is_null()) {
    auto const [lower, upper] = read_ends(interval);
    o.lower = lower;
    o.upper = upper;
  }
  for (Node const& p : node.at("pairwise").elements()) o.pairwise.push_back(optional_number(p));
  o.verdict =
      node.at("verdict").word({"asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined"});
  o.reason = node.at("reason").string();
  // Documents of versions before 0.2 have none of what follows.
  if (auto const model = node.find("model")) o.model = optional_string(*model);
  if (auto const law = node.find("law"); law && !law->is_null()) {
    o.law =
        ErrorLaw{measured(law->at("floor")), measured(law->at("coefficient")), measured(law->at("exponent")),
                 measured(law->at("next_coefficient")), measured(law->at("next_exponent"))};
  }
  if (auto const floor = node.find("floor"); floor && !floor->is_null()) {
    auto const [lower, upper] = read_ends(floor->at("interval"));
    o.floor = ErrorFloor{size_of(floor->at("value")), lower, upper};
  }
  if (auto const targets = node.find("targets")) {
    for (Node const& t : targets->elements()) {
      o.targets.push_back({size_of(t.at("error")), optional_size(t.at("relative")), optional_size(t.at("N")),
                           t.at("remark").string()});
    }
  }
  return o;
}

}  // namespace

Series read_series(Node const& node) {
  Series s;
  s.case_id = node.at("case").string();
  s.parameters = read_parameters(node.at("parameters"));
  s.formulation = read_formulation(node);
  s.label = node.at("label").string();
  s.discretisation = read_discretisation(node.at("discretisation"));
  s.smoothing_exponent = node.at("smoothing_exponent").number();
  s.discontinuous = node.at("discontinuous").boolean();
  if (auto const apart = node.find("is_timed_apart")) s.is_timed_apart = apart->boolean();
  for (Node const& run : node.at("runs").elements()) s.runs.push_back(count(run));
  for (Node const& entry : node.at("orders").elements()) {
    OrderEntry e{entry.at("field").string(),   entry.at("region").string(), entry.at("norm").string(),
                 entry.at("allowed").number(), read_order(entry),           {}};
    for (Node const& level : entry.at("levels").elements()) {
      e.levels.push_back({read_resolution(level), size_of(level.at("spacing")),
                          static_cast<int>(count(level.at("replicates"))), optional_size(level.at("error")),
                          optional_size(level.at("spread")), optional_size(level.at("seconds")),
                          read_median(level), found_number(level, "mean")});
    }
    s.orders.push_back(std::move(e));
  }
  for (Node const& t : node.at("time_to_error").elements()) {
    s.time_to_error.push_back({t.at("field").string(), t.at("region").string(), t.at("norm").string(),
                               size_of(t.at("relative")), size_of(t.at("error")),
                               optional_size(t.at("seconds")), t.at("is_bound").boolean(), read_median(t)});
  }
  return s;
}

}  // namespace sphverify
