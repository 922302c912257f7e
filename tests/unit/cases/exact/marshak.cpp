// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/marshak.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_marshak)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double exponents[] = {0.3, 1.0, 2.0, 3.0, 6.0};

/// A second route to the wave: w = T^n integrated by GSL (Prince-Dormand 8(9), tolerance 1e-14) from just
/// behind a front assumed at xi = front. With s = front - xi: w w'' + w'^2/n - (front - s) w'/2 = 0, started
/// from w = a s + b s^2.
class Shot {
 public:
  Shot(double exponent, double front) : exponent_(exponent), front_(front) {}

  /// w at the places `front - xi`, which must ascend.
  std::vector<double> at(std::vector<double> const& places) const {
    // Balancing orders 0 and 1 by hand; what is left out is 1e-14 of w at the start, and decays from there.
    double const n = exponent_;
    double const a = 0.5 * n * front_;
    double const b = -0.25 * n / (n + 1.0);
    double s = 1e-6 * front_;
    std::array<double, 2> w{s * (a + s * b), a + s * 2.0 * b};
    gsl_odeiv2_system system{&Shot::derivatives, nullptr, 2, const_cast<Shot*>(this)};
    std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> const driver(
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6 * front_, 1e-18, 1e-14),
        &gsl_odeiv2_driver_free);
    std::vector<double> values;
    for (double const place : places) {
      BOOST_REQUIRE(gsl_odeiv2_driver_apply(driver.get(), &s, place, w.data()) == GSL_SUCCESS);
      values.push_back(w[0]);
    }
    return values;
  }

  double at_wall() const { return at({front_}).front(); }

 private:
  static int derivatives(double s, double const* w, double* slope, void* data) {
    Shot const& shot = *static_cast<Shot const*>(data);
    slope[0] = w[1];
    slope[1] = (0.5 * (shot.front_ - s) - w[1] / shot.exponent_) * w[1] / w[0];
    return GSL_SUCCESS;
  }

  double exponent_;
  double front_;
};

/// xi_f as the root of w(wall) = 1, by Brent's method.
double front_by_root_search(double exponent) {
  gsl_function mismatch;
  mismatch.function = [](double front, void* n) {
    return Shot(*static_cast<double*>(n), front).at_wall() - 1.0;
  };
  mismatch.params = &exponent;
  std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> const solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &mismatch, 1.3 / std::sqrt(exponent), 2.1 / std::sqrt(exponent));
  for (int i = 0; i < 60; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()), gsl_root_fsolver_x_upper(solver.get()),
                               0.0, 1e-14) == GSL_SUCCESS) {
      break;
    }
  }
  return gsl_root_fsolver_root(solver.get());
}

BOOST_AUTO_TEST_CASE(front_agrees_with_integration_and_root_search) {
  for (double const n : exponents) {
    double const expected = front_by_root_search(n);
    BOOST_TEST_MESSAGE("n = " << n << ": relative difference "
                              << Marshak(n).front_constant() / expected - 1.0);
    BOOST_TEST(Marshak(n).front_constant() == expected, boost::test_tools::tolerance(1e-12));
  }
}

// f(xi) -> lambda^(2/n) f(xi/lambda) turns one solution into another, so that a single shot from any front
// gives xi_f.
BOOST_AUTO_TEST_CASE(front_agrees_with_any_single_shot_by_scaling) {
  for (double const n : exponents) {
    for (double const front : {0.5, 1.0, 3.0}) {
      double const expected = front / std::sqrt(Shot(n, front).at_wall());
      BOOST_TEST(Marshak(n).front_constant() == expected, boost::test_tools::tolerance(1e-12));
    }
  }
}

// At this exponent the fifth coefficient of the series about the front is zero, but the sixth is not.
BOOST_AUTO_TEST_CASE(a_vanishing_coefficient_does_not_end_the_series) {
  double const n = 3.065155233767972;
  BOOST_TEST(Marshak(n).front_constant() == 1.0 / std::sqrt(Shot(n, 1.0).at_wall()),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  for (double const n : exponents) {
    Marshak const exact(n);
    BOOST_TEST(exact.accuracy() < 1e-11);
    double const front = exact.front_constant();
    std::vector<double> places{1e-4 * front};
    for (double fraction = 0.01; fraction < 1.0; fraction += 0.01) places.push_back(fraction * front);
    std::vector<double> const w = Shot(n, front).at(places);
    double worst = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      double const expected = std::pow(w[i], 1.0 / n);
      worst = std::max(worst, std::abs(exact.temperature(front - places[i], 1.0) - expected));
    }
    BOOST_TEST_MESSAGE("n = " << n << ": largest difference of temperature " << worst);
    BOOST_TEST(worst <= exact.accuracy());
  }
}

