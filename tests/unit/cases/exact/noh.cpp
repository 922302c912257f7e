// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/noh.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "cases/exact/riemann.hpp"
#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_noh)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr int dimensions[] = {1, 2, 3};
constexpr double gammas[] = {1.2, 1.4, 5.0 / 3.0};

double energy_density(GasState const& gas, double gamma) {
  return gas.pressure / (gamma - 1.0) + 0.5 * gas.density * gas.velocity * gas.velocity;
}

/// Integral of quantity(state) r^(d-1) from 0 to `radius`, which is beyond the shock: what the ball contains
/// but for a factor of 2, 2 pi or 4 pi.
template <class Quantity>
double content(Noh const& exact, int dimension, double radius, double t, Quantity const& quantity) {
  auto shell = [&](double r) { return quantity(exact.at(r, t)) * std::pow(r, dimension - 1); };
  double const shock = exact.shock_speed() * t;
  return integral(shell, 0.0, shock) + integral(shell, shock, radius);
}

BOOST_AUTO_TEST_CASE(known_values_for_gamma_5_3) {
  double const third = 1.0 / 3.0;
  for (int const dimension : dimensions) {
    Noh const exact(dimension, 5.0 / 3.0);
    BOOST_TEST(exact.shock_speed() == third, boost::test_tools::tolerance(1e-15));
    GasState const inside = exact.at(0.1, 0.6);
    BOOST_TEST(inside.density == std::pow(4.0, dimension), boost::test_tools::tolerance(1e-14));
    BOOST_TEST(inside.velocity == 0.0);
    BOOST_TEST(inside.pressure == third * std::pow(4.0, dimension), boost::test_tools::tolerance(1e-14));
    GasState const outside = exact.at(0.3, 0.6);
    BOOST_TEST(outside.density == std::pow(3.0, dimension - 1), boost::test_tools::tolerance(1e-14));
    BOOST_TEST(outside.velocity == -1.0);
    BOOST_TEST(outside.pressure == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(initial_state_is_uniform_cold_and_converging) {
  for (int const dimension : dimensions) {
    for (double const r : {0.0, 1e-9, 1.0, 100.0}) {
      GasState const gas = Noh(dimension, 1.4).at(r, 0.0);
      BOOST_TEST(gas.density == 1.0);
      BOOST_TEST(gas.velocity == -1.0);
      BOOST_TEST(gas.pressure == 0.0);
    }
  }
}

// What is inside of `radius` was inside of radius + t at first.
BOOST_AUTO_TEST_CASE(mass_in_the_ball_is_what_streamed_into_it) {
  for (int const dimension : dimensions) {
    for (double const gamma : gammas) {
      Noh const exact(dimension, gamma);
      for (double const t : {0.1, 0.6, 2.0}) {
        double const radius = 1.5;
        auto density = [](GasState const& gas) { return gas.density; };
        BOOST_TEST(
            content(exact, dimension, radius, t, density) == std::pow(radius + t, dimension) / dimension,
            boost::test_tools::tolerance(1e-11));
      }
    }
  }
}

// No pressure acts at the edge, so each kilogram keeps its energy of 1/2.
BOOST_AUTO_TEST_CASE(energy_in_the_ball_is_what_streamed_into_it) {
  for (int const dimension : dimensions) {
    for (double const gamma : gammas) {
      Noh const exact(dimension, gamma);
      for (double const t : {0.1, 0.6, 2.0}) {
        double const radius = 1.5;
        auto energy = [&](GasState const& gas) { return energy_density(gas, gamma); };
        BOOST_TEST(
            content(exact, dimension, radius, t, energy) == 0.5 * std::pow(radius + t, dimension) / dimension,
            boost::test_tools::tolerance(1e-11));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(mass_momentum_and_energy_pass_the_shock_unchanged) {
  for (int const dimension : dimensions) {
    for (double const gamma : gammas) {
      Noh const exact(dimension, gamma);
      double const speed = exact.shock_speed();
      double const t = 0.6;
      GasState const before = exact.at(speed * t * (1.0 + 1e-14), t);
      GasState const after = exact.at(speed * t * (1.0 - 1e-14), t);
      BOOST_TEST(before.pressure == 0.0);
      BOOST_TEST(after.pressure > 0.0);
      auto mass = [&](GasState const& gas) { return gas.density * (speed - gas.velocity); };
      auto momentum = [&](GasState const& gas) { return gas.pressure - mass(gas) * gas.velocity; };
      auto energy = [&](GasState const& gas) {
        return energy_density(gas, gamma) * (speed - gas.velocity) - gas.pressure * gas.velocity;
      };
      BOOST_TEST(mass(before) == mass(after), boost::test_tools::tolerance(1e-12));
      BOOST_TEST(momentum(before) == momentum(after), boost::test_tools::tolerance(1e-12));
      BOOST_TEST(energy(before) == energy(after), boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(gas_ahead_of_the_shock_solves_the_euler_equations) {
  double const h = 0.002;
  for (int const dimension : dimensions) {
    Noh const exact(dimension, 1.4);
    for (double const r : {0.3, 0.8, 2.0}) {
      for (double const t : {0.2, 0.9}) {
        auto area = [&](double s) { return std::pow(s, dimension - 1); };
        auto flow = [&](double s) { return area(s) * exact.at(s, t).density * exact.at(s, t).velocity; };
        double const filling = first_derivative([&](double s) { return exact.at(r, s).density; }, t, h);
        double const divergence = first_derivative(flow, r, h) / area(r);
        BOOST_TEST(std::abs(filling + divergence) < 1e-8,
                   "d = " << dimension << ", r = " << r << ", t = " << t);
        // Free flight: nothing pushes cold gas, and it stays cold without a shock.
        GasState const gas = exact.at(r, t);
        double const acceleration =
            first_derivative([&](double s) { return exact.at(r, s).velocity; }, t, h) +
            gas.velocity * first_derivative([&](double s) { return exact.at(s, t).velocity; }, r, h);
        BOOST_TEST(acceleration == 0.0);
        BOOST_TEST(gas.pressure == 0.0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(planar_problem_is_the_collision_of_two_cold_streams) {
  for (double const gamma : gammas) {
    Noh const exact(1, gamma);
    Riemann const collision({1.0, 1.0, 0.0}, {1.0, -1.0, 0.0}, gamma);
    BOOST_TEST(collision.waves().right_head == exact.shock_speed(), boost::test_tools::tolerance(1e-13));
    double const t = 0.6;
    for (double const place : {0.01, 0.5, 0.999, 1.001, 3.0}) {
      double const r = place * exact.shock_speed() * t;
      GasState const found = exact.at(r, t);
      GasState const expected = collision.at(r / t);
      BOOST_TEST(found.density == expected.density, boost::test_tools::tolerance(1e-13));
      BOOST_TEST(found.pressure == expected.pressure, boost::test_tools::tolerance(1e-13));
      BOOST_TEST(std::abs(found.velocity - expected.velocity) < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(density_and_pressure_are_as_accurate_as_promised) {
  for (int const dimension : {1, 2, 3, 5}) {
    for (double const given : {1.0001, 1.2, 1.4, 5.0 / 3.0, 2.5}) {
      Noh const exact(dimension, given);
      BOOST_TEST(exact.accuracy() < 1e-14);
      long double const gamma = given;
      double const t = 0.6;
      auto near = [&](double found, long double expected) {
        return std::abs(static_cast<double>(found / expected - 1.0L)) <= exact.accuracy();
      };
      long double const jump = std::pow((gamma + 1.0L) / (gamma - 1.0L), dimension);
      GasState const inside = exact.at(0.5 * exact.shock_speed() * t, t);
      BOOST_TEST(near(inside.density, jump));
      BOOST_TEST(near(inside.pressure, 0.5L * (gamma - 1.0L) * jump));
      for (double const place : {1.001, 1.7, 12.0}) {
        double const r = place * exact.shock_speed() * t;
        long double const expected = std::pow(1.0L + static_cast<long double>(t) / r, dimension - 1);
        BOOST_TEST(near(exact.at(r, t).density, expected));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { Noh(0, 1.4); }, "dimension must be 1 or more, found 0"));
  BOOST_TEST(refuses([] { Noh(3, 1.0); }, "gamma must be above 1, found 1"));
  BOOST_TEST(refuses([] { Noh(3, 1.4).at(-1, 1); }, "radius must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { Noh(3, 1.4).at(1, -1); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(Noh(3, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
