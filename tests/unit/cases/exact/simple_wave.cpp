// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/simple_wave.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_simple_wave)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double rise_time = 0.8;
constexpr double density = 1.3;
constexpr double pressure = 0.9;

struct Piston {
  double speed, gamma;
  SimpleWave wave() const { return SimpleWave(speed, rise_time, density, pressure, gamma); }
  double rest_sound_speed() const { return std::sqrt(gamma * pressure / density); }
  double characteristic(double tau, double t) const {
    SimpleWave const exact = wave();
    double const speed_there = rest_sound_speed() + 0.5 * (gamma + 1.0) * exact.piston_velocity(tau);
    return exact.piston_position(tau) + speed_there * (t - tau);
  }
  double latest() const { return std::min(0.9 * wave().shock_formation_time(), 2.0); }
};

constexpr Piston compressing[] = {{0.3, 1.4}, {1.5, 5.0 / 3.0}, {0.02, 3.0}};
constexpr Piston all[] = {{0.3, 1.4}, {1.5, 5.0 / 3.0}, {0.02, 3.0}, {-0.9, 1.4}, {-0.2, 1.1}};

double internal(GasState const& s, double gamma) { return s.pressure / (gamma - 1.0); }

double entropy(GasState const& s, double gamma) { return s.pressure / std::pow(s.density, gamma); }

