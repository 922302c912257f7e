// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/gas_stability.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "formulations/kernels/cubic_spline.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_gas_stability)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

constexpr int n = 24;
constexpr double ratio = 1.2;
constexpr double gamma_gas = 5.0 / 3.0;

Problem<1> gas_at_rest() {
  Case const* const one = find_case("hydro/uniform");
  Parameters parameters(one->info.parameters);
  parameters.set("boundary", std::string("periodic"));
  return std::get<Problem<1>>(one->problem(parameters));
}

SceneChoice choice_of(Discretisation discretisation, double smoothing_ratio) {
  discretisation.density = "continuity";
  discretisation.integrator = "leapfrog";
  return {.formulation = "momentum/p-rho2",
          .work = "work/internal-energy",
          .walls = true,
          .discretisation = discretisation,
          .resolution = n,
          .smoothing_ratio = smoothing_ratio,
          .threads = 1};
}

bool never() { return false; }

/// Frequency of a plane wave of displacement on a lattice at rest (density and pressure 1, m = dx), from the
/// discrete equations by hand: with S = sum sin(kr) W'(r) and Q = sum (1 - cos kr) W''(r) over the
/// neighbours,
///   omega^2 = m^2 S^2 (c^2 - 2 P/rho)/rho^2 + 2 m (P/rho^2) Q.
double frequency(double k) {
  double const dx = 1.0 / n;
  double const h = ratio * dx;
  auto const slope = [h](double r) { return CubicSpline<1>::radial(std::abs(r), h) * r; };
  double S = 0.0;
  double Q = 0.0;
  for (int j = -3; j <= 3; ++j) {
    if (j == 0) continue;
    double const r = j * dx;
    double const e = 1e-6 * dx;
    S += std::sin(k * r) * slope(r);
    Q += (1.0 - std::cos(k * r)) * (slope(r + e) - slope(r - e)) / (2.0 * e);
  }
  return std::sqrt(dx * dx * S * S * (gamma_gas - 2.0) + 2.0 * dx * Q);
}

BOOST_AUTO_TEST_CASE(waves_on_a_lattice_have_the_frequencies_of_the_discrete_equations) {
  Stability const found = gas_stability(gas_at_rest(), choice_of({}, ratio), true, false, never);
  // Density and energy that change together leave the rate as it is, and what moves a particle along is no
  // force: defective zeros. Rounding decides whether differences of the rate can tell them from growth; if so, nothing grows.
  if (found.growing_modes) {
    BOOST_TEST(*found.growing_modes == 0u);
    BOOST_TEST(std::abs(found.spectral_abscissa.value()) < found.abscissa_uncertainty.value());
  } else {
    BOOST_TEST(found.remark.starts_with("whether a mode grows is not known"), found.remark);
    BOOST_TEST((!found.spectral_abscissa && !found.abscissa_uncertainty && !found.worst_mode));
  }
  double fastest = 0.0;
  for (int waves = 1; waves <= n / 2; ++waves) {
    double const omega = frequency(2.0 * std::numbers::pi * waves);
    fastest = std::max(fastest, omega);
    bool const is_there = std::any_of(found.modes.begin(), found.modes.end(), [&](Mode const& mode) {
      return std::abs(mode.frequency - omega) < 1e-6 * omega && mode.wavelength &&
             std::abs(*mode.wavelength * waves / n - 1.0) < 1e-3;
    });
    BOOST_TEST(is_there, "no mode of " << waves << " waves with frequency " << omega);
  }
  BOOST_TEST(found.largest_imaginary.value() == fastest, tolerance(1e-6));
  BOOST_TEST(found.stable_steps.at("leapfrog").theory.value() == 2.0 / fastest, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(leapfrog_s_stable_step_is_found_by_experiment) {
  Stability const found = gas_stability(gas_at_rest(), choice_of({}, ratio), false, true, never);
  StableStep const& step = found.stable_steps.at("leapfrog");
  BOOST_TEST_REQUIRE(step.measured.has_value());
  BOOST_TEST(*step.measured == *step.theory, tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(no_count_stands_beside_an_uncertainty_as_large_as_the_radius) {
  for (char const* density : {"continuity", "summation", "normalised"}) {
    for (char const* form : {"momentum/p-rho2", "momentum/sqrt-p"}) {
      for (double const smoothing : {1.0, 1.2, 2.0}) {
        SceneChoice choice = choice_of({}, smoothing);
        choice.formulation = form;
        choice.work = find_scheme(form)->work_partner;
        choice.discretisation.density = density;
        choice.resolution = 16;
        Stability const s = gas_stability(gas_at_rest(), choice, false, false, never);
        BOOST_TEST(s.growing_modes.has_value() == s.spectral_abscissa.has_value());
        BOOST_TEST(s.growing_modes.has_value() == s.abscissa_uncertainty.has_value());
        if (s.growing_modes) BOOST_TEST(*s.abscissa_uncertainty < 0.1 * *s.spectral_radius);
        if (!s.growing_modes) BOOST_TEST(!s.remark.empty());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(wide_kernels_let_disordered_particles_pair) {
  Stability const found =
      gas_stability(gas_at_rest(), choice_of(jittered_by(0.2, 1), 2.0), false, false, never);
  BOOST_TEST(found.growing_modes.value() > 0u);
  BOOST_TEST(found.worst_mode->growth > 0.0);
  BOOST_TEST(found.worst_mode->wavelength.value() < 3.0);
  BOOST_TEST(!found.stable_steps.at("leapfrog").theory.has_value());
  BOOST_TEST(found.remark.find("does not stand still") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_is_too_large_or_takes_too_long_says_so) {
  SceneChoice large = choice_of({}, ratio);
  large.resolution = 400;
  BOOST_TEST(gas_stability(gas_at_rest(), large, false, false, never).remark.find("1600") !=
             std::string::npos);
  Stability const late =
      gas_stability(gas_at_rest(), choice_of({}, ratio), false, false, [] { return true; });
  BOOST_TEST(late.remark.find("time budget") != std::string::npos);
  BOOST_TEST(!late.spectral_abscissa.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
