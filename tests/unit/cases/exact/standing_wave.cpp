// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/standing_wave.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_standing_wave)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double pi = std::numbers::pi;
constexpr double density = 1.2;
constexpr double pressure = 0.8;

double rest_sound_speed(double gamma) { return std::sqrt(gamma * pressure / density); }

StandingWave wave(double amplitude, int mode, double gamma) {
  return StandingWave(amplitude, mode, density, pressure, gamma);
}

/// The exact velocity of a gas of gamma = 3 in the mode 1: u + c and u - c run unchanged at their own values.
double velocity_if_gamma_is_3(double amplitude, double x, double t) {
  double const c0 = rest_sound_speed(3.0);
  auto invariant = [&](double sign) {
    double low = sign * c0 - 1.01 * amplitude * c0;
    double high = sign * c0 + 1.01 * amplitude * c0;
    for (int step = 0; step < 60; ++step) {
      double const middle = 0.5 * (low + high);
      double const start = sign * c0 + amplitude * c0 * std::sin(pi * (x - middle * t));
      (start > middle ? low : high) = middle;
    }
    return low;
  };
  return 0.5 * (invariant(1.0) + invariant(-1.0));
}

/// The equation of the particles' displacements in the mode 1 with all its orders, on the period 0 <= a < 2
/// with differences of sixth order and the classical Runge-Kutta method.
class Particles {
 public:
  Particles(double amplitude, double gamma) : gamma_(gamma), c0_(rest_sound_speed(gamma)) {
    for (int i = 0; i < count; ++i) {
      state_.push_back(0.0);
      state_.push_back(amplitude * c0_ * std::sin(pi * start(i)));
    }
  }

  static double start(int i) { return 2.0 * i / count; }
  static constexpr int count = 100;

  double position(int i) const { return start(i) + displacement(state_, i); }
  double velocity(int i) const { return state_[static_cast<std::size_t>(2 * i + 1)]; }

