// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "formulations/rate_operator.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_conservation)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

Budget energy_of(RunChoice const& choice, double* solver_tolerance = nullptr) {
  RunRecord const record = run(choice, {Measure::error, Measure::conservation});
  BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
  if (solver_tolerance) *solver_tolerance = *record.integration->absolute_tolerance;
  return record.conservation.at("energy");
}

RunChoice const disordered{.resolution = 40,
                           .smoothing_ratio = 1.3,
                           .discretisation = jittered_by(0.05, 2),
                           .parameters = {{"final_time", 0.002}}};

BOOST_AUTO_TEST_CASE(schemes_that_claim_to_conserve_energy_drift_by_no_more_than_the_solver_allows) {
  for (std::string const& formulation : conduction_schemes()) {
    if (!find_scheme(formulation)->conserves.contains(Invariant::energy)) continue;
    for (char const* scene_case : {"conduction/slab-dirichlet", "conduction/slab-insulated",
                                   "conduction/slab-flux", "conduction/manufactured"}) {
      for (bool const walls : {true, false}) {
        RunChoice choice = disordered;
        choice.scene_case = scene_case;
        choice.formulation = formulation;
        choice.walls = walls;
        double allowed = 0.0;
        Budget const budget = energy_of(choice, &allowed);
        BOOST_TEST_MESSAGE(scene_case << " " << formulation << " " << walls << ": " << budget.drift << " at "
                                      << allowed);
        BOOST_TEST(std::abs(budget.drift) < 10.0 * allowed, scene_case << " " << formulation);
        // The pairs' own part is free of the solver's tolerance.
        BOOST_TEST(std::abs(budget.pair_drift.value()) < 1e-12, scene_case << " " << formulation);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(brookshaw_and_campbell_flux_claim_to_conserve_energy_and_lucy_flux_does_not) {
  BOOST_TEST(find_scheme("conduction/brookshaw")->conserves.contains(Invariant::energy));
  BOOST_TEST(find_scheme("conduction/campbell-flux")->conserves.contains(Invariant::energy));
  BOOST_TEST(!find_scheme("conduction/lucy-flux")->conserves.contains(Invariant::energy));
}

BOOST_AUTO_TEST_CASE(lucy_flux_creates_energy_on_disorder) {
  RunChoice choice = disordered;
  choice.formulation = "conduction/lucy-flux";
  double allowed = 0.0;
  Budget const budget = energy_of(choice, &allowed);
  BOOST_TEST(std::abs(budget.drift) > 1e-5);
  BOOST_TEST(std::abs(budget.drift) > 10.0 * allowed);
}

BOOST_AUTO_TEST_CASE(lucy_flux_gains_the_prescribed_heat_but_half_of_it_as_an_imbalance_of_its_pairs) {
  // 0.05 = flux x time should enter. At N = 400, h/dx = 4.8: 0.025 through the wall, 0.0197 through the pairs.
  RunChoice choice{.resolution = 400, .smoothing_ratio = 4.8, .parameters = {{"final_time", 0.05}}};
  choice.scene_case = "conduction/slab-flux";
  choice.formulation = "conduction/lucy-flux";
  Budget const budget = energy_of(choice);
  BOOST_TEST(budget.exchanged == 0.025, tolerance(0.01));
  BOOST_TEST(budget.pair_drift.value() > 0.018);
  BOOST_TEST(budget.final - budget.initial == 0.05, tolerance(0.15));
}

BOOST_AUTO_TEST_CASE(drift_is_what_is_left_of_the_budget) {
  for (std::string const& formulation : conduction_schemes()) {
    RunChoice choice = disordered;
    choice.formulation = formulation;
    Budget const b = energy_of(choice);
    BOOST_TEST(std::abs(b.drift - (b.final - b.initial - b.exchanged)) < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(initial_energy_is_that_of_the_case) {
  // The integral of 1 + x + sin(pi x) + 0.5 sin(3 pi x) over the slab, by the midpoint rule.
  double const exact = 1.5 + (2.0 + 1.0 / 3.0) / std::acos(-1.0);
  BOOST_TEST(energy_of({.resolution = 200}).initial == exact, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(nothing_is_exchanged_without_wall_terms_or_sources) {
  BOOST_TEST(energy_of({.walls = false}).exchanged == 0.0);
  BOOST_TEST(std::abs(energy_of({}).exchanged) > 1e-3);
}

BOOST_AUTO_TEST_CASE(a_source_counts_as_exchanged) {
  Budget const without_walls = energy_of({.scene_case = "conduction/manufactured", .walls = false});
  BOOST_TEST(std::abs(without_walls.exchanged) > 1e-3);
  BOOST_TEST(std::abs(without_walls.drift) < 1e-5);
}

BOOST_AUTO_TEST_CASE(what_flux_walls_give_is_the_prescribed_flux_in_brookshaw_s_balanced_form) {
  // -2 F_B.S_i/rho_i adds up to F_B if the face weights add up to one half: in 1D twice the kernel at the
  // particles' distances, which is 1 to the lattice's own accuracy.
  Budget const b = energy_of({.scene_case = "conduction/slab-flux", .resolution = 50});
  BOOST_TEST(b.exchanged == 0.05, tolerance(0.05));
  BOOST_TEST(b.wall_budget_defect.has_value());
  BOOST_TEST(*b.wall_budget_defect == b.exchanged - 0.05, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(the_flux_through_the_walls_of_a_slab_converges_with_balanced_faces) {
  std::vector<double> worst;
  for (int const n : {25, 50, 100, 200}) {
    RunRecord const record =
        run({.resolution = n, .smoothing_ratio = 1.0, .discretisation = weighted("balanced")});
    BOOST_TEST(record.wall_flux.size() == 2u);
    worst.push_back(0.0);
    for (WallFlux const& wall : record.wall_flux) {
      BOOST_TEST(wall.error == wall.measured - wall.exact, tolerance(1e-12));
      worst.back() = std::max(worst.back(), std::abs(wall.error));
    }
  }
  for (std::size_t k = 1; k < worst.size(); ++k) BOOST_TEST(worst[k] < 0.6 * worst[k - 1]);
  BOOST_TEST(worst.back() < 0.01);
}

BOOST_AUTO_TEST_CASE(the_exact_flux_of_a_slab_is_positive_inward_at_either_wall) {
  RunRecord const record = run({});
  double const pi = std::acos(-1.0);
  auto const mode = [pi](int n, double amplitude) {
    return amplitude * n * pi * std::exp(-n * n * pi * pi * 0.05);
  };
  // The slab cools through both: -K dT/dx at the left, K dT/dx at the right.
  double const modes = mode(1, 1.0) + mode(3, 0.5);
  BOOST_TEST(record.wall_flux[0].exact == -(1.0 + modes), tolerance(1e-12));
  BOOST_TEST(record.wall_flux[1].exact == 1.0 - modes, tolerance(1e-12));
  for (WallFlux const& wall : record.wall_flux) BOOST_TEST(wall.measured * wall.exact > 0.0);
}

BOOST_AUTO_TEST_CASE(without_wall_terms_no_flux_is_measured) {
  for (WallFlux const& wall : run({.walls = false}).wall_flux) BOOST_TEST(wall.measured == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
