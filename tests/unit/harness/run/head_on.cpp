// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_head_on)

using namespace sphverify;
using namespace sphverify::tests;

// On a lattice the explosion in a corner drives mirror images across the diagonal exactly into each other.
// What pairs feel is smooth there: they pass, and the run goes on.
BOOST_AUTO_TEST_CASE(particles_that_meet_head_on_in_2d_do_not_end_a_run) {
  RunChoice choice{.scene_case = "hydro/sedov",
                   .formulation = "momentum/p-rho2",
                   .resolution = 12,
                   .parameters = {{"dimension", 2.0}}};
  choice.discretisation.density = "normalised";
  choice.discretisation.integrator = "leapfrog";
  choice.discretisation.viscosity = {1.0, 2.0};
  RunSpec spec = make_spec(choice);
  spec.formulation.work = "work/internal-energy";
  RunOptions options;
  options.measure = {Measure::conservation};
  RunRecord const record = execute(spec, options);
  BOOST_TEST(record.status == "ok", record.reason);
  BOOST_TEST(std::abs(record.momentum.at(0).pair_drift.value()) < 1e-13);
  BOOST_TEST(std::abs(record.conservation.at("energy").pair_drift.value()) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
