// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"

// The table of ../shared/equations.md, measured by a prototype that shares nothing with this project.
BOOST_AUTO_TEST_SUITE(harness_run_prototype)

using namespace sphverify;
using namespace sphverify::tests;

std::string ladder(RunChoice choice, double exponent = 0.0) {
  double const nominal = choice.smoothing_ratio;
  std::string errors;
  for (int const n : {25, 50, 100, 200}) {
    choice.resolution = n;
    choice.smoothing_ratio = nominal * std::pow(n / 25.0, exponent);
    RunRecord const record = run(choice);
    BOOST_TEST(record.status == "ok", record.reason);
    errors += fmt::format("{:.1e} ", record.errors.at("temperature").at("all").error.l2);
  }
  return errors;
}

BOOST_AUTO_TEST_CASE(brookshaw_converges_at_first_order_where_h_is_dx) {
  BOOST_TEST(ladder({.smoothing_ratio = 1.0}) == "2.0e-03 1.1e-03 6.1e-04 3.1e-04 ");
}

BOOST_AUTO_TEST_CASE(brookshaw_ends_at_a_floor_at_h_of_1_2) {
  BOOST_TEST(ladder({}) == "5.6e-03 5.3e-03 5.1e-03 4.9e-03 ");
}

BOOST_AUTO_TEST_CASE(brookshaw_with_summation_density) {
  BOOST_TEST(ladder({.discretisation = with_density("summation")}) == "2.4e-02 1.4e-02 9.0e-03 6.4e-03 ");
}

BOOST_AUTO_TEST_CASE(lucy_flux_does_not_converge) {
  BOOST_TEST(ladder({.formulation = "conduction/lucy-flux"}) == "4.2e-02 4.6e-02 5.0e-02 5.2e-02 ");
}

BOOST_AUTO_TEST_CASE(brookshaw_with_balanced_faces_is_second_order) {
  BOOST_TEST(ladder({.smoothing_ratio = 1.0, .discretisation = weighted("balanced")}) ==
             "3.6e-04 8.9e-05 2.2e-05 5.6e-06 ");
}

BOOST_AUTO_TEST_CASE(campbell_flux_does_not_converge_at_fixed_h) {
  BOOST_TEST(ladder({.formulation = "conduction/campbell-flux"}) == "8.2e-02 8.9e-02 9.2e-02 9.4e-02 ");
}

BOOST_AUTO_TEST_CASE(campbell_flux_converges_in_the_joint_limit) {
  BOOST_TEST(ladder({.formulation = "conduction/campbell-flux"}, 0.5) == "8.2e-02 4.1e-02 2.3e-02 1.5e-02 ");
}

BOOST_AUTO_TEST_CASE(brookshaw_converges_in_the_joint_limit) {
  BOOST_TEST(ladder({}, 0.5) == "5.6e-03 3.1e-03 7.5e-04 3.0e-04 ");
}

BOOST_AUTO_TEST_SUITE_END()
