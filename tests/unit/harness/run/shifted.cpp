// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shifted.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "reports/json/results_json.hpp"
#include "tests/support/runs.hpp"

// No number of a run may depend on where the origin is: domains that do not begin at 0 are what a mistake in
// wrapping, placing or measuring shows on.
BOOST_AUTO_TEST_SUITE(harness_run_shifted)

using namespace sphverify;
using namespace sphverify::tests;

double const shift[3] = {-2.375, 1.8125, 3.4375};

/// The case that is to be run elsewhere.
Case const* original = nullptr;

AnyProblem elsewhere(Parameters const& parameters) {
  return std::visit(
      []<int Dim>(Problem<Dim> const& problem) -> AnyProblem {
        Vector<Dim> by;
        for (int k = 0; k < Dim; ++k) by[k] = shift[k];
        return shifted(problem, by);
      },
      original->problem(parameters));
}

/// Two documents of one run, one of them made elsewhere.
class Comparison {
 public:
  std::size_t numbers = 0;
  std::string first_difference;

  void compare(Json const& here, Json const& there, std::string const& path) {
    if (here.type() != there.type() && !(here.is_number() && there.is_number()))
      return differ(path, here, there);
    bool const is_place = path.ends_with("position") || path.ends_with("centre");
    if (here.is_number())
      return compare(here.get<double>(), there.get<double>() - (is_place ? shift[0] : 0.0), path);
    if (!here.is_structured()) {
      if (here != there) differ(path, here, there);
      return;
    }
    if (here.size() != there.size()) return differ(path, here, there);
    if (here.is_array()) {
      bool const is_point = is_place && !here.empty() && here[0].is_number() && here.size() <= 3;
      for (std::size_t k = 0; k < here.size(); ++k) {
        if (is_point) {
          compare(here[k].get<double>(), there[k].get<double>() - shift[k], path);
        } else {
          compare(here[k], there[k], path);
        }
      }
      return;
    }
    for (auto const& [key, value] : here.items()) {
      // How often something ran, and how long a step was, go with the rounding of an adaptive step.
      if (key == "passes" || key == "integration" || key == "steps_bound_by") continue;
      if (!there.contains(key)) return differ(path + "." + key, value, Json());
      compare(value, there[key], path + "." + key);
    }
  }

 private:
  void compare(double here, double there, std::string const& path) {
    ++numbers;
    // Errors and drifts are small differences of numbers near 1.
    if (std::abs(here - there) > 1e-5 * std::abs(here) + 1e-8) differ(path, here, there);
  }
  void differ(std::string const& path, Json const& here, Json const& there) {
    if (first_difference.empty())
      first_difference = path + ": " + here.dump() + ", elsewhere " + there.dump();
  }
};

struct Scene {
  RunChoice choice;
  std::string work = "", conduction = "";
  MeasureSet measure = {Measure::error, Measure::conservation, Measure::profile};
};

Discretisation placed(LayoutChoice const& layout) {
  Discretisation d;
  d.layout = layout;
  return d;
}

Discretisation gas(std::string const& density, LayoutChoice const& layout = {"lattice"},
                   ViscosityChoice viscosity = {1.0, 2.0}) {
  Discretisation d = placed(layout);
  d.density = density;
  d.integrator = "leapfrog";
  d.viscosity = viscosity;
  return d;
}

void is_the_same_elsewhere(Scene const& scene) {
  RunSpec spec = make_spec(scene.choice);
  spec.formulation.work = scene.work;
  spec.formulation.conduction = scene.conduction;
  RunOptions options;
  options.measure = scene.measure;
  RunRecord const here = execute(spec, options);
  BOOST_TEST_CONTEXT(scene.choice.scene_case << ", " << scene.choice.discretisation.layout.id) {
    BOOST_TEST_REQUIRE(here.status == "ok", here.reason);
    original = spec.scene_case;
    Case const moved{original->info, elsewhere};
    spec.scene_case = &moved;
    RunRecord const there = execute(spec, options);
    BOOST_TEST_REQUIRE(there.status == "ok", there.reason);
    Comparison comparison;
    comparison.compare(to_json(here), to_json(there), "");
    BOOST_TEST(comparison.first_difference == "");
    BOOST_TEST(comparison.numbers > 100u);
  }
}

