// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/piston_shock.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "cases/exact/riemann.hpp"
#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_piston_shock)

using namespace sphverify::exact;
using namespace sphverify::tests;

struct Drive {
  double initial_pressure;
  double post_pressure;
  double density;
  double gamma;

  PistonShock solve() const { return PistonShock(initial_pressure, post_pressure, density, gamma); }
};

constexpr Drive drives[] = {{1.0, 3.0, 1.0, 1.4},
                            {0.0, 4.0 / 3.0, 1.0, 5.0 / 3.0},
                            {1e-5, 2e5, 1.2, 1.4},
                            {2.0, 2.02, 0.3, 1.1},
                            {0.5, 7.0, 8.0, 3.0}};

double internal_energy(GasState const& gas, double gamma) {
  return gas.pressure / ((gamma - 1.0) * gas.density);
}

BOOST_AUTO_TEST_CASE(mass_momentum_and_energy_pass_the_shock_unchanged) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    double const speed = exact.shock_speed();
    GasState const before = exact.at(1.001 * speed, 1.0);
    GasState const after = exact.at(0.999 * speed, 1.0);
    auto mass = [&](GasState const& gas) { return gas.density * (speed - gas.velocity); };
    auto momentum = [&](GasState const& gas) { return gas.pressure + mass(gas) * (speed - gas.velocity); };
    auto enthalpy = [&](GasState const& gas) {
      return internal_energy(gas, drive.gamma) + gas.pressure / gas.density +
             0.5 * (speed - gas.velocity) * (speed - gas.velocity);
    };
    BOOST_TEST(mass(before) == mass(after), boost::test_tools::tolerance(1e-13));
    BOOST_TEST(momentum(before) == momentum(after), boost::test_tools::tolerance(1e-13));
    BOOST_TEST(enthalpy(before) == enthalpy(after), boost::test_tools::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(gas_is_at_rest_ahead_and_moves_with_the_piston_behind) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    double const t = 0.7;
    for (double const place : {1.001, 2.0, 1e6}) {
      GasState const gas = exact.at(place * exact.shock_speed() * t, t);
      BOOST_TEST(gas.density == drive.density);
      BOOST_TEST(gas.velocity == 0.0);
      BOOST_TEST(gas.pressure == drive.initial_pressure);
    }
    // Also behind the piston.
    for (double const x : {-1.0, 0.0, exact.piston_velocity() * t, 0.999 * exact.shock_speed() * t}) {
      GasState const gas = exact.at(x, t);
      BOOST_TEST(gas.density == exact.post_density());
      BOOST_TEST(gas.velocity == exact.piston_velocity());
      BOOST_TEST(gas.pressure == drive.post_pressure);
    }
    BOOST_TEST(exact.at(1e-9, 0.0).velocity == 0.0);
    BOOST_TEST(exact.piston_velocity() < exact.shock_speed());
  }
}

BOOST_AUTO_TEST_CASE(mass_between_piston_and_shock_is_what_the_shock_ran_over) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    for (double const t : {0.2, 1.0, 3.0}) {
      double const shock = exact.shock_speed() * t;
      auto density = [&](double x) { return exact.at(x, t).density; };
      BOOST_TEST(integral(density, exact.piston_velocity() * t, shock) == drive.density * shock,
                 boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(piston_does_the_work_that_the_gas_gains) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    double const t = 1.3;
    double const shock = exact.shock_speed() * t;
    double const piston = exact.piston_velocity() * t;
    auto energy = [&](double x) {
      GasState const gas = exact.at(x, t);
      return gas.density * (internal_energy(gas, drive.gamma) + 0.5 * gas.velocity * gas.velocity);
    };
    double const before = drive.initial_pressure / (drive.gamma - 1.0) * shock;
    BOOST_TEST(integral(energy, piston, shock) == before + drive.post_pressure * piston,
               boost::test_tools::tolerance(1e-12));
  }
}

// In the piston's frame it is a wall, and the wall the middle of two equal streams that collide.
BOOST_AUTO_TEST_CASE(agrees_with_the_collision_of_mirror_images) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    double const piston = exact.piston_velocity();
    Riemann const collision({drive.density, piston, drive.initial_pressure},
                            {drive.density, -piston, drive.initial_pressure}, drive.gamma);
    for (double const s : {0.1, 0.5, 0.9, 0.999, 1.001, 1.5}) {
      double const relative = s * (exact.shock_speed() - piston);
      GasState const found = exact.at(piston + relative, 1.0);
      GasState const expected = collision.at(relative);
      BOOST_TEST(found.density == expected.density, boost::test_tools::tolerance(1e-13));
      BOOST_TEST(found.pressure == expected.pressure, boost::test_tools::tolerance(1e-13));
      BOOST_TEST(std::abs(found.velocity - piston - expected.velocity) <= 1e-13 * exact.shock_speed());
    }
    BOOST_TEST(std::abs(exact.shock_speed() - piston - collision.waves().right_head) <=
               1e-13 * exact.shock_speed());
  }
}

