// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/wall_riemann.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <vector>

#include "cases/exact/riemann.hpp"

BOOST_AUTO_TEST_SUITE(formulations_walls_wall_riemann)

using namespace sphverify;
using boost::test_tools::tolerance;

struct Gas {
  double rho, P, gamma;
  double c() const { return std::sqrt(gamma * P / rho); }
  double escape_speed() const { return 2.0 * c() / (gamma - 1.0); }
  double pressure(double closing) const { return pressure_at_wall(rho, P, closing, gamma); }
  double closing(double wall_pressure) const { return closing_speed_at_wall(rho, P, wall_pressure, gamma); }
  /// The gas and its mirror image meet where the wall stands, so that the contact is at rest.
  exact::Riemann against_mirror(double closing) const {
    return {{rho, closing, P}, {rho, -closing, P}, gamma};
  }
};

std::vector<Gas> gases() {
  std::vector<Gas> list;
  for (double const gamma : {1.1, 1.4, 5.0 / 3.0, 3.0}) {
    for (double const rho : {0.3, 1.0, 40.0}) {
      for (double const P : {0.02, 1.0, 700.0}) list.push_back({rho, P, gamma});
    }
  }
  return list;
}

// In units of the speed of sound: fans down to 0.9 of the escape speed, shocks up to Mach 300.
std::vector<double> closing_speeds(Gas const& gas) {
  std::vector<double> list;
  for (double const part : {-0.9, -0.5, -0.1, -1e-3}) list.push_back(part * gas.escape_speed());
  for (double const mach : {1e-3, 0.1, 0.7, 2.0, 30.0, 300.0}) list.push_back(mach * gas.c());
  return list;
}

BOOST_AUTO_TEST_CASE(pressure_is_that_between_the_gas_and_its_mirror_image) {
  for (Gas const& gas : gases()) {
    for (double const closing : closing_speeds(gas)) {
      exact::Riemann const problem = gas.against_mirror(closing);
      BOOST_TEST_REQUIRE(problem.star().has_value());
      double const highest = std::max(gas.P, problem.star()->pressure);
      BOOST_TEST(std::abs(gas.pressure(closing) - problem.star()->pressure) <
                     (4.0 * problem.accuracy() + 1e-13) * highest,
                 "gamma " << gas.gamma << ", Mach " << closing / gas.c());
    }
  }
}

BOOST_AUTO_TEST_CASE(closing_speed_makes_gas_and_mirror_image_meet_at_the_wall_pressure) {
  for (Gas const& gas : gases()) {
    for (double const ratio : {1e-4, 0.2, 0.99, 1.01, 3.0, 1e3, 1e8}) {
      exact::Riemann const problem = gas.against_mirror(gas.closing(ratio * gas.P));
      BOOST_TEST_REQUIRE(problem.star().has_value());
      BOOST_TEST(std::abs(problem.star()->pressure - ratio * gas.P) <
                     (4.0 * problem.accuracy() + 1e-12) * std::max(1.0, ratio) * gas.P,
                 "gamma " << gas.gamma << ", P_B/P " << ratio);
    }
  }
}

// The jump conditions themselves. Seen from the wall the shock runs off at s and leaves gas at rest.
BOOST_AUTO_TEST_CASE(shock_conserves_mass_momentum_and_energy) {
  for (Gas const& gas : gases()) {
    for (double const mach : {0.5, 2.0, 30.0}) {
      double const u = mach * gas.c();
      double const P_B = gas.pressure(u);
      double const s = (P_B - gas.P) / (gas.rho * u) - u;  // from the momentum that enters the shock
      BOOST_TEST(s + u > gas.c());                         // supersonic into the gas
      double const rho_B = gas.rho * (u + s) / s;
      auto const enthalpy = [&](double P, double rho) { return gas.gamma / (gas.gamma - 1.0) * P / rho; };
      BOOST_TEST(enthalpy(gas.P, gas.rho) + 0.5 * (u + s) * (u + s) == enthalpy(P_B, rho_B) + 0.5 * s * s,
                 tolerance(1e-10));
    }
  }
}