// Up to 0.9 of the front a step of 0.004 front gives a truncation error below 1e-6 of the rates, which are of
// order 1.
BOOST_AUTO_TEST_CASE(temperature_solves_the_nonlinear_equation_behind_the_front) {
  for (double const n : exponents) {
    Marshak const exact(n);
    for (double const t : {0.3, 1.0, 4.0}) {
      double const front = exact.front(t);
      for (double x = 0.05 * front; x < 0.9 * front; x += 0.05 * front) {
        double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 0.002 * t);
        auto integrated = [&](double s) { return std::pow(exact.temperature(s, t), n + 1.0) / (n + 1.0); };
        double const curvature = second_derivative(integrated, x, 0.004 * front);
        BOOST_TEST(std::abs(rate - curvature) < 1e-6, "n = " << n << ", x = " << x << ", t = " << t);
      }
    }
  }
}

/// Explicit finite volumes for u_t = (u^4/4)_xx, which know of no front and no similarity.
std::vector<double> finite_volumes(std::size_t cells, double width, double end) {
  double const dx = width / static_cast<double>(cells);
  int const steps = static_cast<int>(std::ceil(end / (0.4 * dx * dx)));
  double const dt = end / steps;
  std::vector<double> u(cells, 0.0);
  auto potential = [](double value) { return 0.25 * value * value * value * value; };
  for (int step = 0; step < steps; ++step) {
    double inflow = 2.0 * (potential(1.0) - potential(u[0])) / dx;
    for (std::size_t i = 0; i < cells; ++i) {
      double const outflow = i + 1 < cells ? (potential(u[i]) - potential(u[i + 1])) / dx : 0.0;
      u[i] += dt / dx * (inflow - outflow);
      inflow = outflow;
    }
  }
  return u;
}

BOOST_AUTO_TEST_CASE(finite_volumes_converge_to_it_from_the_initial_and_wall_values_alone) {
  Marshak const exact(3.0);
  double const width = 0.5;
  double const end = 0.2;
  std::vector<double> errors;
  for (std::size_t const cells : {50, 100, 200}) {
    std::vector<double> const u = finite_volumes(cells, width, end);
    double const dx = width / static_cast<double>(cells);
    double error = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      error += dx * std::abs(u[i] - exact.temperature((static_cast<double>(i) + 0.5) * dx, end));
    }
    errors.push_back(error);
    BOOST_TEST_MESSAGE(cells << " cells: l1 error " << error);
  }
  BOOST_TEST(errors[2] < 1.5e-4);
  BOOST_TEST(errors[2] < 0.6 * errors[1]);
  BOOST_TEST(errors[1] < 0.6 * errors[0]);
}

BOOST_AUTO_TEST_CASE(energy_in_the_medium_is_what_came_through_the_wall) {
  for (double const n : exponents) {
    Marshak const exact(n);
    for (double const t : {0.04, 1.0}) {
      double const energy = integral([&](double x) { return exact.temperature(x, t); }, 0.0, exact.front(t));
      BOOST_TEST(energy == exact.total_energy(t), boost::test_tools::tolerance(1e-10));
      // s = sqrt(time) takes the flux's singularity at the start out of the integrand.
      double const given =
          integral([&](double s) { return exact.wall_flux(s * s) * 2.0 * s; }, 0.0, std::sqrt(t));
      BOOST_TEST(energy == given, boost::test_tools::tolerance(1e-10));
    }
  }
}

