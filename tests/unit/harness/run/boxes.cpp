// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>

#include "tests/support/runs.hpp"

// Runs in two and three dimensions, end to end.
BOOST_AUTO_TEST_SUITE(harness_run_boxes)

using namespace sphverify;
using namespace sphverify::tests;

RunRecord run_gas(std::string const& scene_case, int resolution, std::string const& density,
                  std::string const& integrator, ViscosityChoice viscosity,
                  std::vector<std::pair<std::string, ParameterValue>> parameters, MeasureSet measure,
                  int threads = 1) {
  RunSpec spec = make_spec({.scene_case = scene_case,
                            .formulation = "momentum/p-rho2",
                            .resolution = resolution,
                            .parameters = std::move(parameters)});
  spec.formulation.work = "work/internal-energy";
  spec.discretisation.density = density;
  spec.discretisation.integrator = integrator;
  spec.discretisation.viscosity = viscosity;
  spec.discretisation.closure = "one-sided";
  RunOptions options;
  options.measure = measure;
  options.threads = threads;
  RunRecord const record = execute(spec, options);
  BOOST_TEST_REQUIRE(record.status == "ok", scene_case << ": " << record.reason);
  return record;
}

BOOST_AUTO_TEST_CASE(a_slab_turned_by_30_degrees_has_the_same_errors) {
  for (std::string const& formulation : conduction_schemes()) {
    for (double const dimension : {2.0, 3.0}) {
      std::map<double, FieldErrors> errors;
      for (double const turn : {0.0, 30.0}) {
        RunRecord const record = run({.formulation = formulation,
                                      .resolution = dimension == 2.0 ? 16 : 10,
                                      .parameters = {{"dimension", dimension}, {"turn", turn}}});
        BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
        errors[turn] = record.errors.at("temperature");
      }
      for (auto const& [region, straight] : errors[0.0]) {
        NormSet const& turned = errors[30.0].at(region).error;
        BOOST_TEST(turned.l2 == straight.error.l2, boost::test_tools::tolerance(1e-4));
        BOOST_TEST(turned.linf == straight.error.linf, boost::test_tools::tolerance(1e-4));
      }
    }
  }
}

// At fixed h/dx the error stops at a floor beyond one dimension even where h = dx; with h/dx growing it
// falls.
BOOST_AUTO_TEST_CASE(a_slab_in_two_and_three_dimensions_converges_in_the_joint_limit) {
  for (double const dimension : {2.0, 3.0}) {
    auto const error = [&](int resolution, double smoothing_ratio) {
      return run({.resolution = resolution,
                  .smoothing_ratio = smoothing_ratio,
                  .discretisation = weighted("balanced"),
                  .parameters = {{"dimension", dimension}}})
          .errors.at("temperature")
          .at("all")
          .error.l2;
    };
    double const coarse = error(10, 1.2), fine = error(20, 1.2 * std::sqrt(2.0));
    BOOST_TEST(fine < 0.7 * coarse, "dimension " << dimension << ": " << coarse << ", " << fine);
  }
}

BOOST_AUTO_TEST_CASE(closed_boxes_report_their_corners_and_walls_in_order) {
  for (char const* box : {"conduction/square", "conduction/cube"}) {
    RunRecord const record = run({.scene_case = box, .resolution = 10});
    BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
    FieldErrors const& errors = record.errors.at("temperature");
    for (char const* region : {"all", "wall", "corner"}) BOOST_TEST(errors.contains(region));
    BOOST_TEST(record.wall_flux.size() == (std::string(box) == "conduction/square" ? 4u : 6u));
    // Difference form: a corner is no worse than twice the rest.
    BOOST_TEST(errors.at("corner").error.l2 < 2.0 * errors.at("all").error.l2);
  }
}

BOOST_AUTO_TEST_CASE(a_slab_has_no_corner) {
  RunRecord const record = run({.resolution = 10, .parameters = {{"dimension", 2.0}}});
  BOOST_TEST(!record.errors.at("temperature").contains("corner"));
}

