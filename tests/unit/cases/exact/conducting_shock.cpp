// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/conducting_shock.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_conducting_shock)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double density = 1.2;
constexpr double conductivity = 0.02;
constexpr double centre = 0.3;

struct Jump {
  double initial_pressure, post_pressure, gamma;
  ConductingShock shock() const {
    return ConductingShock(initial_pressure, post_pressure, density, conductivity, gamma, centre);
  }
};

// The allowed ratios are 1.5 for gamma = 1.4, 2 for 5/3, any for 3.
constexpr Jump jumps[] = {{0.8, 1.1, 1.4}, {0.8, 0.88, 1.4}, {1.0, 1.9, 5.0 / 3.0}, {1.0, 8.0, 3.0}};

double energy(GasState const& s, double gamma) {
  return s.pressure / (gamma - 1.0) + 0.5 * s.density * s.velocity * s.velocity;
}

// In the frame of the gas at rest, so that the shock's speed is tested too. A step of a 50th of the shortest
// length of the profile leaves a relative error below 1e-9 of the rates.
BOOST_AUTO_TEST_CASE(mass_momentum_and_energy_are_conserved_with_conduction) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    double const shortest = std::min(exact.length_ahead(), exact.length_behind());
    double const h = 0.02 * shortest;
    for (double const t : {0.0, 0.7}) {
      double const middle = centre + exact.shock_speed() * t;
      for (double const part : {-3.0, -1.0, -0.2, 0.0, 0.3, 1.0, 4.0}) {
        double const x = middle + part * shortest;
        auto rate = [&](auto const& f) {
          return first_derivative([&](double s) { return f(exact.at(x, s)); }, t, h / exact.shock_speed());
        };
        auto slope = [&](auto const& f) {
          return first_derivative([&](double s) { return f(exact.at(s, t), s); }, x, h);
        };
        double const mass_rate = rate([](GasState const& s) { return s.density; });
        double const mass_slope = slope([](GasState const& s, double) { return s.density * s.velocity; });
        double const momentum_rate = rate([](GasState const& s) { return s.density * s.velocity; });
        double const momentum_slope =
            slope([](GasState const& s, double) { return s.density * s.velocity * s.velocity + s.pressure; });
        double const energy_rate = rate([&](GasState const& s) { return energy(s, jump.gamma); });
        double const energy_slope = slope([&](GasState const& s, double p) {
          double const gradient = first_derivative([&](double q) { return exact.temperature(q, t); }, p, h);
          return s.velocity * (energy(s, jump.gamma) + s.pressure) - conductivity * gradient;
        });
        double const size = exact.shock_speed() / shortest;
        BOOST_TEST(std::abs(mass_rate + mass_slope) < 1e-9 * size);
        BOOST_TEST(std::abs(momentum_rate + momentum_slope) < 1e-9 * size);
        BOOST_TEST(std::abs(energy_rate + energy_slope) < 1e-8 * size * jump.post_pressure,
                   "P1 " << jump.post_pressure << ", " << part << ": " << energy_rate + energy_slope);
        if (std::abs(part) < 0.5) BOOST_TEST(std::abs(mass_rate) > 1e-3 * size);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(flux_is_that_of_the_temperature) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    double const shortest = std::min(exact.length_ahead(), exact.length_behind());
    for (double const part : {-3.0, -1.0, 0.0, 0.3, 1.0, 4.0}) {
      double const x = centre + part * shortest;
      double const gradient =
          first_derivative([&](double s) { return exact.temperature(s, 0.0); }, x, 0.02 * shortest);
      BOOST_TEST(exact.flux(x, 0.0) == -conductivity * gradient, boost::test_tools::tolerance(1e-6));
      GasState const s = exact.at(x, 0.0);
      BOOST_TEST(exact.temperature(x, 0.0) == s.pressure / ((jump.gamma - 1.0) * s.density),
                 boost::test_tools::tolerance(1e-15));
    }
  }
}

