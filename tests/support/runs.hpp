// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/run/run.hpp"

// Runs of one case, one formulation and one discretisation, as a study would make them.
namespace sphverify::tests {

struct RunChoice {
  std::string scene_case = "conduction/slab-dirichlet";
  std::string formulation = "conduction/brookshaw";
  int resolution = 25;
  double smoothing_ratio = 1.2;
  bool walls = true;
  Discretisation discretisation = {};
  std::vector<std::pair<std::string, ParameterValue>> parameters = {};
};

inline RunSpec make_spec(RunChoice const& choice) {
  Case const* const scene_case = find_case(choice.scene_case);
  if (scene_case == nullptr) throw std::logic_error("no such case: " + choice.scene_case);
  Parameters parameters(scene_case->info.parameters);
  for (auto const& [name, value] : choice.parameters) parameters.set(name, value);
  FormulationChoice const formulation{
      .id = choice.formulation, .work = "", .conduction = "", .walls = choice.walls};
  return {.scene_case = scene_case,
          .parameters = parameters,
          .formulation = formulation,
          .label = choice.formulation,
          .discretisation = choice.discretisation,
          .smoothing_exponent = 0.0,
          .resolution = choice.resolution,
          .smoothing_ratio = choice.smoothing_ratio};
}

inline RunRecord run(RunChoice const& choice, MeasureSet measure = {Measure::error},
                     double time_budget = 0.0) {
  RunOptions options;
  options.measure = measure;
  options.time_budget = time_budget;
  return execute(make_spec(choice), options);
}

inline Discretisation jittered_by(double amplitude, std::uint64_t seed) {
  Discretisation discretisation;
  discretisation.layout = {"jittered", amplitude, seed};
  return discretisation;
}

inline Discretisation weighted(std::string const& face_weight) {
  Discretisation discretisation;
  discretisation.face_weight = face_weight;
  return discretisation;
}

inline Discretisation with_density(std::string const& density) {
  Discretisation discretisation;
  discretisation.density = density;
  return discretisation;
}

inline std::vector<std::string> const& conduction_schemes() {
  static std::vector<std::string> const ids{"conduction/brookshaw", "conduction/lucy-flux",
                                            "conduction/campbell-flux"};
  return ids;
}

}  // namespace sphverify::tests
