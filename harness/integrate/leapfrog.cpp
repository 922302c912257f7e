// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "formulations/basics/parallel.hpp"
#include "harness/integrate/ode.hpp"

namespace sphverify {

namespace {

/// A step that is no longer than the limit, chosen so that the last one is not a sliver.
double even_step(double remaining, double limit) {
  return limit >= remaining ? remaining : remaining / std::ceil(remaining / limit);
}

}  // namespace

OdeResult integrate_leapfrog(OdeSystem const& system, std::vector<double> y, double final_time,
                             Stepping const& stepping) {
  std::size_t const n = system.size;
  std::size_t const coordinates = stepping.coordinates;
  std::size_t const others = 2 * coordinates;
  auto const for_each = [&](std::size_t count, auto const& row) {
    for_each_row(count, stepping.threads, row);
  };
  // The velocities with which all moves, that is those of a step's middle; accelerations; rates of the others
  // at its end.
  std::vector<double> rates(n);
  // Rates of the others at its beginning.
  std::vector<double> first(n - others);
  std::vector<double> first_flow(system.quadratures), second_flow(system.quadratures);
  std::vector<double> impulse(stepping.impulses);
  OdeResult result;
  result.quadratures.assign(system.quadratures, 0.0);
  result.bytes = sizeof(double) * (y.size() + rates.size() + first.size());
  double* const middle = rates.data();
  double const* const acceleration = rates.data() + coordinates;
  double const* const second = rates.data() + others;
  double* const place = y.data();
  double* const velocity = y.data() + coordinates;
  double* const other = y.data() + others;

  auto const flows = [&](double t, std::vector<double>& dqdt) {
    if (system.quadratures > 0) system.quadrature(t, y.data(), dqdt.data());
  };
  auto const end = [&](OdeOutcome outcome, std::string reason) {
    result.outcome = outcome;
    result.reason = std::move(reason);
  };

  for_each(coordinates, [&](std::size_t k) { middle[k] = velocity[k]; });
  stepping.rate(0.0, y.data(), rates.data());
  flows(0.0, second_flow);
  while (result.time < final_time) {
    if (auto const component =
            first_row(n, stepping.threads, [&](std::size_t k) { return !std::isfinite(rates[k]); })) {
      end(OdeOutcome::not_finite, "the leapfrog met a rate that is not finite");
      result.not_finite = *component;
      break;
    }
    double const limit = stepping.largest_step(result.time);
    if (!(limit > stepping.smallest_step)) {
      end(OdeOutcome::failed, fmt::format("the step collapsed to {:.3g}", limit));
      break;
    }
    if (result.steps == stepping.most_steps) {
      end(OdeOutcome::out_of_steps, fmt::format("{} steps were not enough", stepping.most_steps));
      break;
    }
    double const dt = even_step(final_time - result.time, limit);
    double const time = dt >= final_time - result.time ? final_time : result.time + dt;
    std::copy_n(second_flow.begin(), stepping.impulses, impulse.begin());

    // Kick: to the velocities of the middle, by the acceleration at the end of the last step.
    for_each(coordinates, [&](std::size_t k) { middle[k] = velocity[k] + 0.5 * dt * acceleration[k]; });
    // Drift: places, and with them whatever else moves. Velocities and others are predicted.
    stepping.drift(result.time, y.data(), middle, first.data());
    flows(result.time, first_flow);
    for_each(coordinates, [&](std::size_t k) {
      place[k] += dt * middle[k];
      velocity[k] = middle[k] + 0.5 * dt * acceleration[k];
    });
    for_each(n - others, [&](std::size_t k) { other[k] += dt * first[k]; });
    stepping.rate(time, y.data(), rates.data());
    flows(time, second_flow);
    for_each(n - others, [&](std::size_t k) { other[k] += 0.5 * dt * (second[k] - first[k]); });
    // Kick.
    for_each(coordinates, [&](std::size_t k) { velocity[k] = middle[k] + 0.5 * dt * acceleration[k]; });
    for (std::size_t k = 0; k < system.quadratures; ++k) {
      double const before = k < stepping.impulses ? impulse[k] : first_flow[k];
      result.quadratures[k] += 0.5 * dt * (before + second_flow[k]);
    }
    result.time = time;
    ++result.steps;
    result.reason = system.monitor ? system.monitor(time, y.data(), result.quadratures.data()) : "";
    if (!result.reason.empty()) {
      result.outcome = OdeOutcome::stopped;
      break;
    }
  }
  result.y = std::move(y);
  return result;
}

}  // namespace sphverify