BOOST_AUTO_TEST_CASE(entropy_rises_through_the_shock) {
  for (Drive const& drive : drives) {
    GasState const after = drive.solve().at(-1.0, 1.0);
    BOOST_TEST(after.pressure / std::pow(after.density, drive.gamma) >
               drive.initial_pressure / std::pow(drive.density, drive.gamma));
  }
}

// rho c u = rise of pressure = c^2 rise of density; the shock is faster than sound by (gamma+1)/4 u, halfway
// to the speed u + c of sound behind it.
BOOST_AUTO_TEST_CASE(weak_shock_is_a_sound_wave) {
  double const gamma = 1.4;
  double const sound = std::sqrt(gamma * 2.0 / 0.5);
  double const rise = 1e-6;
  PistonShock const exact(2.0, 2.0 + rise, 0.5, gamma);
  BOOST_TEST(exact.piston_velocity() == rise / (0.5 * sound), boost::test_tools::tolerance(1e-6));
  BOOST_TEST(exact.post_density() - 0.5 == rise / (sound * sound), boost::test_tools::tolerance(1e-6));
  BOOST_TEST(exact.shock_speed() - sound == 0.25 * (gamma + 1.0) * exact.piston_velocity(),
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(equal_pressures_leave_the_gas_alone) {
  PistonShock const exact(2.0, 2.0, 0.5, 1.4);
  BOOST_TEST(exact.piston_velocity() == 0.0);
  BOOST_TEST(exact.post_density() == 0.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.shock_speed() == sound_speed({0.5, 0.0, 2.0}, 1.4), boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(strong_shock_reaches_the_limit_of_compression) {
  for (double const gamma : {1.1, 1.4, 5.0 / 3.0}) {
    for (double const initial : {0.0, 1e-14}) {
      PistonShock const exact(initial, 1.0, 3.0, gamma);
      BOOST_TEST(exact.post_density() == 3.0 * (gamma + 1.0) / (gamma - 1.0),
                 boost::test_tools::tolerance(1e-11));
      BOOST_TEST(exact.shock_speed() == 0.5 * (gamma + 1.0) * exact.piston_velocity(),
                 boost::test_tools::tolerance(1e-11));
    }
  }
}

// The Hugoniot curve gives the specific volume behind the shock, and the Rayleigh line the speeds from it.
BOOST_AUTO_TEST_CASE(speeds_and_density_are_as_accurate_as_promised) {
  for (Drive const& drive : drives) {
    PistonShock const exact = drive.solve();
    long double const g = drive.gamma;
    long double const p0 = drive.initial_pressure;
    long double const p1 = drive.post_pressure;
    long double const volume = 1.0L / drive.density;
    long double const post_volume =
        volume * ((g - 1.0L) * p1 + (g + 1.0L) * p0) / ((g + 1.0L) * p1 + (g - 1.0L) * p0);
    long double const piston = std::sqrt((p1 - p0) * (volume - post_volume));
    long double const shock = volume * std::sqrt((p1 - p0) / (volume - post_volume));
    auto near = [&](double found, long double expected) {
      return std::abs(static_cast<double>(found / expected - 1.0L)) <= exact.accuracy();
    };
    BOOST_TEST(exact.accuracy() < 1e-13);
    BOOST_TEST(near(exact.post_density(), 1.0L / post_volume));
    BOOST_TEST(near(exact.piston_velocity(), piston));
    BOOST_TEST(near(exact.shock_speed(), shock));
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(
      refuses([] { PistonShock(-1, 1, 1, 1.4); }, "initial_pressure must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { PistonShock(0, 0, 1, 1.4); }, "pressure must be positive, found 0"));
  BOOST_TEST(refuses([] { PistonShock(2, 1, 1, 1.4); },
                     "pressure must be at least the initial_pressure, 2, found 1"));
  BOOST_TEST(refuses([] { PistonShock(1, 2, 0, 1.4); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { PistonShock(1, 2, 1, 1); }, "gamma must be above 1, found 1"));
  BOOST_TEST(refuses([] { PistonShock(1, 2, 1, 1.4).at(0, -1); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(PistonShock(1, std::numeric_limits<double>::infinity(), 1, 1.4), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