// The textbook's jump by the Mach number, which the class does not use.
BOOST_AUTO_TEST_CASE(ends_satisfy_the_jump_conditions) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    double const gamma = jump.gamma;
    double const sound = std::sqrt(gamma * jump.initial_pressure / density);
    double const mach =
        std::sqrt(1.0 + (gamma + 1.0) / (2.0 * gamma) * (jump.post_pressure / jump.initial_pressure - 1.0));
    BOOST_TEST(exact.shock_speed() == mach * sound, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(exact.piston_velocity() == 2.0 / (gamma + 1.0) * sound * (mach - 1.0 / mach),
               boost::test_tools::tolerance(1e-13));

    double const t = 0.4;
    double const middle = centre + exact.shock_speed() * t;
    GasState const behind = exact.at(middle - 60.0 * exact.length_behind(), t);
    double const compression = (gamma + 1.0) * mach * mach / ((gamma - 1.0) * mach * mach + 2.0);
    BOOST_TEST(behind.density == density * compression, boost::test_tools::tolerance(1e-13));
    BOOST_TEST(behind.pressure == jump.post_pressure, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(behind.velocity == exact.piston_velocity(), boost::test_tools::tolerance(1e-14));

    GasState const ahead = exact.at(middle + 60.0 * exact.length_ahead(), t);
    BOOST_TEST(ahead.density == density, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(ahead.pressure == jump.initial_pressure, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(ahead.velocity < 1e-15);

    GasState const nowhere = exact.at(middle + 1e6, t);
    BOOST_TEST(nowhere.velocity == 0.0);
    BOOST_TEST(exact.flux(middle + 1e6, t) == 0.0);
    BOOST_TEST(exact.flux(middle - 1e6, t) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(centre_has_half_the_velocity_and_runs_with_the_shock) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    for (double const t : {-1.0, 0.0, 2.5}) {
      GasState const s = exact.at(centre + exact.shock_speed() * t, t);
      BOOST_TEST(s.velocity == 0.5 * exact.piston_velocity(), boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(everything_falls_across_the_shock) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    double const step = 0.1 * std::min(exact.length_ahead(), exact.length_behind());
    double x = centre - 10.0 * exact.length_behind();
    GasState before = exact.at(x, 0.0);
    double temperature = exact.temperature(x, 0.0);
    while ((x += step) < centre + 10.0 * exact.length_ahead()) {
      GasState const s = exact.at(x, 0.0);
      BOOST_TEST_REQUIRE(s.density < before.density);
      BOOST_TEST_REQUIRE(s.velocity < before.velocity);
      BOOST_TEST_REQUIRE(s.pressure < before.pressure);
      BOOST_TEST_REQUIRE(exact.temperature(x, 0.0) < temperature);
      BOOST_TEST_REQUIRE(exact.flux(x, 0.0) > 0.0);
      before = s;
      temperature = exact.temperature(x, 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(profile_dies_away_over_its_lengths) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    double const a = exact.length_ahead();
    double const b = exact.length_behind();
    auto ahead = [&](double n) { return exact.at(centre + n * a, 0.0).velocity; };
    BOOST_TEST(ahead(15.0) / ahead(16.0) == std::exp(1.0), boost::test_tools::tolerance(1e-5));
    auto behind = [&](double n) { return exact.flux(centre - n * b, 0.0); };
    BOOST_TEST(behind(40.0) / behind(41.0) == std::exp(1.0), boost::test_tools::tolerance(1e-5));
  }
}

// The temperature behind would be exceeded inside the profile from 2 w1 = A on: with w = w1 (1 + s) it is
// proportional to (1 + s)(A/w1 - 1 - s), whose slope at s = 0 is A/w1 - 2.
BOOST_AUTO_TEST_CASE(shocks_too_strong_to_be_continuous_are_refused) {
  BOOST_TEST(refuses([] { ConductingShock(1, 1.5, 1, 1, 1.4, 0); },
                     "pressure must be below 1.5 for conduction alone to smooth the shock, "
                     "found 1.5"));
  BOOST_TEST(refuses([] { ConductingShock(2, 7, 1, 1, 2, 0); },
                     "pressure must be below 6 for conduction alone to smooth the shock, "
                     "found 7"));
  ConductingShock const nearly(1, 1.4999, 1, 1, 1.4, 0);
  BOOST_TEST(nearly.length_behind() < 1e-3 * nearly.length_ahead());
  double const w1 = nearly.shock_speed() - nearly.piston_velocity();
  double const A = nearly.shock_speed() + 1.0 / nearly.shock_speed();
  BOOST_TEST(2.0 * w1 > A);
  BOOST_TEST(2.0 * w1 == A, boost::test_tools::tolerance(1e-3));
  BOOST_CHECK_NO_THROW(ConductingShock(1, 1000, 1, 1, 3, 0));
}

BOOST_AUTO_TEST_CASE(state_is_as_accurate_as_promised) {
  for (Jump const& jump : jumps) {
    ConductingShock const exact = jump.shock();
    BOOST_TEST(exact.accuracy() < 1e-14);
    using Real = long double;
    Real const gamma = jump.gamma;
    Real const P0 = jump.initial_pressure;
    Real const P1 = jump.post_pressure;
    Real const j = std::sqrt(Real(density) * ((gamma + 1) * P1 + (gamma - 1) * P0) / 2);
    Real const w0 = j / density;
    Real const A = w0 + P0 / j;
    Real const w1 = 2 * gamma / (gamma + 1) * A - w0;
    Real const length = 2 * Real(conductivity) / (j * (gamma + 1));
    auto place = [&](Real q) {
      return length / (w0 - w1) * (-(2 * w0 - A) * std::log(2 * (1 - q)) + (2 * w1 - A) * std::log(2 * q));
    };
    for (double q = 0.001; q < 1.0; q += 0.009) {
      double const x = centre + static_cast<double>(place(q));
      Real low = 0;
      Real high = 1;
      for (int step = 0; step < 80; ++step) {
        Real const middle = (low + high) / 2;
        (place(middle) < Real(x) - Real(centre) ? low : high) = middle;
      }
      Real const w = w1 + (w0 - w1) * low;
      GasState const s = exact.at(x, 0.0);
      auto error = [](double found, Real expected) {
        return std::abs(static_cast<double>(found - expected));
      };
      BOOST_TEST(error(s.velocity, w0 - w) <= exact.accuracy() * exact.shock_speed());
      BOOST_TEST(error(s.density, j / w) <= exact.accuracy() * static_cast<double>(j / w1));
      BOOST_TEST(error(s.pressure, P0 + j * (w0 - w)) <= exact.accuracy() * jump.post_pressure);
      Real const behind = w1 * (A - w1) / (gamma - 1);
      BOOST_TEST(error(exact.temperature(x, 0.0), w * (A - w) / (gamma - 1)) <=
                 exact.accuracy() * static_cast<double>(behind));
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(
      refuses([] { ConductingShock(0, 1, 1, 1, 1.4, 0); }, "initial_pressure must be positive, found 0"));
  BOOST_TEST(refuses([] { ConductingShock(1, 1, 1, 1, 1.4, 0); }, "pressure must be above 1, found 1"));
  BOOST_TEST(refuses([] { ConductingShock(1, 1.2, -1, 1, 1.4, 0); }, "density must be positive, found -1"));
  BOOST_TEST(
      refuses([] { ConductingShock(1, 1.2, 1, 0, 1.4, 0); }, "conductivity must be positive, found 0"));
  BOOST_TEST(refuses([] { ConductingShock(1, 1.2, 1, 1, 1, 0); }, "gamma must be above 1, found 1"));
  double const infinity = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(ConductingShock(1, 1.2, 1, 1, 1.4, infinity), std::invalid_argument);
  BOOST_CHECK_THROW(ConductingShock(1, infinity, 1, 1, 3.0, 0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
