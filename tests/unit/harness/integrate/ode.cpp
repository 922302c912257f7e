// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/integrate/ode.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>

BOOST_AUTO_TEST_SUITE(harness_integrate_ode)

using namespace sphverify;
using boost::test_tools::tolerance;
using Rate = ColouredJacobian::Rate;

enum class Method { bdf, runge_kutta, chebyshev, implicit_runge_kutta };
constexpr Method methods[] = {Method::bdf, Method::runge_kutta, Method::chebyshev,
                              Method::implicit_runge_kutta};

DependencyPattern full_pattern(std::size_t n) {
  DependencyPattern pattern{{0}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) pattern.column.push_back(static_cast<std::int64_t>(j));
    pattern.first.push_back(static_cast<std::int64_t>(pattern.column.size()));
  }
  return pattern;
}

OdeResult integrate(Method method, OdeSystem system, std::vector<double> y, double final_time,
                    double relative) {
  system.size = y.size();
  ColouredJacobian jacobian(full_pattern(y.size()), system.rate, false, 1.0);
  system.jacobian = &jacobian;
  Tolerances const tolerances{relative, relative};
  switch (method) {
    case Method::bdf:
      return integrate_bdf(system, std::move(y), final_time, tolerances);
    case Method::runge_kutta:
      return integrate_runge_kutta(system, std::move(y), final_time, tolerances);
    case Method::chebyshev:
      return integrate_chebyshev(system, std::move(y), final_time, tolerances);
    case Method::implicit_runge_kutta:
      break;
  }
  auto const steps = static_cast<std::uint64_t>(4.0 / std::cbrt(relative));
  return integrate_implicit_runge_kutta(system, std::move(y), final_time, steps,
                                        {1e-3 * relative, 1e-3 * relative});
}

OdeSystem with_rate(Rate rate) {
  OdeSystem system;
  system.rate = std::move(rate);
  return system;
}

/// Eigenvalues -1 and -1000; from (2, 0) it is e^-t + e^-1000t, e^-t - e^-1000t.
void stiff(double, double const* y, double* out) {
  out[0] = -500.5 * y[0] + 499.5 * y[1];
  out[1] = 499.5 * y[0] - 500.5 * y[1];
}

/// From 1 it is 1/(1 + t).
void hyperbola(double, double const* y, double* out) { out[0] = -y[0] * y[0]; }

/// From 0 it is sin t.
void forced(double t, double const*, double* out) { out[0] = std::cos(t); }

