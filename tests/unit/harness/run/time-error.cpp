// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/measure/norms.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/run/frozen_conduction.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_time_error)

using namespace sphverify;
using namespace sphverify::tests;

/// The errors of the same run, integrated to a relative 1e-12.
template <int Dim>
FieldErrors reference_errors(Problem<Dim> const& problem, RunSpec const& spec) {
  SceneChoice const choice{.formulation = spec.formulation.id,
                           .walls = spec.formulation.walls,
                           .discretisation = spec.discretisation,
                           .resolution = spec.resolution,
                           .smoothing_ratio = spec.smoothing_ratio,
                           .threads = 1};
  FrozenConduction<Dim> conduction(problem, choice, 1.0);
  OdeResult const result = conduction.integrate("bdf", problem.final_time, {1e-12, 1e-12}, false, {});
  Particles<Dim> const& particles = conduction.scene().particles();
  auto const exact = sample(problem.scalars.at(Field::temperature), particles, problem.final_time);
  return field_errors({result.y}, {exact}, exact_volumes(problem, particles, problem.final_time),
                      regions(particles, problem.walls), 0.0);
}

FieldErrors reference_errors(RunChoice const& choice) {
  RunSpec const spec = make_spec(choice);
  return std::visit([&](auto const& problem) { return reference_errors(problem, spec); },
                    spec.scene_case->problem(spec.parameters));
}

/// Largest relative difference between two sets of errors, where it is more than rounding.
double largest_difference(FieldErrors const& found, FieldErrors const& expected) {
  double largest = 0.0;
  for (auto const& [region, e] : expected) {
    RegionError const& f = found.at(region);
    for (double NormSet::*norm : {&NormSet::l1, &NormSet::l2, &NormSet::linf}) {
      double const difference = std::abs(f.error.*norm - e.error.*norm);
      if (difference > f.round_off) largest = std::max(largest, difference / (e.error.*norm));
    }
  }
  return largest;
}

void check(RunChoice const& choice) {
  RunRecord const record = run(choice);
  BOOST_TEST_CONTEXT(choice.scene_case << " " << choice.formulation << " N = " << choice.resolution) {
    BOOST_TEST(record.status == "ok", record.reason);
    double const difference = largest_difference(record.errors.at("temperature"), reference_errors(choice));
    BOOST_TEST_MESSAGE(choice.scene_case << " " << choice.formulation << ": " << difference << " at "
                                         << *record.integration->relative_tolerance);
    BOOST_TEST(difference < 0.01);
    BOOST_TEST(record.integration->time_error_share.value() <= 0.01);
  }
}

BOOST_AUTO_TEST_CASE(the_time_error_is_below_a_hundredth_of_the_space_error_for_every_scheme_and_case) {
  for (std::string const& formulation : conduction_schemes()) {
    for (char const* scene_case :
         {"conduction/slab-dirichlet", "conduction/slab-insulated", "conduction/slab-flux",
          "conduction/half-space-step", "conduction/manufactured", "conduction/barenblatt"}) {
      check({.scene_case = scene_case, .formulation = formulation, .resolution = 60});
    }
  }
  check({.scene_case = "conduction/marshak", .resolution = 60});
}

BOOST_AUTO_TEST_CASE(the_time_error_is_below_a_hundredth_of_even_a_tiny_space_error) {
  RunChoice choice{.resolution = 200, .smoothing_ratio = 1.0, .discretisation = weighted("balanced")};
  check(choice);
  BOOST_TEST(*run(choice).integration->relative_tolerance <= 1e-6);
}

BOOST_AUTO_TEST_CASE(the_time_error_is_below_a_hundredth_on_disorder_and_in_two_dimensions) {
  check({.resolution = 50, .discretisation = jittered_by(0.1, 3)});
  check({.scene_case = "conduction/manufactured", .resolution = 10, .parameters = {{"dimension", 2.0}}});
}

BOOST_AUTO_TEST_CASE(the_explicit_method_gives_the_same_errors_as_the_implicit_one) {
  for (std::string const& formulation : conduction_schemes()) {
    for (char const* scene_case : {"conduction/slab-dirichlet", "conduction/manufactured"}) {
      RunChoice choice{.scene_case = scene_case, .formulation = formulation, .resolution = 40};
      RunRecord const implicit = run(choice);
      choice.discretisation.integrator = "runge-kutta";
      RunRecord const explicit_one = run(choice);
      BOOST_TEST(implicit.integration->method == "bdf");
      BOOST_TEST(explicit_one.integration->method == "runge-kutta");
      BOOST_TEST(largest_difference(explicit_one.errors.at("temperature"),
                                    implicit.errors.at("temperature")) < 0.01);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