BOOST_AUTO_TEST_CASE(a_piston_in_two_dimensions_stays_one_dimensional_on_a_lattice) {
  for (char const* piston : {"hydro/piston-velocity", "hydro/piston-pressure"}) {
    RunRecord const record = run_gas(piston, 24, "normalised", "leapfrog", {1.0, 2.0},
                                     {{"dimension", 2.0}, {"final_time", 0.2}}, {Measure::profile});
    Profile const& profile = *record.profile;
    std::map<long, std::pair<double, double>>
        columns;  // by place along the piston: least and largest velocity
    double sideways = 0.0;
    for (std::size_t i = 0; i < profile.position.size(); ++i) {
      auto const& v = profile.computed.at("velocity")[i];
      sideways = std::max(sideways, std::abs(v[1]));
      auto const at = std::lround(1e6 * profile.position[i][0]);
      auto const [column, is_new] = columns.try_emplace(at, v[0], v[0]);
      column->second.first = std::min(column->second.first, v[0]);
      column->second.second = std::max(column->second.second, v[0]);
    }
    BOOST_TEST(sideways < 1e-11);
    BOOST_TEST(columns.size() == 24u);
    for (auto const& [at, range] : columns) BOOST_TEST(range.second - range.first < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(moving_gas_is_the_same_bit_for_bit_at_any_number_of_threads) {
  auto const at_threads = [](int threads) {
    return run_gas("hydro/gresho", 40, "continuity", "runge-kutta", {}, {{"final_time", 0.01}},
                   {Measure::profile}, threads)
        .profile->computed.at("velocity");
  };
  auto const one = at_threads(1);
  BOOST_TEST((at_threads(2) == one));
  BOOST_TEST((at_threads(3) == one));
}

BOOST_AUTO_TEST_CASE(a_blast_starts_with_its_energy_and_closes_its_budget) {
  RunRecord const record = run_gas("hydro/sedov", 16, "normalised", "leapfrog", {1.0, 2.0},
                                   {{"dimension", 2.0}, {"final_time", 0.02}}, {Measure::conservation});
  Budget const& energy = record.conservation.at("energy");
  // A quarter of the whole, and what the background holds.
  BOOST_TEST(energy.initial == 0.25, boost::test_tools::tolerance(1e-4));
  // Walls at rest give energy in this form (wall_budget_defect); pairs and time stepping give next to none.
  BOOST_TEST(std::abs(energy.drift) < 1e-2 * energy.initial);
}

// Near the explosion the exact gas is thinner than particles can be.
BOOST_AUTO_TEST_CASE(errors_are_taken_where_the_exact_solution_holds) {
  std::vector<std::pair<std::string, ParameterValue>> const parameters{{"dimension", 2.0}};
  RunSpec const spec = make_spec({.scene_case = "hydro/sedov", .parameters = parameters});
  auto const problem = std::get<Problem<2>>(spec.scene_case->problem(spec.parameters));
  double const end = problem.final_time;
  RunRecord const record = run_gas("hydro/sedov", 20, "normalised", "leapfrog", {1.0, 2.0}, parameters,
                                   {Measure::error, Measure::profile});
  Profile const& profile = *record.profile;
  double kept = 0.0, error = 0.0;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < profile.position.size(); ++i) {
    if (!problem.holds(Vector<2>(profile.position[i][0], profile.position[i][1]), end)) {
      ++left_out;
      continue;
    }
    kept += profile.weight[i];
    error += profile.weight[i] *
             std::abs(profile.computed.at("density")[i][0] - profile.exact.at("density")[i][0]);
  }
  BOOST_TEST((left_out >= 3u && left_out < 200u), left_out);
  BOOST_TEST(record.errors.at("density").at("all").error.l1 == error / kept,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_support_wider_than_a_periodic_box_is_refused_not_computed) {
  RunRecord const record = run({.resolution = 8, .smoothing_ratio = 2.5, .parameters = {{"dimension", 2.0}}});
  BOOST_TEST(record.status == "invalid");
  BOOST_TEST(record.reason.find("shorter than two supports") != std::string::npos, record.reason);
}

BOOST_AUTO_TEST_SUITE_END()