// Along a fan entropy and u + 2c/(gamma-1) are constant; at the wall u = 0.
BOOST_AUTO_TEST_CASE(fan_keeps_entropy_and_the_riemann_invariant) {
  for (Gas const& gas : gases()) {
    for (double const part : {0.05, 0.3, 0.8}) {
      double const u = -part * gas.escape_speed();
      double const P_B = gas.pressure(u);
      double const rho_B = gas.rho * std::pow(P_B / gas.P, 1.0 / gas.gamma);
      double const c_B = std::sqrt(gas.gamma * P_B / rho_B);
      BOOST_TEST(u + gas.escape_speed() == 2.0 * c_B / (gas.gamma - 1.0), tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_two_questions_are_inverse_to_each_other) {
  for (Gas const& gas : gases()) {
    for (double const closing : closing_speeds(gas)) {
      double const back = gas.closing(gas.pressure(closing));
      BOOST_TEST(std::abs(back - closing) < 1e-12 * (std::abs(closing) + gas.escape_speed()));
    }
    for (double const ratio : {1e-4, 0.2, 0.99, 1.01, 3.0, 1e3, 1e8}) {
      BOOST_TEST(gas.pressure(gas.closing(ratio * gas.P)) == ratio * gas.P, tolerance(1e-10));
    }
  }
}

BOOST_AUTO_TEST_CASE(gas_that_moves_with_the_wall_keeps_its_pressure_exactly) {
  for (Gas const& gas : gases()) {
    BOOST_TEST(gas.pressure(0.0) == gas.P);
    BOOST_TEST(gas.closing(gas.P) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(gas_cannot_follow_faster_than_its_escape_speed) {
  for (Gas const& gas : gases()) {
    double const escape = gas.escape_speed();
    for (double const factor : {1.0 + 1e-14, 1.5, 100.0}) {
      BOOST_TEST(gas.pressure(-factor * escape) == 0.0);
      BOOST_TEST(!gas.against_mirror(-factor * escape).star().has_value());
    }
    BOOST_TEST(gas.pressure(-0.99 * escape) > 0.0);
    BOOST_TEST(gas.closing(0.0) == -escape, tolerance(1e-14));
    BOOST_TEST(gas.closing(-3.0) == gas.closing(0.0));  // a wall cannot pull
  }
}

BOOST_AUTO_TEST_CASE(cold_gas_stops_in_a_strong_shock_and_leaves_a_parting_wall_alone) {
  for (double const gamma : {1.1, 1.4, 5.0 / 3.0, 3.0}) {
    Gas const cold{2.0, 0.0, gamma};
    BOOST_TEST(cold.pressure(3.0) == 0.5 * (gamma + 1.0) * 2.0 * 9.0, tolerance(1e-14));
    BOOST_TEST(cold.closing(0.5 * (gamma + 1.0) * 2.0 * 9.0) == 3.0, tolerance(1e-14));
    BOOST_TEST(cold.pressure(3.0) == cold.against_mirror(3.0).star()->pressure, tolerance(1e-13));
    for (double const closing : {0.0, -1e-9, -3.0}) BOOST_TEST(cold.pressure(closing) == 0.0);
    BOOST_TEST(cold.closing(0.0) == 0.0);
    // The limit from a gas that is not quite cold: P_B = (gamma+1)/2 rho u^2 + O(P).
    Gas const cool{2.0, 1e-9, gamma};
    BOOST_TEST(cool.pressure(3.0) == cold.pressure(3.0), tolerance(1e-9));
    BOOST_TEST(cool.pressure(-3.0) == 0.0);
  }
}

// P + rho c u + (gamma+1)/4 rho u^2: shock and fan agree up to the second order (Landau & Lifshitz, section
// 86), so that slope and curvature are continuous across zero closing speed.
BOOST_AUTO_TEST_CASE(weak_wave_is_acoustic_with_the_same_second_order_on_both_sides) {
  for (Gas const& gas : gases()) {
    double const c = gas.c();
    for (double const mach : {-0.02, -0.005, 0.005, 0.02}) {
      double const u = mach * c;
      double const acoustic = gas.rho * c * u;
      BOOST_TEST(std::abs(gas.pressure(u) - gas.P - acoustic) < gas.gamma * std::abs(mach * acoustic));
      double const second = acoustic + 0.25 * (gas.gamma + 1.0) * gas.rho * u * u;
      BOOST_TEST(std::abs(gas.pressure(u) - gas.P - second) < std::abs(gas.gamma * mach * mach * acoustic));
    }
  }
}

BOOST_AUTO_TEST_CASE(pressure_is_continuous_and_rises_with_the_closing_speed) {
  for (Gas const& gas : gases()) {
    double const c = gas.c();
    for (double const tiny : {1e-6, 1e-12}) {
      BOOST_TEST(gas.pressure(tiny * c) - gas.P <= 1.1 * gas.gamma * tiny * gas.P + 1e-15 * gas.P);
      BOOST_TEST(gas.P - gas.pressure(-tiny * c) <= 1.1 * gas.gamma * tiny * gas.P + 1e-15 * gas.P);
    }
    double last = 0.0;
    for (int k = -99; k <= 400; ++k) {
      double const now = gas.pressure(0.01 * k * gas.escape_speed());
      BOOST_TEST(now > last);
      last = now;
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
