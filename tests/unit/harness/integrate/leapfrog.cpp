// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "harness/integrate/ode.hpp"

BOOST_AUTO_TEST_SUITE(harness_integrate_leapfrog)

using namespace sphverify;
using boost::test_tools::tolerance;
using State = std::vector<double>;

/// Rate at a state, with other velocities for what moves than the state's own.
using Rate = std::function<void(double t, double const* y, double const* velocities, double* out)>;

struct Method {
  Rate rate;
  Rate drift = {};  ///< empty: the rate
  std::size_t coordinates = 1;
  double step = 0.1;
  std::function<double(double t)> largest_step = {};  ///< empty: always `step`
  std::uint64_t most_steps = 1'000'000;
  std::size_t impulses = 0;
  OdeSystem system = {};
};

OdeResult integrate(Method const& method, State y, double final_time) {
  OdeSystem system = method.system;
  system.size = y.size();
  std::vector<double> all(y.size());
  Stepping const stepping{
      .coordinates = method.coordinates,
      .impulses = method.impulses,
      .rate = [&](double t, double const* at, double* dydt) { method.rate(t, at, dydt, dydt); },
      .drift =
          [&](double t, double const* at, double const* velocities, double* rates) {
            method.drift ? method.drift(t, at, velocities, all.data()) : method.rate(t, at, velocities, all.data());
            std::copy(all.begin() + static_cast<std::ptrdiff_t>(2 * method.coordinates), all.end(), rates);
          },
      .largest_step = method.largest_step ? method.largest_step : [&](double) { return method.step; },
      .smallest_step = 1e-9,
      .most_steps = method.most_steps};
  return integrate_leapfrog(system, std::move(y), final_time, stepping);
}

/// x'' = -x.
void oscillator(double, double const* y, double const* velocities, double* out) {
  out[0] = velocities[0];
  out[1] = -y[0];
}

/// The same with a force that follows not the place but what drifts along with it: x'' = -r, r' = v.
/// So a pressure follows a density.
void oscillator_that_follows(double, double const* y, double const* velocities, double* out) {
  out[0] = velocities[0];
  out[1] = -y[2];
  out[2] = velocities[0];
}

/// A force that follows r, r' = v (1 + 0.3 x); friction, and the heat of it.
void rubbing(double t, double const* y, double const* velocities, double* out) {
  out[0] = velocities[0];
  out[1] = -y[2] - 0.2 * y[1] + 0.1 * std::cos(t);
  out[2] = velocities[0] * (1.0 + 0.3 * y[0]);
  out[3] = 0.2 * y[1] * y[1];
}

/// x'' = -x^3.
void anharmonic(double, double const* y, double const* velocities, double* out) {
  out[0] = velocities[0];
  out[1] = -y[0] * y[0] * y[0];
}

