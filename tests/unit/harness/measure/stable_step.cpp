// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/stable_step.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(harness_measure_stable_step)

using namespace sphverify;
using boost::test_tools::tolerance;
using Complex = std::complex<double>;

ButcherTable const& method(std::string const& name) {
  for (ButcherTable const& one : explicit_methods()) {
    if (one.name == name) return one;
  }
  throw std::out_of_range(name);
}

bool never() { return false; }

Spectrum known_to(std::vector<Complex> eigenvalues, double uncertainty = 0.0) {
  Spectrum all;
  all.eigenvalues = std::move(eigenvalues);
  all.uncertainty.assign(all.eigenvalues.size(), uncertainty);
  return all;
}

/// Heat conduction on a rod: second differences of n points between cold ends, at unit spacing.
struct Rod {
  std::size_t n;
  void operator()(double const* y, double* out) const {
    for (std::size_t i = 0; i < n; ++i)
      out[i] = (i > 0 ? y[i - 1] : 0.0) - 2.0 * y[i] + (i + 1 < n ? y[i + 1] : 0.0) + 3.0;  // and a source
  }
  std::vector<Complex> eigenvalues() const {
    std::vector<Complex> all;
    for (std::size_t k = 1; k <= n; ++k) {
      double const s = std::sin(0.5 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n + 1));
      all.emplace_back(-4.0 * s * s);
    }
    return all;
  }
};

BOOST_AUTO_TEST_CASE(one_step_multiplies_by_the_exponential_up_to_the_method_s_order) {
  struct Order {
    char const* name;
    int order;
  };
  Complex const z(-0.02, 0.015);
  for (Order const& known : {Order{"explicit-euler", 1}, Order{"heun", 2}, Order{"classical-runge-kutta", 4},
                             Order{"runge-kutta", 5}}) {
    Complex series = 1.0, term = 1.0;
    for (int k = 1; k <= known.order; ++k) series += term *= z / static_cast<double>(k);
    double const next = std::abs(term * z);
    double const off = std::abs(amplification(method(known.name), z) - series);
    BOOST_TEST(off < next, known.name);
    // Nor is it of higher order: for k stages the polynomial ends, and Dormand & Prince's goes on with
    // z^6/600.
    if (known.order < 5) BOOST_TEST(off < 1e-15, known.name);
    if (known.order == 5) BOOST_TEST(off == std::pow(std::abs(z), 6) / 600.0, tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(stable_steps_along_the_axes_are_those_of_the_textbooks) {
  struct Limit {
    char const* name;
    double real;
  };
  // Where R(-x) = 1 or -1: roots of the polynomials 1 - x + x^2/2 - ... (Hairer & Wanner, Solving ODEs II,
  // IV.2).
  for (Limit const& known :
       {Limit{"explicit-euler", 2.0}, Limit{"heun", 2.0}, Limit{"classical-runge-kutta", 2.7852935634052817},
        Limit{"runge-kutta", 3.3065678926349876}}) {
    StableStep const step = stable_step(method(known.name), known_to({{-5.0, 0.0}, {-1.0, 0.0}, {0.0, 0.0}}));
    BOOST_TEST(step.theory.value() == known.real / 5.0, tolerance(1e-6));
  }
  StableStep const oscillating =
      stable_step(method("classical-runge-kutta"), known_to({{0.0, 3.0}, {0.0, -3.0}}));
  BOOST_TEST(oscillating.theory.value() == 2.0 * std::numbers::sqrt2 / 3.0, tolerance(1e-6));
  for (auto const& hopeless :
       {std::vector<Complex>{{0.0, 3.0}}, std::vector<Complex>{{-1.0, 0.0}, {0.1, 0.0}},
        // However slow it is beside the others.
        std::vector<Complex>{{-1e4, 0.0}, {0.1, 0.0}}, std::vector<Complex>{{-1e4, 0.0}, {0.0, 3.0}}}) {
    StableStep const none = stable_step(method("explicit-euler"), known_to(hopeless));
    BOOST_TEST(!none.theory.has_value());
    BOOST_TEST(none.remark.starts_with("no step is stable"));
  }
  BOOST_TEST(stable_step(method("heun"), known_to({{0.0, 0.0}})).remark.starts_with("any step is stable"));
  // What may be rounding is not growth, but what exceeds it is, however small.
  std::vector<Complex> const slow{{-1e4, 0.0}, {1e-7, 0.0}};
  BOOST_TEST(stable_step(method("heun"), known_to(slow, 2e-7)).theory.value() == 2e-4, tolerance(1e-6));
  BOOST_TEST(!stable_step(method("heun"), known_to(slow, 0.5e-7)).theory.has_value());
}

BOOST_AUTO_TEST_CASE(the_measured_step_is_that_of_theory) {
  Rod const rod{20};
  std::vector<double> const state(rod.n, 7.0);
  for (ButcherTable const& one : explicit_methods()) {
    double const theory = stable_step(one, known_to(rod.eigenvalues())).theory.value();
    for (double const guess : {theory, 0.3 * theory, 5.0 * theory}) {
      Number const measured = measured_stable_step(one, rod, state, 0.1, guess, never);
      BOOST_TEST_REQUIRE(measured.has_value());
      BOOST_TEST(*measured == theory, tolerance(0.005));
    }
  }
}

BOOST_AUTO_TEST_CASE(no_step_is_found_where_a_mode_grows_or_time_is_up) {
  auto const growing = [](double const* y, double* out) {
    out[0] = -y[0];
    out[1] = 0.5 * y[1];
  };
  ButcherTable const& euler = method("explicit-euler");
  BOOST_TEST(!measured_stable_step(euler, growing, {0.0, 0.0}, 1.0, 1.0, never).has_value());
  Rod const rod{20};
  BOOST_TEST(!measured_stable_step(euler, rod, std::vector<double>(20, 0.0), 1.0, 0.5, [] {
                return true;
              }).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
