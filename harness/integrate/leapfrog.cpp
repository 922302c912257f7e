#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/integrate/ode.hpp"

namespace sphverify {

namespace {

/// A step that is no longer than the limit, chosen so that the last one is not a sliver.
double even_step(double remaining, double limit) { return remaining / std::ceil(remaining / limit); }

}  // namespace

OdeResult integrate_leapfrog(OdeSystem const& system, std::vector<double> y, double final_time,
                             Stepping const& stepping) {
  std::size_t const n = system.size;
  std::size_t const coordinates = stepping.coordinates;
  std::vector<double> rate(n), new_rate(n), predicted(n);
  std::vector<double> flow(system.quadratures), new_flow(system.quadratures);
  OdeResult result;
  result.quadratures.assign(system.quadratures, 0.0);

  auto const evaluate = [&](double t, double const* state, std::vector<double>& dydt,
                            std::vector<double>& dqdt) {
    system.rate(t, state, dydt.data());
    if (system.quadratures > 0) system.quadrature(t, state, dqdt.data());
  };
  auto const fail = [&](std::string reason) {
    result.outcome = OdeOutcome::failed;
    result.reason = std::move(reason);
  };

  evaluate(0.0, y.data(), rate, flow);
  while (result.time < final_time) {
    double const limit = stepping.largest_step(result.time);
    if (!(limit > stepping.smallest_step)) {
      fail(fmt::format("the step collapsed to {:.3g}", limit));
      break;
    }
    if (result.steps == stepping.most_steps) {
      fail(fmt::format("{} steps were not enough", stepping.most_steps));
      break;
    }
    double const dt = even_step(final_time - result.time, limit);
    // Kick and drift the coordinates: x + dt v + dt^2/2 a. Everything else is predicted by its old rate.
    for (std::size_t k = 0; k < n; ++k) predicted[k] = y[k] + dt * rate[k];
    for (std::size_t k = 0; k < coordinates; ++k) predicted[k] += 0.5 * dt * dt * rate[coordinates + k];
    double const time = dt >= final_time - result.time ? final_time : result.time + dt;
    evaluate(time, predicted.data(), new_rate, new_flow);
    // The second kick makes of the prediction the mean of the old and the new rate.
    for (std::size_t k = 0; k < coordinates; ++k) y[k] = predicted[k];
    for (std::size_t k = coordinates; k < n; ++k) y[k] += 0.5 * dt * (rate[k] + new_rate[k]);
    for (std::size_t k = 0; k < system.quadratures; ++k) {
      result.quadratures[k] += 0.5 * dt * (flow[k] + new_flow[k]);
    }
    std::swap(rate, new_rate);
    std::swap(flow, new_flow);
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
