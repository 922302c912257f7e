// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/hot_wall.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_hot_wall)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double initial_temperature = 1.2;
constexpr double density = 0.9;
constexpr double conductivity = 0.3;
constexpr double gamma = 1.4;
constexpr double start_time = 0.5;

constexpr double wall_temperatures[] = {2.5, 1.3, 0.6};

HotWall wall(double temperature, double velocity = 0.25) {
  return HotWall(temperature, initial_temperature, density, conductivity, gamma, start_time, velocity);
}

// The layer is about 1 wide and lives for 0.5 and more; steps of 0.005 leave below 1e-8.
template <class Function>
double rate(Function const& f, double t) {
  return first_derivative(f, t, 0.005);
}

template <class Function>
double slope(Function const& f, double x) {
  return first_derivative(f, x, 0.005);
}

template <class Check>
void everywhere(Check const& check) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    for (double const t : {0.0, 0.4, 2.0}) {
      for (double const distance : {0.1, 0.3, 0.6, 1.0, 2.0})
        check(exact, exact.wall_position(t) + distance, t);
    }
  }
}

BOOST_AUTO_TEST_CASE(state_obeys_continuity) {
  everywhere([](HotWall const& exact, double x, double t) {
    double const density_rate = rate([&](double s) { return exact.at(x, s).density; }, t);
    auto flow = [&](double s) { return exact.at(s, t).density * exact.at(s, t).velocity; };
    BOOST_TEST(std::abs(density_rate + slope(flow, x)) < 1e-8, "x = " << x << ", t = " << t);
  });
}

BOOST_AUTO_TEST_CASE(momentum_asks_for_the_acceleration_as_body_force) {
  double largest = 0.0;
  everywhere([&](HotWall const& exact, double x, double t) {
    GasState const s = exact.at(x, t);
    double const expected = rate([&](double p) { return exact.at(x, p).velocity; }, t) +
                            s.velocity * slope([&](double p) { return exact.at(p, t).velocity; }, x) +
                            slope([&](double p) { return exact.at(p, t).pressure; }, x) / s.density;
    BOOST_TEST(std::abs(exact.acceleration(x, t) - expected) < 1e-8, "x = " << x << ", t = " << t);
    largest = std::max(largest, std::abs(expected));
  });
  BOOST_TEST(largest > 0.1);
}

BOOST_AUTO_TEST_CASE(energy_obeys_its_equation_with_conduction) {
  everywhere([](HotWall const& exact, double x, double t) {
    GasState const s = exact.at(x, t);
    auto conducted = [&](double p) {
      double const gradient = slope([&](double q) { return exact.temperature(q, t); }, p);
      return exact.conductivity(exact.temperature(p, t)) * gradient;
    };
    double const change = rate([&](double p) { return exact.temperature(x, p); }, t) +
                          s.velocity * slope([&](double p) { return exact.temperature(p, t); }, x);
    double const work = s.pressure * slope([&](double p) { return exact.at(p, t).velocity; }, x);
    BOOST_TEST(std::abs(s.density * change + work - slope(conducted, x)) < 1e-8,
               "x = " << x << ", t = " << t);
    BOOST_TEST(std::abs(exact.flux(x, t) + conducted(x)) < 1e-8);
  });
}

BOOST_AUTO_TEST_CASE(pressure_is_that_of_the_gas_law_and_uniform) {
  everywhere([](HotWall const& exact, double x, double t) {
    GasState const s = exact.at(x, t);
    BOOST_TEST(s.pressure == (gamma - 1.0) * density * initial_temperature,
               boost::test_tools::tolerance(1e-15));
    BOOST_TEST(s.pressure == exact.pressure());
    BOOST_TEST(s.pressure == (gamma - 1.0) * s.density * exact.temperature(x, t),
               boost::test_tools::tolerance(1e-14));
  });
}

// The heat that entered stands in the gas as enthalpy above that of the cold gas.
BOOST_AUTO_TEST_CASE(heat_through_the_wall_is_stored_in_the_gas) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    auto stored = [&](double t) {
      double const from = exact.wall_position(t);
      auto excess = [&](double x) {
        return gamma * exact.at(x, t).density * (exact.temperature(x, t) - initial_temperature);
      };
      return integral(excess, from, from + 20.0);
    };
    auto through = [&](double t) { return exact.flux(exact.wall_position(t), t); };
    double const entered = integral(through, 0.0, 3.0);
    BOOST_TEST(stored(3.0) - stored(0.0) == entered, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(std::abs(entered) > 0.01);
  }
}