BOOST_AUTO_TEST_CASE(wall_flux_is_conductivity_times_gradient_there) {
  for (double const n : exponents) {
    Marshak const exact(n);
    for (double const t : {0.04, 1.0}) {
      double const expected = -exact.conductivity(1.0) * exact.gradient(0.0, t);
      BOOST_TEST(exact.wall_flux(t) == expected, boost::test_tools::tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature_and_zero_beyond_the_front) {
  for (double const n : exponents) {
    Marshak const exact(n);
    for (double const t : {0.5, 2.0}) {
      double const front = exact.front(t);
      for (double const fraction : {0.02, 0.3, 0.6, 0.85}) {
        double const x = fraction * front;
        double const expected =
            first_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.004 * front);
        BOOST_TEST(exact.gradient(x, t) == expected, boost::test_tools::tolerance(1e-8));
      }
      BOOST_TEST(exact.gradient(front, t) == 0.0);
      BOOST_TEST(exact.gradient(1.5 * front, t) == 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(wall_is_at_one_and_the_wave_falls_to_zero_at_its_front) {
  for (double const n : exponents) {
    Marshak const exact(n);
    for (double const t : {0.04, 1.0}) {
      BOOST_TEST(exact.temperature(0.0, t) == 1.0);
      double const front = exact.front(t);
      double previous = 1.0;
      for (double fraction = 0.02; fraction < 1.0; fraction += 0.02) {
        double const value = exact.temperature(fraction * front, t);
        BOOST_TEST(value < previous);
        BOOST_TEST(value > 0.0);
        previous = value;
      }
      BOOST_TEST(exact.temperature(front * (1.0 - 1e-13), t) > 0.0);
      BOOST_TEST(exact.temperature(front * (1.0 + 1e-13), t) == 0.0);
      BOOST_TEST(exact.temperature(10.0 * front, t) == 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(front_moves_at_the_speed_that_the_profile_drives) {
  for (double const n : exponents) {
    Marshak const exact(n);
    double const x = exact.front(1.0) * (1.0 - 1e-6);
    double const slope =
        -first_derivative([&](double s) { return std::pow(exact.temperature(s, 1.0), n) / n; }, x, 1e-7 * x);
    double const speed = first_derivative([&](double t) { return exact.front(t); }, 1.0, 0.01);
    BOOST_TEST(slope == speed, boost::test_tools::tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(front_constant_stays_within_its_limits_of_large_and_small_exponents) {
  BOOST_TEST(Marshak(1000.0).front_constant() * std::sqrt(1000.0) == std::sqrt(2.0),
             boost::test_tools::tolerance(1e-3));
  BOOST_TEST(Marshak(0.002).front_constant() * std::sqrt(0.002) == 2.0, boost::test_tools::tolerance(1e-2));
}

// As n -> 0 the equation becomes linear, and the wave the erfc of a half space.
BOOST_AUTO_TEST_CASE(small_exponents_approach_the_linear_solution) {
  for (double const n : {0.02, 0.002}) {
    Marshak const exact(n);
    for (double const x : {0.3, 1.0, 2.0}) {
      BOOST_TEST(std::abs(exact.temperature(x, 1.0) - std::erfc(0.5 * x)) < 0.3 * n,
                 "n = " << n << ", x = " << x);
    }
  }
}

BOOST_AUTO_TEST_CASE(initial_state_is_cold_except_at_the_wall) {
  Marshak const exact(3.0);
  BOOST_TEST(exact.temperature(0.0, 0.0) == 1.0);
  BOOST_TEST(exact.temperature(1e-300, 0.0) == 0.0);
  BOOST_TEST(exact.gradient(0.0, 0.0) == -std::numeric_limits<double>::infinity());
  BOOST_TEST(exact.gradient(0.1, 0.0) == 0.0);
  BOOST_TEST(exact.front(0.0) == 0.0);
  BOOST_TEST(exact.total_energy(0.0) == 0.0);
  BOOST_TEST(exact.wall_flux(0.0) == std::numeric_limits<double>::infinity());
}

BOOST_AUTO_TEST_CASE(conductivity_is_a_power_and_zero_without_heat) {
  Marshak const exact(3.0);
  BOOST_TEST(exact.conductivity(0.5) == 0.125);
  BOOST_TEST(exact.conductivity(0.0) == 0.0);
  BOOST_TEST(exact.conductivity(-0.5) == 0.0);
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { Marshak(0.0); }, "exponent must be positive, found 0"));
  BOOST_TEST(refuses([] { Marshak(-1.0); }, "exponent must be positive, found -1"));
  BOOST_CHECK_THROW(Marshak{std::numeric_limits<double>::quiet_NaN()}, std::invalid_argument);
  BOOST_CHECK_THROW(Marshak(1e-5), std::invalid_argument);
  BOOST_TEST(refuses([] { Marshak(3.0).temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(Marshak(3.0).gradient(0.5, -1.0), std::invalid_argument);
  BOOST_CHECK_THROW(Marshak(3.0).front(-1.0), std::invalid_argument);
  BOOST_CHECK_THROW(Marshak(3.0).wall_flux(-1.0), std::invalid_argument);
  BOOST_CHECK_THROW(Marshak(3.0).total_energy(-1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
