// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/extreme/pressure_ratio.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/exact/riemann.hpp"

// The exact solver is asked here for more than the tubes of the literature hold: what it gives is put into
// the jump conditions and the fan's invariants, in long double, and none of its own formulas is used.
BOOST_AUTO_TEST_SUITE(cases_extreme_pressure_ratio)

using namespace sphverify;
using Long = long double;

Problem<1> problem_of(double ratio, double final_time = 0.35) {
  Parameters parameters(PressureRatio::info().parameters);
  parameters.set("ratio", ratio);
  parameters.set("final_time", final_time);
  return std::get<Problem<1>>(PressureRatio::problem(parameters));
}

constexpr double ratios[] = {10.0, 1e4, 1e10, 1e14, 1e18};

struct State {
  Long rho, u, P;
};

State state_of(Problem<1> const& problem, double x, double t) {
  Vector<1> const at(x);
  return {problem.scalars.at(Field::density)(at, t), problem.vectors.at(Field::velocity)(at, t)[0],
          problem.scalars.at(Field::pressure)(at, t)};
}

BOOST_AUTO_TEST_CASE(starts_with_the_ratio_it_is_asked_for) {
  for (double const ratio : ratios) {
    auto const problem = problem_of(ratio);
    State const left = state_of(problem, 0.2, 0.0);
    State const right = state_of(problem, 0.8, 0.0);
    BOOST_TEST(static_cast<double>(left.P / right.P) == ratio, boost::test_tools::tolerance(1e-14));
    BOOST_TEST((left.rho == 1.0L && right.rho == 1.0L && left.u == 0.0L && right.u == 0.0L));
  }
}

BOOST_AUTO_TEST_CASE(mass_momentum_and_energy_that_enter_the_shock_leave_it) {
  for (double const ratio : ratios) {
    auto const problem = problem_of(ratio);
    double const t = problem.final_time;
    auto const fronts = problem.shocks(t);
    BOOST_TEST_REQUIRE(fronts.size() == 1u);
    Long const speed = (static_cast<Long>(fronts[0].position) - 0.5L) / static_cast<Long>(t);
    Long const gamma = static_cast<Long>(problem.gamma);
    auto const fluxes = [&](State const& s) {
      Long const w = s.u - speed;
      Long const h = gamma / (gamma - 1.0L) * s.P / s.rho + 0.5L * w * w;
      return std::array<Long, 3>{s.rho * w, s.rho * w * w + s.P, s.rho * w * h};
    };
    auto const ahead = fluxes(state_of(problem, fronts[0].position + 1e-6, t));
    auto const behind = fluxes(state_of(problem, fronts[0].position - 1e-6, t));
    for (std::size_t k = 0; k < 3; ++k) {
      Long const residual = std::abs(behind[k] - ahead[k]) / std::abs(ahead[k]);
      BOOST_TEST(static_cast<double>(residual) < 1e-14, "ratio " << ratio << ", flux " << k);
    }
  }
}

BOOST_AUTO_TEST_CASE(entropy_and_invariant_of_the_fan_are_those_of_the_gas_at_rest) {
  for (double const ratio : ratios) {
    auto const problem = problem_of(ratio);
    double const t = problem.final_time;
    Long const gamma = static_cast<Long>(problem.gamma);
    Long const invariant = 2.0L / (gamma - 1.0L) * std::sqrt(gamma);
    std::size_t in_fan = 0;
    for (double x = 0.002; x < 0.5; x += 0.01) {
      State const s = state_of(problem, x, t);
      Long const c = std::sqrt(gamma * s.P / s.rho);
      BOOST_TEST(static_cast<double>(std::abs(s.P / std::pow(s.rho, gamma) - 1.0L)) < 1e-14);
      BOOST_TEST(static_cast<double>(std::abs(s.u + 2.0L / (gamma - 1.0L) * c - invariant)) < 1e-14);
      if (s.u == 0.0L || std::abs(s.u - state_of(problem, 0.501, t).u) < 1e-12L) continue;
      Long const ray = (static_cast<Long>(x) - 0.5L) / static_cast<Long>(t);
      BOOST_TEST(static_cast<double>(std::abs(s.u - c - ray)) < 1e-14);
      ++in_fan;
    }
    BOOST_TEST(in_fan > 20u);
  }
}

BOOST_AUTO_TEST_CASE(pressure_and_velocity_are_the_same_on_both_sides_of_the_contact) {
  for (double const ratio : ratios) {
    auto const problem = problem_of(ratio);
    double const t = problem.final_time;
    double const contact = 0.5 + problem.landmarks.at("star.velocity")(t) * t;
    State const left = state_of(problem, contact - 1e-6, t);
    State const right = state_of(problem, contact + 1e-6, t);
    BOOST_TEST((left.P == right.P && left.u == right.u));
    BOOST_TEST(static_cast<double>(left.rho) < static_cast<double>(right.rho));
  }
}

// As the ratio grows all becomes that of a shock of infinite strength: (gamma+1)/(gamma-1) in density.
BOOST_AUTO_TEST_CASE(the_shock_becomes_infinitely_strong) {
  auto const problem = problem_of(1e14);
  auto const front = problem.shocks(problem.final_time).at(0);
  BOOST_TEST(front.density == 6.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(front.velocity == std::sqrt(2.0 / 2.4 * front.pressure), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(waves_stay_between_the_walls) {
  for (double const final_time : {0.35, 1.0}) {
    auto const problem = problem_of(1e10, final_time);
    BOOST_TEST(problem.final_time == final_time);
    double const head = 0.5 - std::sqrt(1.4) * final_time;
    BOOST_TEST(problem.domain.lower[0] < head);
    BOOST_TEST(problem.domain.upper[0] > problem.shocks(final_time).at(0).position);
    if (final_time == 0.35) BOOST_TEST((problem.domain.lower[0] == 0.0 && problem.domain.upper[0] == 1.0));
  }
}

BOOST_AUTO_TEST_SUITE_END()
