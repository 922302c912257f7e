// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "harness/gate/gates.hpp"
#include "harness/gate/read_gates.hpp"
#include "harness/measure/series.hpp"
#include "tests/support/documents.hpp"

// Results and gates made by hand, with numbers that are easy to check.
namespace sphverify::tests {

/// A run of slab-dirichlet whose l2 error is as given, linf twice that; the exact field's norms are 1, 2, 4.
inline RunRecord run_at(int resolution, double error,
                        std::string const& formulation = "conduction/brookshaw") {
  RunRecord run;
  run.case_id = "conduction/slab-dirichlet";
  run.formulation.id = run.label = formulation;
  run.resolution = resolution;
  run.spacing = 1.0 / resolution;
  run.errors["temperature"]["all"] = {{0.5 * error, error, 2.0 * error}, {1.0, 2.0, 4.0}, 1e-15};
  run.errors["temperature"]["wall"] = {{error, 3.0 * error, 6.0 * error}, {1.0, 2.0, 4.0}, 1e-15};
  return run;
}

inline RunRecord failed_at(int resolution, std::string const& formulation = "conduction/brookshaw") {
  RunRecord run = run_at(resolution, 1.0, formulation);
  run.errors.clear();
  run.status = "unstable";
  run.reason = "the temperature ran away";
  return run;
}

inline RunRecord seeded(RunRecord run, std::uint64_t seed) {
  run.discretisation.layout = {"jittered", 0.1, seed};
  return run;
}

inline RunRecord timed(RunRecord run, double seconds, std::uint64_t steps = 10) {
  Cost& cost = run.cost.emplace();
  cost.seconds = seconds;
  cost.steps = cost.rate_evaluations = steps;
  return run;
}

/// With a median and its interval.
inline RunRecord timed_within(RunRecord run, double low, double median, double high) {
  run = timed(run, low);
  run.cost->median = {median, low, high};
  return run;
}

inline Results results_of(std::vector<RunRecord> const& runs) {
  Results results;
  results.study = R"({"name": "by hand"})";
  results.runs = runs;
  results.series = build_series(runs);
  return results;
}

/// Errors 1e-2, 2.5e-3, ... : of second order, without scatter.
inline std::vector<RunRecord> second_order(std::string const& formulation = "conduction/brookshaw") {
  return {run_at(25, 16e-4, formulation), run_at(50, 4e-4, formulation), run_at(100, 1e-4, formulation)};
}

/// Second order on average, with scatter: the interval is wide.
inline std::vector<RunRecord> scattered() {
  return {run_at(25, 18e-4), run_at(50, 3.7e-4), run_at(100, 1.1e-4), run_at(200, 0.23e-4),
          run_at(400, 0.066e-4)};
}

/// Results whose first ladder has these l2 orders in all regions, whatever its levels are.
inline Results with_order(Results results, std::string const& verdict, Number const& order,
                          Number const& lower = {}, Number const& upper = {}) {
  for (OrderEntry& entry : results.series.at(0).orders) {
    entry.observed.verdict = verdict;
    entry.observed.reason = "made by hand";
    entry.observed.order = order;
    entry.observed.lower = lower;
    entry.observed.upper = upper;
  }
  return results;
}

/// A gates document around gates, each the text of an object without its braces and name.
inline Json gates_document(std::vector<std::string> const& gates) {
  Json document = {{"schema", "sphverify-gates/1"}, {"gates", Json::array()}};
  for (std::string const& gate : gates) {
    Json one = Json::parse("{" + gate + "}");
    if (!one.contains("name")) one["name"] = "gate " + std::to_string(document["gates"].size());
    if (!one.contains("select")) one["select"] = Json::object();
    document["gates"].push_back(one);
  }
  return document;
}

inline Gates read(Json const& document) { return read_gates(Node(document, "gates.json")); }

inline Gates gates_of(std::string const& gate) { return read(gates_document({gate})); }

inline Gate gate_of(std::string const& gate) { return gates_of(gate).gates.at(0); }

/// Whether a text holds another.
inline bool says(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace sphverify::tests