// The heated gas takes more room, which moves the gas far away: expansion work (gamma-1)/gamma of the heat.
BOOST_AUTO_TEST_CASE(gas_far_away_is_pushed_by_the_expansion) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    double const pushed = exact.material_position(20.0, 3.0) - exact.wall_position(3.0) -
                          exact.material_position(20.0, 0.0) + exact.wall_position(0.0);
    double const entered =
        integral([&](double t) { return exact.flux(exact.wall_position(t), t); }, 0.0, 3.0);
    BOOST_TEST(exact.pressure() * pushed == (gamma - 1.0) / gamma * entered,
               boost::test_tools::tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(wall_holds_its_temperature_and_carries_the_gas) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    for (double const t : {0.0, 0.4, 2.0}) {
      double const x = exact.wall_position(t);
      BOOST_TEST(x == 0.25 * t);
      for (double const behind : {0.0, 0.3}) {
        BOOST_TEST(exact.temperature(x - behind, t) == temperature, boost::test_tools::tolerance(1e-15));
        BOOST_TEST(exact.at(x - behind, t).velocity == 0.25);
        BOOST_TEST(exact.acceleration(x - behind, t) == 0.0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(gas_far_away_is_cold_and_moves_as_one) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    GasState const s = exact.at(20.0, 0.3);
    GasState const farther = exact.at(30.0, 0.3);
    BOOST_TEST(s.density == density, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(exact.temperature(20.0, 0.3) == initial_temperature, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(s.velocity == farther.velocity);
    double const diffusion = density * conductivity / gamma;
    double const expected = 0.25 + (temperature / initial_temperature - 1.0) / density *
                                       std::sqrt(diffusion / (std::numbers::pi * (start_time + 0.3)));
    BOOST_TEST(s.velocity == expected, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(std::abs(exact.flux(20.0, 0.3)) < 1e-100);
  }
}

BOOST_AUTO_TEST_CASE(particles_move_with_the_gas) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    for (double const m : {0.0, 1e-9, 0.01, 0.4, 1.0, 5.0}) {
      double const t = 0.6;
      double const x = exact.material_position(m, t);
      BOOST_TEST(std::abs(exact.mass_coordinate(x, t) - m) < 1e-14 * (1.0 + m));
      double const velocity = rate([&](double s) { return exact.material_position(m, s); }, t);
      BOOST_TEST(std::abs(exact.material_velocity(m, t) - velocity) < 1e-9);
      BOOST_TEST(std::abs(exact.at(x, t).velocity - velocity) < 1e-9);
      double const acceleration = rate([&](double s) { return exact.material_velocity(m, s); }, t);
      BOOST_TEST(std::abs(exact.acceleration(x, t) - acceleration) < 1e-8);
      double const mass = integral([&](double s) { return exact.at(s, t).density; }, 0.25 * t, x);
      BOOST_TEST(std::abs(mass - m) < 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(wall_at_the_gas_temperature_changes_nothing) {
  HotWall const exact = wall(initial_temperature);
  GasState const s = exact.at(0.7, 1.0);
  BOOST_TEST(s.density == density, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(s.velocity == 0.25);
  BOOST_TEST(exact.flux(0.7, 1.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  for (double const temperature : wall_temperatures) {
    HotWall const exact = wall(temperature);
    BOOST_TEST(exact.accuracy() < 1e-13);
    using Real = long double;
    Real const pi = std::numbers::pi_v<Real>;
    Real const T0 = initial_temperature;
    Real const Tw = temperature;
    for (double const t : {0.0, 0.5, 4.0}) {
      Real const mass =
          2 * std::sqrt(Real(density) * Real(conductivity) / Real(gamma) * (Real(start_time) + t));
      auto place = [&](Real eta) {
        Real const ierfc = std::exp(-eta * eta) / std::sqrt(pi) - eta * std::erfc(eta);
        return Real(0.25) * t + mass / density * (eta + (Tw / T0 - 1) * (1 / std::sqrt(pi) - ierfc));
      };
      for (double x = 0.25 * t + 0.05; x < 0.25 * t + 9.0; x += 0.05) {
        Real low = 0;
        Real high = 100;
        for (int step = 0; step < 80; ++step) {
          Real const middle = (low + high) / 2;
          (place(middle) < x ? low : high) = middle;
        }
        Real const expected = T0 + (Tw - T0) * std::erfc(low);
        BOOST_TEST(std::abs(static_cast<double>(exact.temperature(x, t) - expected)) <= exact.accuracy());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { HotWall(0, 1, 1, 1, 1.4, 1, 0); }, "wall must be positive, found 0"));
  BOOST_TEST(refuses([] { HotWall(2, -1, 1, 1, 1.4, 1, 0); }, "initial must be positive, found -1"));
  BOOST_TEST(refuses([] { HotWall(2, 1, 0, 1, 1.4, 1, 0); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { HotWall(2, 1, 1, 0, 1.4, 1, 0); }, "conductivity must be positive, found 0"));
  BOOST_TEST(refuses([] { HotWall(2, 1, 1, 1, 0.5, 1, 0); }, "gamma must be above 1, found 0.5"));
  BOOST_TEST(refuses([] { HotWall(2, 1, 1, 1, 1.4, 0, 0); }, "start_time must be positive, found 0"));
  BOOST_CHECK_THROW(HotWall(2, 1, 1, 1, 1.4, 1, std::numeric_limits<double>::infinity()),
                    std::invalid_argument);
  BOOST_TEST(refuses([] { wall(2.0).at(1.0, -0.5); }, "time must be above -0.5, found -0.5"));
}

BOOST_AUTO_TEST_SUITE_END()
