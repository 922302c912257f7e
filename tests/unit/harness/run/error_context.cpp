// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/error_context.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_error_context)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;
using std::numbers::pi;

RunRecord gas(std::string const& scene_case, int resolution,
              std::vector<std::pair<std::string, ParameterValue>> const& parameters,
              std::string const& integrator = "leapfrog") {
  Discretisation d;
  d.density = "continuity";
  d.integrator = integrator;
  d.viscosity = integrator == "leapfrog" ? ViscosityChoice{1.0, 2.0} : ViscosityChoice{};
  RunSpec spec = make_spec({.scene_case = scene_case,
                            .formulation = "momentum/p-rho2",
                            .resolution = resolution,
                            .discretisation = d,
                            .parameters = parameters});
  spec.formulation.work = "work/internal-energy";
  RunOptions options;
  options.measure = {Measure::error, Measure::profile};
  RunRecord const record = execute(spec, options);
  BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
  return record;
}

BOOST_AUTO_TEST_CASE(initial_is_the_norm_of_what_happened_at_the_places_of_the_particles) {
  int const n = 20;
  RunRecord const record = run({.resolution = n});
  auto const change = [](double x) {
    auto const mode = [&](int m, double a) {
      return a * std::sin(m * pi * x) * std::expm1(-m * m * pi * pi * 0.05);
    };
    return mode(1, 1.0) + mode(3, 0.5);
  };
  double squares = 0.0;
  double largest = 0.0;
  for (int i = 0; i < n; ++i) {
    double const x = (i + 0.5) / n;
    squares += change(x) * change(x) / n;
    largest = std::max(largest, std::abs(change(x)));
  }
  RegionError const& all = record.errors.at("temperature").at("all");
  BOOST_TEST_REQUIRE(all.initial.has_value());
  BOOST_TEST(all.initial->l2 == std::sqrt(squares), tolerance(1e-10));
  BOOST_TEST(all.initial->linf == largest, tolerance(1e-10));
  // Within 2h = 0.12 of a wall there are two, of which the farther one has seen more.
  BOOST_TEST(record.errors.at("temperature").at("wall").initial->linf == std::abs(change(1.5 / n)),
             tolerance(1e-10));
  BOOST_TEST(!all.allowed.has_value());
}

BOOST_AUTO_TEST_CASE(mean_is_that_of_computed_less_exact_along_the_profile) {
  RunRecord const record = run({.resolution = 20}, {Measure::error, Measure::profile});
  Profile const& profile = *record.profile;
  double mean = 0.0;
  for (std::size_t i = 0; i < 20; ++i)
    mean += (profile.computed.at("temperature")[i][0] - profile.exact.at("temperature")[i][0]) / 20.0;
  RegionError const& all = record.errors.at("temperature").at("all");
  BOOST_TEST(*all.mean == mean, tolerance(1e-10));
  BOOST_TEST(std::abs(*all.mean) <= all.error.l1);
}

BOOST_AUTO_TEST_CASE(a_wave_that_has_come_back_scores_nothing_for_its_initial_state) {
  // The period is 2 at unit speed of sound.
  RunRecord const half = gas("hydro/acoustic", 16, {{"final_time", 1.0}}, "runge-kutta");
  RunRecord const whole = gas("hydro/acoustic", 16, {{"final_time", 2.0}}, "runge-kutta");
  RegionError const& back = whole.errors.at("velocity").at("all");
  BOOST_TEST(back.initial->linf < 1e-3 * back.scale.linf);
  RegionError const& turned = half.errors.at("velocity").at("all");
  BOOST_TEST(turned.initial->linf == 2.0 * turned.scale.linf, tolerance(1e-2));
  BOOST_TEST(!turned.mean.has_value(), "a velocity has no mean, in one dimension either");
  BOOST_TEST(half.errors.at("density").at("all").mean.has_value());
}

BOOST_AUTO_TEST_CASE(rates_have_means_but_nothing_to_start_from) {
  RunRecord const heating =
      run({.scene_case = "operator/sine", .formulation = "conduction/campbell-flux", .resolution = 20});
  BOOST_TEST(heating.errors.at("heating").at("all").mean.has_value());
  BOOST_TEST(!heating.errors.at("heating").at("all").initial.has_value());
  BOOST_TEST(!heating.errors.at("flux").at("all").mean.has_value());
}

BOOST_AUTO_TEST_CASE(a_shock_limits_orders_where_it_is_and_leaves_a_region_without_it) {
  RunRecord const record = gas("hydro/piston-velocity", 60, {{"final_time", 0.4}});
  FieldErrors const& velocity = record.errors.at("velocity");
  BOOST_TEST_REQUIRE(velocity.contains("smooth"));
  BOOST_TEST_REQUIRE(velocity.at("all").allowed.has_value());
  BOOST_TEST(velocity.at("all").allowed->l1 == 1.0);
  BOOST_TEST(velocity.at("all").allowed->linf == 0.0);
  for (char const* region : {"wall", "smooth"}) {
    for (char const* field : {"velocity", "density", "internal_energy", "pressure"})
      BOOST_TEST(!record.errors.at(field).at(region).allowed.has_value(), field << " " << region);
  }
  // Neither the shock nor the heat that its start has left at the piston is in it.
  RegionError const& density = record.errors.at("density").at("smooth");
  BOOST_TEST(density.error.linf < 0.2 * record.errors.at("density").at("wall").error.linf);
  BOOST_TEST(density.error.linf < 0.2 * record.errors.at("density").at("interior").error.linf);
}

BOOST_AUTO_TEST_CASE(what_has_flown_beyond_a_vacuum_is_compared_with_its_front) {
  auto const problem =
      std::get<Problem<1>>(find_case("hydro/vacuum-release")
                               ->problem(Parameters(find_case("hydro/vacuum-release")->info.parameters)));
  double const front = problem.landmarks.at("front")(0.5);
  auto const& v = problem.vectors.at(Field::velocity);
  BOOST_TEST(v(Vector<1>(front), 0.5)[0] == v(Vector<1>(front - 1e-9), 0.5)[0], tolerance(1e-8));
  BOOST_TEST(v(Vector<1>(front + 1.0), 0.5)[0] == v(Vector<1>(front), 0.5)[0]);
  BOOST_TEST(problem.scalars.at(Field::density)(Vector<1>(front), 0.5) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