BOOST_AUTO_TEST_CASE(heat_conduction_is_the_same_elsewhere_in_every_layout) {
  MeasureSet const all{Measure::error,      Measure::conservation, Measure::profile,
                       Measure::second_law, Measure::stability,    Measure::history};
  for (LayoutChoice const& layout :
       {LayoutChoice{"lattice"}, {"jittered", 0.3, 1}, {"clumped", 0.3}, {"touching", 0.1}})
    is_the_same_elsewhere({.choice = {.resolution = 20, .discretisation = placed(layout)}, .measure = all});
  for (LayoutChoice const& layout :
       {LayoutChoice{"lattice"}, {"jittered", 0.3, 1}, {"hexagonal"}, {"glass", 0.0, 1}}) {
    is_the_same_elsewhere({.choice = {.resolution = 10,
                                      .discretisation = placed(layout),
                                      .parameters = {{"dimension", 2.0}, {"turn", 30.0}}},
                           .measure = all});
  }
  is_the_same_elsewhere(
      {.choice = {
           .resolution = 6, .discretisation = placed({"close-packed"}), .parameters = {{"dimension", 3.0}}}});
}

BOOST_AUTO_TEST_CASE(every_conduction_case_is_the_same_elsewhere) {
  for (Case const& one : all_cases()) {
    if (one.info.kind != CaseKind::conduction) continue;
    is_the_same_elsewhere(
        {.choice = {.scene_case = one.info.id, .formulation = "conduction/lucy-flux", .resolution = 20}});
  }
}

BOOST_AUTO_TEST_CASE(rates_are_the_same_elsewhere) {
  for (char const* formulation : {"conduction/campbell-flux", "momentum/p-rho2", "work/total-energy"}) {
    for (double const dimension : {1.0, 2.0}) {
      is_the_same_elsewhere({.choice = {.scene_case = "operator/sine",
                                        .formulation = formulation,
                                        .resolution = 12,
                                        .discretisation = placed({"jittered", 0.2, 3}),
                                        .parameters = {{"dimension", dimension}}},
                             .measure = {Measure::error, Measure::profile}});
    }
  }
}

BOOST_AUTO_TEST_CASE(moving_gas_is_the_same_elsewhere) {
  Discretisation adaptive = gas("normalised", {"equal-mass"});
  adaptive.smoothing = "adaptive";
  Discretisation pressed = gas("continuity");
  pressed.closure = "one-sided";
  using Values = std::vector<std::pair<std::string, ParameterValue>>;
  for (auto const& [id, resolution, discretisation, parameters] :
       {std::tuple<char const*, int, Discretisation, Values>{
            "hydro/gresho", 20, gas("continuity", {"lattice"}, {}), {{"final_time", 0.1}}},
        {"hydro/acoustic",
         30,
         gas("summation", {"jittered", 0.1, 2}),
         {{"boundary", std::string("periodic")}}},
        {"hydro/riemann", 60, adaptive, {{"final_time", 0.05}}},
        {"hydro/riemann", 41, gas("normalised"), {{"final_time", 0.02}}},
        {"hydro/noh", 12, gas("normalised"), {{"dimension", 2.0}, {"final_time", 0.1}}},
        {"hydro/sedov", 12, pressed, {{"dimension", 2.0}, {"final_time", 0.02}}},
        {"hydro/piston-velocity", 30, gas("continuity", {"touching", 0.3}), {{"final_time", 0.2}}},
        {"hydro/piston-pressure", 30, gas("continuity", {"clumped", 0.8}), {{"final_time", 0.2}}},
        {"hydro/simple-wave",
         30,
         gas("continuity"),
         {{"final_time", 0.1}, {"drive", std::string("pressure")}}},
        {"hydro/manufactured",
         30,
         gas("continuity"),
         {{"final_time", 0.05}, {"drive", std::string("both")}}}}) {
    is_the_same_elsewhere(
        {.choice = {.scene_case = id,
                    .formulation = "momentum/p-rho2",
                    .resolution = resolution,
                    .discretisation = discretisation,
                    .parameters = parameters},
         .work = "work/internal-energy",
         .measure = {Measure::error, Measure::conservation, Measure::profile, Measure::history}});
  }
  is_the_same_elsewhere({.choice = {.scene_case = "coupled/hot-wall",
                                    .formulation = "momentum/p-rho2",
                                    .resolution = 20,
                                    .discretisation = gas("continuity", {"lattice"}, {}),
                                    .parameters = {{"final_time", 0.02}}},
                         .work = "work/internal-energy",
                         .conduction = "conduction/brookshaw"});
}

BOOST_AUTO_TEST_SUITE_END()