double largest_difference(State const& a, State const& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

BOOST_AUTO_TEST_CASE(a_harmonic_oscillator_is_integrated_to_second_order) {
  for (auto const& [rate, start] : {std::pair<Rate, State>{oscillator, {1.0, 0.5}},
                                    std::pair<Rate, State>{oscillator_that_follows, {1.0, 0.5, 1.0}}}) {
    double before = 0.0;
    for (double const step : {0.1, 0.05, 0.025}) {
      OdeResult const result = integrate({.rate = rate, .step = step}, start, 7.0);
      double const error = std::hypot(result.y[0] - (std::cos(7.0) + 0.5 * std::sin(7.0)),
                                      result.y[1] - (0.5 * std::cos(7.0) - std::sin(7.0)));
      if (before > 0.0) BOOST_TEST(before / error == 4.0, tolerance(0.05));
      before = error;
    }
    BOOST_TEST(before < 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(forces_that_depend_on_velocity_and_unknowns_that_drift_unevenly_are_of_second_order) {
  State const start{0.7, 0.2, 0.7, 1.0};
  OdeSystem system;
  system.size = start.size();
  system.rate = [](double t, double const* y, double* out) { rubbing(t, y, y + 1, out); };
  State const exact = integrate_runge_kutta(system, start, 5.0, {1e-12, 1e-12}).y;
  State before;
  for (double const step : {0.02, 0.01, 0.005}) {
    State const y = integrate({.rate = rubbing, .step = step}, start, 5.0).y;
    for (std::size_t k = 0; k < before.size(); ++k) {
      double const ratio = std::abs(before[k] - exact[k]) / std::abs(y[k] - exact[k]);
      BOOST_TEST((ratio > 3.5 && ratio < 4.5), "unknown " << k << " comes down by " << ratio);
    }
    before = y;
  }
}

// What leapfrog keeps of an oscillator is v^2 + (1 - (omega dt/2)^2) x^2, so that the amplitude is bounded
// for ever. If r drifts with the velocity of the step's beginning, it grows instead.
BOOST_AUTO_TEST_CASE(the_amplitude_of_a_coarsely_stepped_oscillator_neither_grows_nor_decays) {
  double const step = 0.65;
  double const final_time = 1e4 * step;
  for (auto const& [rate, start] : {std::pair<Rate, State>{oscillator, {1.0, 0.0}},
                                    std::pair<Rate, State>{oscillator_that_follows, {1.0, 0.0, 1.0}}}) {
    // A little longer, lest round-off asks for one step more on the way.
    Method method{.rate = rate, .step = step * (1.0 + 1e-9)};
    double worst = 0.0;
    double largest_before = 0.0, largest_after = 0.0;
    double const kept = 1.0 - 0.25 * step * step;
    method.system.monitor = [&, &start = start](double t, double const* y, double const*) -> std::string {
      double const force = start.size() == 3 ? y[2] : y[0];
      worst = std::max(worst, std::abs(y[1] * y[1] + kept * force * force - kept));
      double& largest = t < 0.5 * final_time ? largest_before : largest_after;
      largest = std::max(largest, std::abs(y[0]));
      return "";
    };
    OdeResult const result = integrate(method, start, final_time);
    BOOST_TEST(result.steps == 10'000u);
    BOOST_TEST(worst < 1e-10);
    BOOST_TEST(largest_before == 1.0, tolerance(1e-3));
    BOOST_TEST(largest_after == 1.0, tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(what_drifts_evenly_with_a_place_stays_with_it) {
  State const y = integrate({.rate = oscillator_that_follows, .step = 0.65}, {1.0, 0.3, 1.0}, 650.0).y;
  BOOST_TEST(std::abs(y[0] - y[2]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(the_same_steps_with_the_velocities_turned_round_lead_back_to_the_start) {
  for (auto const& [rate, start] : {std::pair<Rate, State>{anharmonic, {1.0, 0.4}},
                                    std::pair<Rate, State>{oscillator_that_follows, {1.0, 0.4, 1.0}}}) {
    Method const method{.rate = rate, .step = 0.3001};
    State there = integrate(method, start, 60.0).y;
    BOOST_TEST(largest_difference(there, start) > 0.1);
    there[1] = -there[1];
    State back = integrate(method, there, 60.0).y;
    back[1] = -back[1];
    BOOST_TEST(largest_difference(back, start) < 1e-11);
  }
}

// Two bodies that pull at each other and rub, one of them also pulled and braked from outside; steps of
// uneven length.
struct Bodies {
  State last = State(7);  ///< the last rate

  void rate(double t, double const* y, double const* velocities, double* out) {
    double const pull = std::pow(y[1] - y[0], 3) + 0.3 * (y[3] - y[2]);
    out[0] = velocities[0];
    out[1] = velocities[1];
    out[2] = pull + std::sin(3.0 * t) - 0.4 * y[2];
    out[3] = -pull;
    // Heat flows between the first two of what follows, and the second loses some.
    out[4] = 5.0 * (y[5] - y[4]) + velocities[0];
    out[5] = 5.0 * (y[4] - y[5]) - velocities[0] - 0.7 * y[5];
    out[6] = y[2] * y[2];
    last.assign(out, out + 7);
  }
};

BOOST_AUTO_TEST_CASE(momentum_and_what_is_linear_in_the_rest_close_against_their_quadratures) {
  Bodies bodies;
  Method method;
  method.coordinates = 2;
  method.impulses = 1;
  method.rate = [&](double t, double const* y, double const* velocities, double* out) {
    bodies.rate(t, y, velocities, out);
  };
  method.largest_step = [](double t) { return 0.01 + 0.005 * std::sin(17.0 * t); };
  method.system.quadratures = 2;
  method.system.quadrature = [&](double, double const*, double* out) {
    out[0] = bodies.last[2] + bodies.last[3];
    out[1] = bodies.last[4] + bodies.last[5];
  };
  State const start{0.0, 1.0, 0.3, -0.2, 2.0, 1.0, 0.0};
  double worst_momentum = 0.0, worst_heat = 0.0;
  method.system.monitor = [&](double, double const* y, double const* q) -> std::string {
    worst_momentum = std::max(worst_momentum, std::abs(y[2] + y[3] - 0.1 - q[0]));
    worst_heat = std::max(worst_heat, std::abs(y[4] + y[5] - 3.0 - q[1]));
    return "";
  };
  OdeResult const result = integrate(method, start, 4.0);
  BOOST_TEST(result.steps > 300u);
  BOOST_TEST(worst_momentum < 1e-14);
  BOOST_TEST(worst_heat < 1e-13);
  BOOST_TEST(std::abs(result.quadratures[0]) > 0.01);
  BOOST_TEST(result.quadratures[1] < -1.0);
}

BOOST_AUTO_TEST_CASE(a_quadrature_is_asked_for_right_after_the_rate_at_the_same_state) {
  Method method{.rate = {}, .step = 0.1};
  double time = -1.0;
  State state;
  method.rate = [&](double t, double const* y, double const* velocities, double* out) {
    time = t;
    state.assign(y, y + 3);
    oscillator_that_follows(t, y, velocities, out);
  };
  method.system.quadratures = 1;
  int asked = 0;
  method.system.quadrature = [&](double t, double const* y, double* out) {
    ++asked;
    BOOST_TEST(t == time);
    BOOST_TEST((State(y, y + 3) == state));
    out[0] = 1.0;
    time = -1.0;
  };
  method.largest_step = [&](double) {
    BOOST_TEST(time == -1.0);  // the quadrature has been asked for
    return 0.1;
  };
  OdeResult const result = integrate(method, {1.0, 0.0, 1.0}, 1.0);
  BOOST_TEST(asked >= 20);
  BOOST_TEST(result.quadratures[0] == 1.0, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(quadratures_that_nobody_wants_are_not_evaluated) {
  Method method{.rate = oscillator};
  method.system.quadrature = [](double, double const*, double*) { throw std::logic_error("evaluated"); };
  BOOST_TEST(integrate(method, {1.0, 0.0}, 1.0).quadratures.empty());
}

BOOST_AUTO_TEST_CASE(the_final_time_is_hit_exactly_by_even_steps_within_the_limit) {
  for (double const final_time : {1.0, 0.7, 1.0 / 3.0, 12.3}) {
    Method method{.rate = oscillator, .step = 0.3};
    std::vector<double> steps;
    double before = 0.0;
    method.system.monitor = [&](double t, double const*, double const*) -> std::string {
      steps.push_back(t - before);
      before = t;
      return "";
    };
    OdeResult const result = integrate(method, {1.0, 0.0}, final_time);
    BOOST_TEST((result.outcome == OdeOutcome::finished));
    BOOST_TEST(result.reason == "");
    BOOST_TEST(result.time == final_time);
    BOOST_TEST(before == final_time);
    BOOST_TEST(result.steps == static_cast<std::uint64_t>(std::ceil(final_time / 0.3)));
    BOOST_TEST(result.steps == steps.size());
    for (double const step : steps)
      BOOST_TEST(step == final_time / static_cast<double>(steps.size()), tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(a_limit_longer_than_the_run_makes_one_step) {
  OdeResult const result = integrate({.rate = oscillator, .step = 5.0}, {1.0, 0.0}, 0.2);
  BOOST_TEST(result.steps == 1u);
  BOOST_TEST(result.y[0] == 1.0 - 0.5 * 0.2 * 0.2, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(one_rate_and_one_drift_a_step_and_one_rate_to_begin_with) {
  Method method{.rate = {}, .step = 0.1};
  std::uint64_t rates = 0, drifts = 0;
  method.rate = [&](double t, double const* y, double const* velocities, double* out) {
    ++rates;
    oscillator_that_follows(t, y, velocities, out);
  };
  method.drift = [&](double t, double const* y, double const* velocities, double* out) {
    ++drifts;
    oscillator_that_follows(t, y, velocities, out);
  };
  OdeResult const result = integrate(method, {1.0, 0.0, 1.0}, 2.0);
  BOOST_TEST(rates == result.steps + 1);
  BOOST_TEST(drifts == result.steps);
}

BOOST_AUTO_TEST_CASE(a_step_that_collapses_ends_the_run_with_its_reason_and_its_time) {
  for (double const collapsed : {1e-12, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Method method{.rate = oscillator};
    method.largest_step = [=](double t) { return t > 0.5 ? collapsed : 0.1; };
    OdeResult const result = integrate(method, {1.0, 0.0}, 1.0);
    BOOST_TEST((result.outcome == OdeOutcome::failed));
    BOOST_TEST(result.reason.find("the step collapsed to ") == 0u, result.reason);
    BOOST_TEST((result.time > 0.5 && result.time < 0.65));
    BOOST_TEST(std::abs(result.y[0] - std::cos(result.time)) < 1e-2);
  }
  Method method{.rate = oscillator, .step = 1e-12};
  BOOST_TEST(integrate(method, {1.0, 0.0}, 1.0).reason == "the step collapsed to 1e-12");
}

BOOST_AUTO_TEST_CASE(too_many_steps_end_the_run_and_just_enough_do_not) {
  OdeResult const few = integrate({.rate = oscillator, .step = 0.1, .most_steps = 9}, {1.0, 0.0}, 0.95);
  BOOST_TEST((few.outcome == OdeOutcome::out_of_steps));
  BOOST_TEST(few.reason == "9 steps were not enough");
  BOOST_TEST(few.steps == 9u);
  BOOST_TEST(few.time == 0.95 * 0.9, tolerance(1e-12));
  OdeResult const enough = integrate({.rate = oscillator, .step = 0.1, .most_steps = 10}, {1.0, 0.0}, 0.95);
  BOOST_TEST((enough.outcome == OdeOutcome::finished));
  BOOST_TEST(enough.steps == 10u);
}

BOOST_AUTO_TEST_CASE(the_monitor_sees_every_step_and_stops_the_run_with_its_reason) {
  Method method{.rate = oscillator, .step = 0.1, .impulses = 1};
  method.system.quadratures = 1;
  method.system.quadrature = [](double, double const*, double* out) { out[0] = 2.0; };
  std::uint64_t calls = 0;
  double last = 0.0;
  method.system.monitor = [&](double t, double const* y, double const* q) -> std::string {
    ++calls;
    BOOST_TEST(t > last);
    BOOST_TEST(q[0] == 2.0 * t, tolerance(1e-13));
    BOOST_TEST(std::abs(y[0] - std::cos(t)) < 1e-2);
    last = t;
    return t > 1.0 ? "far enough" : "";
  };
  OdeResult const result = integrate(method, {1.0, 0.0}, 5.0);
  BOOST_TEST((result.outcome == OdeOutcome::stopped));
  BOOST_TEST(result.reason == "far enough");
  BOOST_TEST(result.steps == calls);
  BOOST_TEST(result.time == last);
  BOOST_TEST(last < 1.2);
  method.system.monitor = [](double, double const*, double const*) -> std::string {
    throw std::domain_error("enough");
  };
  BOOST_CHECK_THROW(integrate(method, {1.0, 0.0}, 5.0), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