  void advance(double duration) {
    constexpr int steps = 100;
    double const dt = duration / steps;
    for (int step = 0; step < steps; ++step) {
      State const k1 = rate(state_);
      State const k2 = rate(moved(k1, 0.5 * dt));
      State const k3 = rate(moved(k2, 0.5 * dt));
      State const k4 = rate(moved(k3, dt));
      for (std::size_t j = 0; j < state_.size(); ++j)
        state_[j] += dt / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
  }

 private:
  using State = std::vector<double>;

  static double displacement(State const& state, int i) {
    return state[static_cast<std::size_t>(2 * ((i + count) % count))];
  }

  State moved(State const& direction, double dt) const {
    State result = state_;
    for (std::size_t j = 0; j < result.size(); ++j) result[j] += dt * direction[j];
    return result;
  }

  State rate(State const& state) const {
    constexpr double h = 2.0 / count;
    State result(state.size());
    for (int i = 0; i < count; ++i) {
      auto s = [&](double a) { return displacement(state, i + static_cast<int>(std::lround(a / h))); };
      double const stretch = 1.0 + first_derivative(s, 0.0, h);
      std::size_t const j = static_cast<std::size_t>(2 * i);
      result[j] = state[j + 1];
      result[j + 1] = c0_ * c0_ * second_derivative(s, 0.0, h) * std::pow(stretch, -gamma_ - 1.0);
    }
    return result;
  }

  double gamma_;
  double c0_;
  State state_;
};

/// The largest error of the velocity during the first period.
double error_by_particles(double amplitude, double gamma) {
  StandingWave const exact = wave(amplitude, 1, gamma);
  Particles particles(amplitude, gamma);
  double error = 0.0;
  for (int part = 1; part <= 10; ++part) {
    particles.advance(exact.period() / 10.0);
    for (int i = 0; i < Particles::count; ++i) {
      double const found = exact.at(particles.position(i), exact.period() * part / 10.0).velocity;
      error = std::max(error, std::abs(found - particles.velocity(i)));
    }
  }
  return error;
}

double error_if_gamma_is_3(double amplitude) {
  StandingWave const exact = wave(amplitude, 1, 3.0);
  double error = 0.0;
  for (int part = 1; part <= 10; ++part) {
    double const t = exact.period() * part / 10.0;
    for (double x = 0.0; x <= 1.0; x += 0.01)
      error = std::max(error, std::abs(exact.at(x, t).velocity - velocity_if_gamma_is_3(amplitude, x, t)));
  }
  return error;
}

BOOST_AUTO_TEST_CASE(velocity_is_as_accurate_as_promised_against_the_exact_flow_of_gamma_3) {
  for (double const amplitude : {0.01, 0.02, 0.04}) {
    double const error = error_if_gamma_is_3(amplitude);
    double const promised = wave(amplitude, 1, 3.0).accuracy();
    BOOST_TEST(error <= promised, amplitude << ": " << error / promised);
    BOOST_TEST(error > 0.5 * promised);
  }
  BOOST_TEST(error_if_gamma_is_3(0.02) / error_if_gamma_is_3(0.01) == 8.0,
             boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(velocity_is_as_accurate_as_promised_against_the_equation_with_all_its_orders) {
  for (double const gamma : {1.1, 1.4, 5.0 / 3.0, 3.0}) {
    for (double const amplitude : {0.02, 0.05, 0.1}) {
      double const error = error_by_particles(amplitude, gamma);
      double const promised = wave(amplitude, 1, gamma).accuracy();
      BOOST_TEST(error <= promised, "gamma " << gamma << ", " << amplitude << ": " << error / promised);
      BOOST_TEST(error > 0.5 * promised, "gamma " << gamma << ", " << amplitude << ": " << error / promised);
    }
    BOOST_TEST(error_by_particles(0.02, gamma) / error_by_particles(0.01, gamma) == 8.0,
               boost::test_tools::tolerance(0.05));
  }
}

// Mass and entropy hold without the expansion's error; steps of 0.002, truncation below 1e-8.
BOOST_AUTO_TEST_CASE(mass_and_entropy_are_exact) {
  StandingWave const exact = wave(0.05, 2, 1.4);
  for (double const t : {0.1, 0.4, 0.9}) {
    for (double const x : {0.1, 0.3, 0.55, 0.8}) {
      double const rate = first_derivative([&](double s) { return exact.at(x, s).density; }, t, 0.002);
      auto flow = [&](double s) { return exact.at(s, t).density * exact.at(s, t).velocity; };
      BOOST_TEST(std::abs(rate + first_derivative(flow, x, 0.002)) < 1e-8);
      GasState const s = exact.at(x, t);
      BOOST_TEST(s.pressure == pressure * std::pow(s.density / density, 1.4),
                 boost::test_tools::tolerance(1e-14));
    }
    double const mass = integral([&](double x) { return exact.at(x, t).density; }, 0.0, 1.0);
    BOOST_TEST(mass == density, boost::test_tools::tolerance(1e-12));
  }
}

// What momentum misses is of the third order: eight times less with half the amplitude.
BOOST_AUTO_TEST_CASE(momentum_is_conserved_to_the_second_order) {
  auto missing = [](double amplitude) {
    StandingWave const exact = wave(amplitude, 1, 1.4);
    double largest = 0.0;
    for (double const t : {0.2, 0.7, 1.3}) {
      for (double const x : {0.15, 0.35, 0.6, 0.85}) {
        GasState const s = exact.at(x, t);
        auto along = [&](auto const& f) {
          return first_derivative([&](double p) { return f(exact.at(p, t)); }, x, 0.005);
        };
        double const rate = first_derivative([&](double p) { return exact.at(x, p).velocity; }, t, 0.005);
        double const residual = rate + s.velocity * along([](GasState const& q) { return q.velocity; }) +
                                along([](GasState const& q) { return q.pressure; }) / s.density;
        largest = std::max(largest, std::abs(residual));
      }
    }
    return largest;
  };
  BOOST_TEST(missing(0.01) / missing(0.005) == 8.0, boost::test_tools::tolerance(0.05));
  BOOST_TEST(missing(0.01) < 30.0 * 1e-6);
}

BOOST_AUTO_TEST_CASE(gas_starts_with_uniform_pressure_and_a_sine_of_velocity) {
  for (int const mode : {1, 3}) {
    StandingWave const exact = wave(0.03, mode, 1.4);
    for (double x = 0.0; x <= 1.0; x += 0.05) {
      GasState const s = exact.at(x, 0.0);
      BOOST_TEST(s.density == density);
      BOOST_TEST(s.pressure == pressure);
      double const expected = 0.03 * rest_sound_speed(1.4) * std::sin(mode * pi * x);
      BOOST_TEST(std::abs(s.velocity - expected) < 1e-15);
    }
  }
}

BOOST_AUTO_TEST_CASE(walls_are_rigid) {
  for (int const mode : {1, 2, 5}) {
    StandingWave const exact = wave(0.05, mode, 1.4);
    for (double const part : {0.1, 0.45, 1.0, 1.7}) {
      for (double const wall : {0.0, 1.0})
        BOOST_TEST(std::abs(exact.at(wall, part * exact.period()).velocity) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(mode_n_is_mode_1_n_times_smaller_and_faster) {
  StandingWave const first = wave(0.05, 1, 1.4);
  StandingWave const third = wave(0.05, 3, 1.4);
  BOOST_TEST(first.period() == 2.0 / rest_sound_speed(1.4), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(first.period() == 3.0 * third.period(), boost::test_tools::tolerance(1e-15));
  for (double const x : {0.05, 0.15, 0.3}) {
    GasState const a = first.at(3.0 * x, 0.9);
    GasState const b = third.at(x, 0.3);
    BOOST_TEST(std::abs(a.velocity - b.velocity) < 1e-14);
    BOOST_TEST(std::abs(a.pressure - b.pressure) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(small_wave_is_that_of_linear_acoustics) {
  double const amplitude = 1e-6;
  StandingWave const exact = wave(amplitude, 1, 1.4);
  double const c0 = rest_sound_speed(1.4);
  for (double const t : {0.1, 0.8, 1.6}) {
    for (double const x : {0.2, 0.7}) {
      GasState const s = exact.at(x, t);
      double const u = amplitude * c0 * std::sin(pi * x) * std::cos(pi * c0 * t);
      double const p = -density * c0 * c0 * amplitude * std::cos(pi * x) * std::sin(pi * c0 * t);
      BOOST_TEST(std::abs(s.velocity - u) < 10.0 * amplitude * amplitude);
      BOOST_TEST(std::abs(s.pressure - pressure - p) < 10.0 * amplitude * amplitude);
    }
  }
}

// With gamma = 3 the steepest u + c of the start, falling by pi amplitude c0, breaks after the inverse of it.
BOOST_AUTO_TEST_CASE(times_to_the_formation_of_a_shock_are_allowed) {
  StandingWave const exact = wave(0.1, 1, 3.0);
  BOOST_TEST(exact.shock_formation_time() == 1.0 / (pi * 0.1 * rest_sound_speed(3.0)),
             boost::test_tools::tolerance(1e-14));
  for (double const gamma : {1.1, 1.4, 3.0}) {
    StandingWave const strong = wave(0.99 / (gamma + 1.0), 1, gamma);
    for (double x = 0.0; x <= 1.0; x += 0.01) {
      for (double const part : {0.2, 0.5, 0.8, 1.0}) {
        GasState const s = strong.at(x, part * strong.shock_formation_time());
        BOOST_TEST_REQUIRE(s.density > 0.0);
        BOOST_TEST_REQUIRE(s.density < 100.0 * density);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { StandingWave(0, 1, 1, 1, 1.4); }, "amplitude must be positive, found 0"));
  BOOST_TEST(refuses([] { StandingWave(0.6, 1, 1, 1, 1.5); }, "amplitude must be below 0.4, found 0.6"));
  BOOST_TEST(refuses([] { StandingWave(0.1, 0, 1, 1, 1.4); }, "mode must be 1 or more, found 0"));
  BOOST_TEST(refuses([] { StandingWave(0.1, 1, 0, 1, 1.4); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { StandingWave(0.1, 1, 1, -1, 1.4); }, "pressure must be positive, found -1"));
  BOOST_TEST(refuses([] { StandingWave(0.1, 1, 1, 1, 1); }, "gamma must be above 1, found 1"));
  BOOST_CHECK_THROW(StandingWave(std::numeric_limits<double>::quiet_NaN(), 1, 1, 1, 1.4),
                    std::invalid_argument);
  StandingWave const exact = wave(0.1, 1, 1.4);
  BOOST_TEST(refuses([&] { exact.at(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_NO_THROW(exact.at(0.5, exact.shock_formation_time()));
  BOOST_CHECK_THROW(exact.at(0.5, 1.001 * exact.shock_formation_time()), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