// Between the characteristics tau = 0 and tau = rise time, where all is smooth. Steps of 0.001 in x and t:
// truncation below 1e-8, at 3/4 of the formation time too.
BOOST_AUTO_TEST_CASE(state_solves_the_equations_of_gas_dynamics) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    double const formation = std::min(exact.shock_formation_time(), 3.0);
    for (double const fraction : {0.3, 0.6, 0.75}) {
      double const t = fraction * formation;
      for (double const part : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        double const x = piston.characteristic(part * std::min(t, rise_time), t);
        auto at_time = [&](auto const& f) {
          return first_derivative([&](double s) { return f(exact.at(x, s)); }, t, 0.001);
        };
        auto along = [&](auto const& f) {
          return first_derivative([&](double s) { return f(exact.at(s, t)); }, x, 0.001);
        };
        GasState const s = exact.at(x, t);
        double const density_rate = at_time([](GasState const& q) { return q.density; });
        double const mass_flow = along([](GasState const& q) { return q.density * q.velocity; });
        double const momentum_rate = at_time([](GasState const& q) { return q.density * q.velocity; });
        double const push =
            along([](GasState const& q) { return q.density * q.velocity * q.velocity + q.pressure; });
        auto entropy_of = [&](GasState const& q) { return entropy(q, piston.gamma); };
        double const entropy_rate = at_time(entropy_of) + s.velocity * along(entropy_of);
        double const size = std::abs(along([](GasState const& q) { return q.velocity; }));
        BOOST_TEST(
            std::abs(density_rate + mass_flow) < 2e-8 * (1.0 + size),
            "speed " << piston.speed << ", x " << x << ", t " << t << ": " << density_rate + mass_flow);
        BOOST_TEST(std::abs(momentum_rate + push) < 2e-8 * (1.0 + size));
        BOOST_TEST(std::abs(entropy_rate) < 1e-11 * (1.0 + size));
        BOOST_TEST(size > 0.1 * std::abs(piston.speed));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(gas_moves_with_the_piston_which_moves_as_documented) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    for (double const t : {0.05, 0.3, 0.7, 0.9, 1.5}) {
      double const root = std::sin(0.5 * std::numbers::pi * t / rise_time);
      double const expected = t < rise_time ? piston.speed * root * root : piston.speed;
      BOOST_TEST(std::abs(exact.piston_velocity(t) - expected) < 1e-15);
      double const rate = first_derivative([&](double s) { return exact.piston_position(s); }, t, 0.01);
      BOOST_TEST(std::abs(rate - expected) < 1e-9);
      if (t > exact.shock_formation_time()) continue;
      BOOST_TEST(std::abs(exact.at(exact.piston_position(t), t).velocity - expected) <= exact.accuracy());
      double const behind = exact.piston_position(t) - 0.1;
      BOOST_TEST(exact.at(behind, t).velocity == exact.piston_velocity(t));
    }
    BOOST_TEST(exact.piston_position(0.0) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(entropy_and_the_receding_invariant_are_those_of_the_gas_at_rest) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    double const gamma = piston.gamma;
    double const invariant = -2.0 / (gamma - 1.0) * piston.rest_sound_speed();
    double const t = piston.latest();
    for (double x = exact.piston_position(t) - 0.1; x < piston.rest_sound_speed() * t + 0.2; x += 0.02) {
      GasState const s = exact.at(x, t);
      BOOST_TEST(s.velocity - 2.0 / (gamma - 1.0) * sound_speed(s, gamma) == invariant,
                 boost::test_tools::tolerance(1e-14));
      BOOST_TEST(entropy(s, gamma) == pressure / std::pow(density, gamma),
                 boost::test_tools::tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(gas_ahead_of_the_first_sound_is_at_rest) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    double const t = piston.latest();
    for (double const ahead : {0.0, 1e-12, 3.0}) {
      GasState const s = exact.at(piston.rest_sound_speed() * t * (1.0 + ahead) + ahead, t);
      BOOST_TEST(s.velocity == 0.0);
      BOOST_TEST(s.density == density);
      BOOST_TEST(s.pressure == pressure);
    }
    BOOST_TEST(std::abs(exact.at(piston.rest_sound_speed() * t - 0.05, t).velocity) > 0.0);
  }
}

// From the piston to the first sound, in two pieces: the derivative jumps where tau = rise time.
BOOST_AUTO_TEST_CASE(gas_swept_by_the_wave_keeps_its_mass_and_gains_the_work_and_push_of_the_piston) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    double const t = piston.latest();
    double const from = exact.piston_position(t);
    double const kink = piston.characteristic(std::min(t, rise_time), t);
    double const to = piston.rest_sound_speed() * t;
    auto total = [&](auto const& f) {
      auto at = [&](double x) { return f(exact.at(x, t)); };
      return integral(at, from, kink) + integral(at, kink, to);
    };
    auto over_time = [&](auto const& f) {
      double const split = std::min(t, rise_time);
      return integral(f, 0.0, split) + integral(f, split, t);
    };
    auto pressure_at_piston = [&](double s) { return exact.at(exact.piston_position(s), s).pressure; };
    double const mass = total([](GasState const& s) { return s.density; });
    double const momentum = total([](GasState const& s) { return s.density * s.velocity; });
    double const energy = total([&](GasState const& s) {
      return internal(s, piston.gamma) + 0.5 * s.density * s.velocity * s.velocity;
    });
    double const work = over_time([&](double s) { return pressure_at_piston(s) * exact.piston_velocity(s); });
    double const push = over_time([&](double s) { return pressure_at_piston(s) - pressure; });
    BOOST_TEST(mass == density * to, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(std::abs(momentum - push) < 1e-10);
    BOOST_TEST(std::abs(energy - pressure / (piston.gamma - 1.0) * to - work) < 1e-10);
  }
}

// The first time at which 4000 characteristics, followed with the piston's motion alone, no longer stand in
// order: above the true one by a relative error of order 1/4000^2.
BOOST_AUTO_TEST_CASE(shock_forms_when_the_first_two_characteristics_meet) {
  for (Piston const& piston : compressing) {
    SimpleWave const exact = piston.wave();
    auto crossed = [&](double t) {
      constexpr int count = 4000;
      double previous = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= count; ++i) {
        double const tau = rise_time * i / count;
        if (tau > t) break;
        double const x = piston.characteristic(tau, t);
        if (x > previous) return true;
        previous = x;
      }
      return false;
    };
    double low = 0.0;
    double high = 1000.0;
    while (high - low > 1e-9 * high) {
      double const middle = 0.5 * (low + high);
      (crossed(middle) ? high : low) = middle;
    }
    BOOST_TEST(exact.shock_formation_time() == high, boost::test_tools::tolerance(1e-6));
  }
}

// As the crossing nears, the slope grows as 1/(formation - t).
BOOST_AUTO_TEST_CASE(profile_steepens_without_bound_towards_the_formation) {
  for (Piston const& piston : compressing) {
    SimpleWave const exact = piston.wave();
    auto steepest = [&](double fraction) {
      double const t = fraction * exact.shock_formation_time();
      double slope = 0.0;
      constexpr int count = 2000;
      for (int i = 1; i < count; ++i) {
        double const tau = std::min(t, rise_time) * i / count;
        double const x = piston.characteristic(tau, t);
        double const next = piston.characteristic(tau + 1e-5, t);
        slope = std::max(slope, (exact.at(x, t).velocity - exact.at(next, t).velocity) / (next - x));
      }
      return std::abs(slope);
    };
    BOOST_TEST(steepest(0.999) / steepest(0.99) == 10.0, boost::test_tools::tolerance(0.1));
  }
}

BOOST_AUTO_TEST_CASE(expansion_and_a_piston_at_rest_form_no_shock) {
  for (double const speed : {-0.5, 0.0}) {
    SimpleWave const exact(speed, rise_time, density, pressure, 1.4);
    BOOST_TEST(exact.shock_formation_time() == std::numeric_limits<double>::infinity());
    GasState const s = exact.at(exact.piston_position(50.0), 50.0);
    BOOST_TEST(s.velocity == speed);
    double const ratio = 1.0 + 0.2 * speed / std::sqrt(1.4 * pressure / density);
    BOOST_TEST(s.density == density * std::pow(ratio, 5.0), boost::test_tools::tolerance(1e-14));
    BOOST_TEST(s.pressure == pressure * std::pow(ratio, 7.0), boost::test_tools::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(velocity_density_and_pressure_are_as_accurate_as_promised) {
  for (Piston const& piston : all) {
    SimpleWave const exact = piston.wave();
    BOOST_TEST(exact.accuracy() < 1e-12);
    using Real = long double;
    Real const gamma = piston.gamma;
    Real const c0 = std::sqrt(gamma * Real(pressure) / Real(density));
    Real const rise = rise_time;
    Real const pi = std::numbers::pi_v<Real>;
    double const t = piston.latest();
    Real const last = std::min(t, rise_time);
    auto velocity = [&](Real tau) {
      Real const root = std::sin(pi * tau / (2 * rise));
      return piston.speed * root * root;
    };
    auto place = [&](Real tau) {
      Real const position = piston.speed * (tau - rise / pi * std::sin(pi * tau / rise)) / 2;
      return position + (c0 + (gamma + 1) / 2 * velocity(tau)) * (t - tau);
    };
    for (double part = 0.01; part < 1.0; part += 0.01) {
      double const x = static_cast<double>(place(part * last));
      Real low = 0;
      Real high = last;
      for (int step = 0; step < 70; ++step) {
        Real const middle = (low + high) / 2;
        (place(middle) > x ? low : high) = middle;
      }
      Real const u = velocity(low);
      Real const ratio = 1 + (gamma - 1) / 2 * u / c0;
      GasState const s = exact.at(x, t);
      BOOST_TEST(std::abs(static_cast<double>(s.velocity - u)) <= exact.accuracy());
      Real const density_ratio = std::pow(ratio, 2 / (gamma - 1));
      BOOST_TEST(std::abs(static_cast<double>(s.density / density - density_ratio)) <= exact.accuracy());
      Real const pressure_ratio = density_ratio * ratio * ratio;
      BOOST_TEST(std::abs(static_cast<double>(s.pressure / pressure - pressure_ratio)) <= exact.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { SimpleWave(1, 0, 1, 1, 1.4); }, "rise_time must be positive, found 0"));
  BOOST_TEST(refuses([] { SimpleWave(1, 1, -1, 1, 1.4); }, "density must be positive, found -1"));
  BOOST_TEST(refuses([] { SimpleWave(1, 1, 1, 0, 1.4); }, "pressure must be positive, found 0"));
  BOOST_TEST(refuses([] { SimpleWave(1, 1, 1, 1, 1); }, "gamma must be above 1, found 1"));
  BOOST_TEST(refuses([] { SimpleWave(-5, 1, 1, 0.5, 2); }, "speed must be above -2, found -5"));
  BOOST_CHECK_THROW(SimpleWave(std::numeric_limits<double>::quiet_NaN(), 1, 1, 1, 1.4),
                    std::invalid_argument);
  SimpleWave const exact(0.3, 1.0, 1.0, 1.0, 1.4);
  BOOST_TEST(refuses([&] { exact.at(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(exact.piston_position(-1.0), std::invalid_argument);
  BOOST_CHECK_THROW(exact.piston_velocity(-1.0), std::invalid_argument);
  double const formation = exact.shock_formation_time();
  BOOST_CHECK_NO_THROW(exact.at(1.0, formation));
  BOOST_CHECK_THROW(exact.at(1.0, 1.0001 * formation), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
