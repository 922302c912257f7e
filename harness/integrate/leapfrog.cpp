#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "formulations/basics/finite.hpp"
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
  // Rates at the beginning and at the end of a step, both with the velocities of its middle.
  std::vector<double> first(n), second(n), predicted(n), middle(coordinates);
  std::vector<double> first_flow(system.quadratures), second_flow(system.quadratures);
  std::vector<double> impulse(stepping.impulses);
  OdeResult result;
  result.quadratures.assign(system.quadratures, 0.0);

  auto const evaluate = [&](double t, std::vector<double> const& state, std::vector<double>& dydt,
                            std::vector<double>& dqdt) {
    stepping.rate(t, state.data(), middle.data(), dydt.data());
    if (system.quadratures > 0) system.quadrature(t, state.data(), dqdt.data());
  };
  auto const end = [&](OdeOutcome outcome, std::string reason) {
    result.outcome = outcome;
    result.reason = std::move(reason);
  };

  std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(coordinates), coordinates, middle.begin());
  evaluate(0.0, y, second, second_flow);
  while (result.time < final_time) {
    if (auto const component = first_not_finite(second)) {
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
    for (std::size_t k = 0; k < coordinates; ++k) {
      double const acceleration = second[coordinates + k];
      middle[k] = y[coordinates + k] + 0.5 * dt * acceleration;
      predicted[coordinates + k] = y[coordinates + k] + dt * acceleration;
    }
    // Drift: places, and with them whatever else moves.
    evaluate(result.time, y, first, first_flow);
    for (std::size_t k = 0; k < coordinates; ++k) predicted[k] = y[k] + dt * middle[k];
    for (std::size_t k = others; k < n; ++k) predicted[k] = y[k] + dt * first[k];
    evaluate(time, predicted, second, second_flow);
    for (std::size_t k = others; k < n; ++k) y[k] += 0.5 * dt * (first[k] + second[k]);
    // Kick.
    for (std::size_t k = 0; k < coordinates; ++k) {
      y[k] = predicted[k];
      y[coordinates + k] = middle[k] + 0.5 * dt * second[coordinates + k];
    }
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
