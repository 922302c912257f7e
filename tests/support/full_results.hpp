// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/results.hpp"

namespace sphverify::tests {

/// A run with everything that a run can have, no two numbers alike.
inline RunRecord full_run() {
  RunRecord r;
  r.case_id = "operator/sine";
  r.parameters["dimension"] = 2.0;
  r.parameters["phase"] = 1.0 / 3.0;
  r.parameters["preset"] = std::string("sod");
  r.parameters["left"] = std::vector<double>{1.0, 0.5, 1e-300};
  r.parameters["modes"] = std::vector<std::vector<double>>{{1.0, 0.1}, {3.0, 0.7}};
  r.formulation = {"momentum/p-rho2", "work/total-energy", "conduction/brookshaw", false};
  r.label = "a label with \"quotes\", ä and\nlines";
  r.discretisation = {"cubic-spline", "summation", 1.1,           {"jittered", 0.15, 12345678901234ull},
                      "balanced",     "one-sided", "runge-kutta", "adaptive",
                      "mass",         {1.5, 2.5}};
  r.smoothing_exponent = 0.5;
  r.resolution = 40;
  r.particles = 1600;
  r.spacing = 0.025;
  r.smoothing_length = 0.0275;
  r.status = "unstable";
  r.reason = "because";
  r.scene.fields = {"position", "mass"};
  r.scene.passes = {{"kernel", 1}, {"flux", 20}};
  r.errors["temperature"]["all"] = {{0.1, 0.2, 0.3}, {1.1, 1.2, 1.3}, 1e-14};
  r.errors["temperature"]["wall"] = {{0.4, 0.5, 0.6}, {1.4, 1.5, 1.6}, 2e-14};
  r.errors["flux"]["all"] = {{0.7, 0.8, 0.9}, {1.7, 1.8, 1.9}, 3e-14};
  r.errors["temperature"]["wall"].initial = NormSet{0.44, 0.55, 0.66};
  r.errors["temperature"]["wall"].mean = -0.33;
  Budget energy;
  energy.initial = 2.1;
  energy.final = 2.2;
  energy.exchanged = 0.05;
  energy.drift = 0.06;
  r.conservation["mass"] = energy;
  energy.wall_budget_defect = -0.07;
  r.conservation["energy"] = energy;
  WallFlux flux;
  flux.measured = 3.1;
  flux.exact = 3.2;
  flux.error = -0.1;
  r.wall_flux = {flux, WallFlux{}};
  Cost cost;
  cost.seconds = 4.1;
  cost.cpu_seconds = 4.2;
  cost.setup_seconds = 0.4;
  cost.median = {4.3, 4.15, 4.6};
  cost.busy = 0.97;
  cost.repeats = 3;
  cost.batch = 64;
  cost.warm_up = true;
  cost.occasion = "0123abcd";
  cost.round_seconds = {4.1, 4.3, 4.6};
  cost.steps = 44;
  cost.rate_evaluations = 45;
  cost.pair_interactions = 9007199254740993ull;  // more than a double can count
  cost.peak_bytes = 47;
  r.cost = cost;
  Stability stability;
  stability.spectral_abscissa = 5.1;
  stability.abscissa_uncertainty = 5.15;
  stability.spectral_radius = 5.2;
  stability.largest_imaginary = 5.3;
  stability.growing_modes = 6;
  stability.unseen_modes = 7;
  stability.method = "dense";
  stability.worst_mode = Mode{5.4, 5.5, 5.6, std::nullopt, {0.1, 0.2}};
  stability.stable_steps["heun"] = {0.3, 0.31, "as far as tried"};
  stability.modes = {Mode{-1.0, 2.0, std::nullopt, 0.4, {0.3, 0.4}}};
  stability.remark = "a mode grows";
  r.stability = stability;
  r.second_law =
      SecondLaw{{0.11, 0.12, {0.13}}, {0.0, 0.0, {}}, {0.14, 0.15, {0.16}}, -0.17, "entropy fell", 385};
  r.integration = Integration{"bdf", 1e-6, 2e-6, 0.5, 7e-9, 0.003, "an upper bound"};
  r.remarks = {"support wider than the domain", "another"};
  r.smallest_face_weight = Number(-0.3);
  Profile profile;
  profile.position = {{0.1, 0.2}, {0.3, 0.4}};
  profile.weight = {0.25, 0.75};
  profile.regions = {{"all", {0, 1}}, {"wall", {1}}};
  profile.computed["velocity"] = {{1.0, 2.0}, {3.0, 4.0}};
  profile.exact["velocity"] = {{1.5, 2.5}, {3.5, 4.5}};
  r.profile = profile;
  r.history = History{{0.0, 1.0}, {2.0, 3.0}, {4.0, 5.0}, {}, {}, {}};
  r.spectrum = {{-1.0, 0.5}, {-1.0, -0.5}};
  return r;
}

inline Results full_results() {
  Results results;
  results.context.version = "1.2";
  results.context.commit = "abc";
  results.context.compiler = "gcc";
  results.context.flags = "-O2";
  results.context.processor = "some";
  results.context.date = "2026-01-01T00:00:00Z";
  results.context.cores = 2;
  results.study = R"({"schema":"sphverify-study/1","name":"s"})";
  results.runs = {full_run(), RunRecord{}};
  Series series;
  series.case_id = "operator/sine";
  series.label = "l";
  series.parameters["phase"] = 0.25;
  series.formulation.id = "momentum/p-rho2";
  series.smoothing_exponent = 0.5;
  series.runs = {1, 0};
  OrderEntry entry;
  entry.field = "temperature";
  entry.region = "all";
  entry.norm = "l2";
  entry.observed.order = 1.5;
  entry.observed.lower = 1.4;
  entry.observed.upper = 1.6;
  entry.observed.pairwise = {1.45, std::nullopt};
  entry.observed.verdict = "asymptotic";
  entry.observed.reason = "why";
  entry.observed.model = "floor";
  entry.observed.law = ErrorLaw{0.01, 0.09, 1.5, 0.2, 2.0};
  entry.observed.floor = ErrorFloor{0.01, 0.008, 0.012};
  entry.observed.targets = {{0.02, 0.05, 77.0, "beyond the levels"},
                            {0.005, std::nullopt, std::nullopt, "never"}};
  entry.levels = {{25, 0.04, 5, 0.1, 0.01, 2.5, {2.6, 2.55, 2.7}, -0.06},
                  {50, 0.02, 5, std::nullopt, std::nullopt, std::nullopt}};
  OrderEntry without;
  without.field = "flux";
  without.region = "wall";
  without.norm = "l1";
  without.observed.verdict = "not-refined";
  series.orders = {entry, without};
  series.time_to_error = {{"temperature", "all", "l2", 0.1, 0.2, 3.5, false, {3.6, 3.55, 3.7}},
                          {"temperature", "all", "l2", 0.01, 0.02, std::nullopt}};
  results.series = {series};
  results.skipped = {{"c", "f", "no sense"}};
  return results;
}

}  // namespace sphverify::tests