BOOST_AUTO_TEST_CASE(errors_come_down_with_the_tolerance_on_problems_of_known_solution) {
  struct Known {
    Rate rate;
    std::vector<double> start;
    double final_time;
    double solution;
  };
  for (Known const& known : {Known{stiff, {2.0, 0.0}, 1.0, std::exp(-1.0)},
                             Known{hyperbola, {1.0}, 3.0, 0.25}, Known{forced, {0.0}, 2.0, std::sin(2.0)}}) {
    for (Method const method : methods) {
      double before = INFINITY;
      std::uint64_t steps = 0;
      for (double const relative : {1e-4, 1e-7, 1e-10}) {
        OdeResult const result =
            integrate(method, with_rate(known.rate), known.start, known.final_time, relative);
        double const error = std::abs(result.y[0] - known.solution);
        // A method of order 2 takes many steps, whose errors add up.
        BOOST_TEST(error < (method == Method::chebyshev ? 1000.0 : 100.0) * relative);
        BOOST_TEST(error < 0.5 * before);
        BOOST_TEST((result.outcome == OdeOutcome::finished));
        BOOST_TEST(result.time == known.final_time);
        BOOST_TEST(result.y.size() == known.start.size());
        BOOST_TEST(result.steps > steps);
        BOOST_TEST(result.reason == "");
        before = error;
        steps = result.steps;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_stiff_system_costs_the_implicit_method_few_steps) {
  auto const steps = [](Method method) {
    return integrate(method, with_rate(stiff), {2.0, 0.0}, 10.0, 1e-6).steps;
  };
  BOOST_TEST(steps(Method::bdf) < 500u);
  BOOST_TEST(steps(Method::runge_kutta) > 2000u);
}

BOOST_AUTO_TEST_CASE(methods_of_fixed_and_stabilised_steps_are_of_their_order) {
  // y' = -y + t^2 from 1: y = t^2 - 2t + 2 - e^-t.
  OdeSystem system = with_rate([](double t, double const* y, double* out) { out[0] = t * t - y[0]; });
  system.size = 1;
  double const exact = 1.0 - std::exp(-1.0);
  auto const error = [&](std::uint64_t steps) {
    return std::abs(integrate_implicit_runge_kutta(system, {1.0}, 1.0, steps, {1e-12, 1e-12}).y[0] - exact);
  };
  BOOST_TEST(std::log2(error(20) / error(40)) == 3.0, tolerance(0.03));
}

BOOST_AUTO_TEST_CASE(the_stabilised_method_takes_few_rates_on_a_stiff_rod) {
  // Second differences of 200 points: explicit steps are bound to 2/4e4 of the slowest mode's time.
  constexpr std::size_t n = 200;
  std::uint64_t rates = 0;
  OdeSystem system = with_rate([&](double, double const* y, double* out) {
    ++rates;
    for (std::size_t i = 0; i < n; ++i)
      out[i] = 4e4 * ((i > 0 ? y[i - 1] : 0.0) - 2.0 * y[i] + (i + 1 < n ? y[i + 1] : 0.0));
  });
  system.size = n;
  std::vector<double> start(n);
  double const k = std::acos(-1.0) / (n + 1.0);
  for (std::size_t i = 0; i < n; ++i) start[i] = std::sin(k * static_cast<double>(i + 1));
  double const decay = 4e4 * 4.0 * std::pow(std::sin(0.5 * k), 2);
  OdeResult const result = integrate_chebyshev(system, start, 1.0 / decay, {1e-5, 1e-5});
  BOOST_TEST((result.outcome == OdeOutcome::finished));
  for (std::size_t i = 0; i < n; i += 13)
    BOOST_TEST(std::abs(result.y[i] - start[i] * std::exp(-1.0)) < 1e-4);
  std::uint64_t const stabilised = std::exchange(rates, 0);
  BOOST_TEST(
      (integrate_runge_kutta(system, start, 1.0 / decay, {1e-5, 1e-5}).outcome == OdeOutcome::finished));
  BOOST_TEST(10 * stabilised < rates);
}

BOOST_AUTO_TEST_CASE(quadratures_keep_a_linear_invariant) {
  for (Method const method : methods) {
    // Two bodies that exchange heat, of which the second loses some: what is lost is the quadrature.
    OdeSystem system;
    system.rate = [](double, double const* y, double* out) {
      out[0] = 40.0 * (y[1] - y[0]);
      out[1] = 40.0 * (y[0] - y[1]) - 0.7 * y[1];
    };
    system.quadratures = 2;
    system.quadrature = [](double t, double const* y, double* out) {
      out[0] = -0.7 * y[1];
      out[1] = t;
    };
    OdeResult const result = integrate(method, system, {3.0, 1.0}, 2.0, 1e-8);
    double const drift = result.y[0] + result.y[1] - 4.0 - result.quadratures[0];
    BOOST_TEST(std::abs(drift) <
               (method == Method::runge_kutta || method == Method::chebyshev ? 1e-13 : 1e-8));
    BOOST_TEST(result.quadratures[0] < -1.0);
    BOOST_TEST(result.quadratures[1] == 2.0, tolerance(1e-6));
    BOOST_TEST(result.quadratures.size() == 2u);
    BOOST_TEST(result.y.size() == 2u);
  }
}

BOOST_AUTO_TEST_CASE(quadratures_that_nobody_wants_are_not_evaluated) {
  for (Method const method : methods) {
    OdeSystem system = with_rate(forced);
    system.quadrature = [](double, double const*, double*) { throw std::logic_error("evaluated"); };
    BOOST_TEST(integrate(method, system, {0.0}, 1.0, 1e-6).quadratures.empty());
  }
}

BOOST_AUTO_TEST_CASE(the_monitor_sees_every_step_and_stops_the_run_with_its_reason) {
  for (Method const method : methods) {
    OdeSystem system = with_rate(forced);
    system.quadratures = 1;
    system.quadrature = [](double, double const*, double* out) { out[0] = 1.0; };
    std::uint64_t calls = 0;
    double last = 0.0;
    double last_quadrature = 0.0;
    system.monitor = [&](double t, double const*, double const* q) -> std::string {
      ++calls;
      BOOST_TEST(t > last);
      last = t;
      last_quadrature = q[0];
      return t > 1.0 ? "far enough" : "";
    };
    OdeResult const result = integrate(method, system, {0.0}, 5.0, 1e-6);
    BOOST_TEST((result.outcome == OdeOutcome::stopped));
    BOOST_TEST(result.reason == "far enough");
    BOOST_TEST(result.steps == calls);
    BOOST_TEST(result.time == last);
    BOOST_TEST((last > 1.0 && last < 5.0));
    BOOST_TEST(last_quadrature == last, tolerance(1e-6));
    BOOST_TEST(std::abs(result.y[0] - std::sin(last)) < 1e-4);
  }
}

struct Special : std::runtime_error {
  using std::runtime_error::runtime_error;
};

BOOST_AUTO_TEST_CASE(what_the_rate_the_quadrature_and_the_monitor_throw_comes_out_as_itself) {
  for (Method const method : methods) {
    OdeSystem system = with_rate([](double t, double const* y, double* out) {
      if (t > 0.3) throw Special("no rate here");
      out[0] = -y[0];
    });
    BOOST_CHECK_THROW(integrate(method, system, {1.0}, 1.0, 1e-6), Special);
    system.rate = forced;
    system.quadratures = 1;
    system.quadrature = [](double, double const*, double*) { throw Special("no quadrature here"); };
    BOOST_CHECK_THROW(integrate(method, system, {0.0}, 1.0, 1e-6), Special);
    system.quadratures = 0;
    system.monitor = [](double, double const*, double const*) -> std::string { throw Special("enough"); };
    BOOST_CHECK_THROW(integrate(method, system, {0.0}, 1.0, 1e-6), Special);
  }
}

BOOST_AUTO_TEST_CASE(a_rate_that_is_no_number_ends_the_run_and_says_of_which_unknown) {
  for (Method const method : methods) {
    OdeSystem system = with_rate([](double t, double const*, double* out) {
      out[0] = t < 0.5 ? 1.0 : std::numeric_limits<double>::quiet_NaN();
    });
    std::uint64_t steps = 0;
    system.monitor = [&](double, double const*, double const*) -> std::string {
      return ++steps > 100'000 ? "did not notice" : "";
    };
    OdeResult const result = integrate(method, system, {1.0}, 2.0, 1e-6);
    BOOST_TEST((result.outcome == OdeOutcome::not_finite));
    BOOST_TEST(result.not_finite == 0u);
    BOOST_TEST(!result.reason.empty());
    BOOST_TEST(result.time < 2.0);
  }
}

BOOST_AUTO_TEST_CASE(the_explicit_method_takes_steps_as_the_fifth_root_of_the_tolerance) {
  auto const steps = [](double relative) {
    return static_cast<double>(integrate(Method::runge_kutta, with_rate(hyperbola), {1.0}, 20.0, relative).steps);
  };
  double const root = 5.0 / std::log10(steps(1e-12) / steps(1e-7));
  BOOST_TEST((root > 4.5 && root < 6.0), root);
}

BOOST_AUTO_TEST_CASE(samples_of_the_explicit_method_are_as_good_as_its_steps_and_change_none) {
  OdeSystem system = with_rate([](double t, double const* y, double* out) { out[0] = -y[0] * y[0] + 0.1 * std::cos(t); });
  system.quadratures = 1;
  system.quadrature = [](double t, double const*, double* out) { out[0] = std::exp(-t); };
  OdeResult const without = integrate(Method::runge_kutta, system, {1.0}, 3.0, 1e-8);
  std::vector<double> times, values;
  for (int k = 0; k <= 60; ++k) system.sample_times.push_back(0.05 * k);
  system.sample = [&](double t, double const* y, double const* q) {
    times.push_back(t);
    values.push_back(y[0]);
    BOOST_TEST(std::abs(q[0] - (1.0 - std::exp(-t))) < 1e-7, t);
  };
  OdeResult const result = integrate(Method::runge_kutta, system, {1.0}, 3.0, 1e-8);
  BOOST_TEST(result.y[0] == without.y[0]);
  BOOST_TEST(result.steps == without.steps);
  BOOST_TEST(result.steps < 40u);  // most samples are within steps
  BOOST_TEST((times == system.sample_times));
  system.sample = {};
  for (std::size_t k = 1; k < times.size(); ++k) {
    double const exact = integrate(Method::runge_kutta, system, {1.0}, times[k], 1e-12).y[0];
    BOOST_TEST(std::abs(values[k] - exact) < 1e-7, times[k]);
  }
}

BOOST_AUTO_TEST_CASE(the_explicit_method_keeps_six_vectors_and_gives_the_same_bits_at_any_number_of_threads) {
  constexpr std::size_t n = 20'000;
  OdeSystem system = with_rate([](double t, double const* y, double* out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = std::sin(static_cast<double>(i)) - y[i] * y[n - 1 - i] + t;
  });
  system.size = n;
  OdeResult const one = integrate_runge_kutta(system, std::vector<double>(n, 0.5), 1.0, {1e-6, 1e-6});
  BOOST_TEST((one.outcome == OdeOutcome::finished));
  BOOST_TEST(one.bytes == 6 * n * sizeof(double));
  system.threads = 4;
  OdeResult const four = integrate_runge_kutta(system, std::vector<double>(n, 0.5), 1.0, {1e-6, 1e-6});
  BOOST_TEST((four.y == one.y));
  BOOST_TEST(four.steps == one.steps);
}

BOOST_AUTO_TEST_CASE(units_of_time_and_of_unknowns_change_no_step_of_the_explicit_method) {
  // Powers of two: all is the same to the last bit.
  auto const run = [](double time_unit, double unit) {
    OdeSystem system = with_rate([=](double t, double const* y, double* out) {
      double const u = y[0] * unit, s = t * time_unit;
      out[0] = (-u * u + std::cos(s)) * time_unit / unit;
    });
    system.scales = {1.0 / unit};
    OdeResult result = integrate(Method::runge_kutta, system, {1.0 / unit}, 3.0 / time_unit, 1e-7);
    result.y[0] *= unit;
    return result;
  };
  OdeResult const usual = run(1.0, 1.0);
  BOOST_TEST((usual.outcome == OdeOutcome::finished));
  for (double const one : {0x1p100, 0x1p-100})
    for (double const other : {0x1p100, 0x1p-100}) {
      OdeResult const scaled = run(one, other);
      BOOST_TEST(scaled.steps == usual.steps);
      BOOST_TEST(scaled.y[0] == usual.y[0]);
    }
}

BOOST_AUTO_TEST_CASE(unknowns_of_which_nothing_is_tolerated_end_no_run_that_leaves_them_alone) {
  OdeSystem system = with_rate([](double, double const* y, double* out) {
    out[0] = -y[0];
    out[1] = 0.0;
  });
  system.scales = {1.0, 0.0};
  OdeResult const result = integrate(Method::runge_kutta, system, {1.0, 0.0}, 1.0, 1e-6);
  BOOST_TEST((result.outcome == OdeOutcome::finished));
}

BOOST_AUTO_TEST_CASE(a_step_that_is_not_accepted_leaves_the_state_as_it_was) {
  // Where the rate turns on, steps are tried that are far too long; before it nothing has changed.
  OdeSystem system = with_rate([](double t, double const* y, double* out) { out[0] = t < 0.7 ? 0.0 : -1e3 * (y[0] - t); });
  std::uint64_t rates = 0;
  auto const inner = system.rate;
  system.rate = [&](double t, double const* y, double* out) {
    ++rates;
    inner(t, y, out);
  };
  system.monitor = [](double t, double const* y, double const*) -> std::string {
    return t < 0.7 && y[0] != 1.0 ? "it moved before it was pushed" : "";
  };
  OdeResult const result = integrate(Method::runge_kutta, system, {1.0}, 1.0, 1e-8);
  BOOST_TEST(result.reason == "");
  BOOST_TEST(result.y[0] == 1.0 - 1e-3, tolerance(1e-6));
  BOOST_TEST(rates > 6 * result.steps + 2);  // some were not accepted
}

/// From 0 it is 1e4 (t - 0.3) once t > 0.3: particles that come into a wall's reach feel such jumps.
void jumping(double t, double const*, double* out) { out[0] = t < 0.3 ? 0.0 : 1e4; }

BOOST_AUTO_TEST_CASE(a_rate_that_jumps_is_passed_however_short_the_step) {
  OdeSystem system = with_rate(jumping);
  system.smallest_step = 1e-4;
  system.monitor = [before = 0.0, shortest = 1.0](double t, double const*, double const*) mutable {
    shortest = std::min(shortest, t - before);
    before = t;
    return t < 1.0 || shortest < 1e-6 ? "" : "no step was short: the test shows nothing";
  };
  OdeResult const result = integrate(Method::runge_kutta, system, {0.0}, 1.0, 1e-7);
  BOOST_TEST(result.reason == "");
  BOOST_TEST((result.outcome == OdeOutcome::finished));
  BOOST_TEST(result.y[0] == 7e3, tolerance(1e-5));
  BOOST_TEST(result.steps < 100u);
}

BOOST_AUTO_TEST_CASE(many_jumps_close_together_are_passed_as_well) {
  OdeSystem system = with_rate([](double t, double const*, double* out) {
    double const count = std::floor(std::clamp((t - 0.3) / 1e-5, 0.0, 100.0));
    out[0] = 100.0 * count;
  });
  system.smallest_step = 1e-4;
  OdeResult const result = integrate(Method::runge_kutta, system, {0.0}, 1.0, 1e-7);
  BOOST_TEST(result.reason == "");
  BOOST_TEST(result.y[0] == 1e4 * (0.7 - 50.5 * 1e-5), tolerance(1e-5));
  BOOST_TEST(result.steps > 300u);
}

BOOST_AUTO_TEST_CASE(a_step_that_stays_below_the_smallest_has_collapsed) {
  OdeSystem system = with_rate([](double, double const* y, double* out) { out[0] = -1e6 * y[0]; });
  OdeResult result = integrate(Method::runge_kutta, system, {1.0}, 0.01, 1e-6);
  BOOST_TEST((result.outcome == OdeOutcome::finished));
  BOOST_TEST(result.steps > 1000u);
  system.smallest_step = 9e-6;
  result = integrate(Method::runge_kutta, system, {1.0}, 0.01, 1e-6);
  BOOST_TEST((result.outcome == OdeOutcome::failed));
  BOOST_TEST(result.reason.find("collapsed") != std::string::npos);
  BOOST_TEST(result.steps == 1000u);
}

BOOST_AUTO_TEST_SUITE_END()
