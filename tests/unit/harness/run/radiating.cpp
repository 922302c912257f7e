// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/run/frozen_conduction.hpp"
#include "tests/support/runs.hpp"

// Runs in which a wall loses heat by the temperature that the run finds there.
BOOST_AUTO_TEST_SUITE(harness_run_radiating)

using namespace sphverify;
using namespace sphverify::tests;

constexpr char const* radiating = "extreme/radiative-cooling";

RunChoice choice_of(std::string const& formulation, int resolution, char const* closure) {
  RunChoice choice{.scene_case = radiating, .formulation = formulation, .resolution = resolution};
  choice.discretisation.closure = closure;
  return choice;
}

double error(RunRecord const& record) { return record.errors.at("temperature").at("all").error.l2; }

BOOST_AUTO_TEST_CASE(every_integrator_gives_every_form_the_same_error) {
  for (std::string const& formulation : conduction_schemes()) {
    for (char const* closure : {"interpolated", "quotient", "one-sided"}) {
      RunChoice choice = choice_of(formulation, 25, closure);
      choice.discretisation.integrator = "bdf";
      RunRecord const expected = run(choice);
      BOOST_TEST_REQUIRE(expected.status == "ok", formulation << ": " << expected.reason);
      for (char const* integrator : {"runge-kutta", "runge-kutta-chebyshev", "implicit-runge-kutta"}) {
        choice.discretisation.integrator = integrator;
        RunRecord const record = run(choice);
        BOOST_TEST_CONTEXT(formulation << " " << closure << " " << integrator) {
          BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
          BOOST_TEST(error(record) == error(expected), boost::test_tools::tolerance(0.02));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(brookshaws_form_converges_and_its_wall_loses_what_it_should) {
  RunChoice choice = choice_of("conduction/brookshaw", 50, "quotient");
  choice.smoothing_ratio = 1.0;
  MeasureSet const both{Measure::error, Measure::conservation};
  RunRecord const coarse = run(choice, both);
  choice.resolution = 100;
  RunRecord const fine = run(choice, both);
  BOOST_TEST(error(fine) < 0.7 * error(coarse));
  BOOST_TEST(error(fine) < 2e-4);
  for (RunRecord const* record : {&coarse, &fine}) {
    WallFlux const& wall = record->wall_flux.at(0);
    BOOST_TEST(wall.measured < 0.0);
    BOOST_TEST(std::abs(wall.measured - wall.exact) < 0.005 * std::abs(wall.exact));
    BOOST_TEST(std::abs(record->conservation.at("energy").pair_drift.value()) < 1e-12);
  }
}

// Of a rate that is not affine in the temperatures the matrix depends on where it is taken.
BOOST_AUTO_TEST_CASE(the_jacobian_is_that_of_the_state_it_is_asked_for) {
  Case const* const one = find_case(radiating);
  auto const problem = std::get<Problem<1>>(one->problem(Parameters(one->info.parameters)));
  for (std::string const& formulation : conduction_schemes()) {
    SceneChoice choice{.formulation = formulation,
                       .walls = true,
                       .discretisation = jittered_by(0.1, 4),
                       .resolution = 20,
                       .smoothing_ratio = 1.2,
                       .threads = 1};
    choice.discretisation.closure = "quotient";
    FrozenConduction<1> conduction(problem, choice, 1.0);
    ColouredJacobian& jacobian = conduction.jacobian();
    std::vector<double> T(20, 1.0);
    auto const rate = [&](std::vector<double> const& at) {
      std::vector<double> out(20);
      conduction.evaluate(0.0, at.data());
      conduction.scene().heating(0.0, out.data());
      return out;
    };
    std::vector<double> const hot = jacobian.evaluate(0.0, T.data());
    T.assign(20, 0.3);
    std::vector<double> const cold = jacobian.evaluate(0.0, T.data());
    BOOST_TEST(hot != cold);
    DependencyPattern const& pattern = jacobian.pattern();
    double largest = 0.0;
    for (double const value : cold) largest = std::max(largest, std::abs(value));
    for (std::size_t row = 0; row < 20; ++row) {
      for (auto k = pattern.first[row]; k < pattern.first[row + 1]; ++k) {
        std::vector<double> up = T, down = T;
        up[pattern.column[k]] += 1e-4;
        down[pattern.column[k]] -= 1e-4;
        double const slope = (rate(up)[row] - rate(down)[row]) / 2e-4;
        BOOST_TEST(std::abs(cold[k] - slope) < 1e-5 * largest, formulation << " " << row);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wall_in_two_dimensions_loses_what_it_does_in_one) {
  for (std::string const& formulation : conduction_schemes()) {
    RunChoice choice = choice_of(formulation, 20, "quotient");
    RunRecord const line = run(choice);
    choice.parameters = {{"dimension", 2.0}};
    RunRecord const plane = run(choice);
    BOOST_TEST_REQUIRE(plane.status == "ok", plane.reason);
    BOOST_TEST(plane.wall_flux.at(0).exact == line.wall_flux.at(0).exact,
               boost::test_tools::tolerance(1e-12));
    BOOST_TEST(plane.wall_flux.at(0).measured == line.wall_flux.at(0).measured,
               boost::test_tools::tolerance(0.05));
  }
}

BOOST_AUTO_TEST_SUITE_END()
