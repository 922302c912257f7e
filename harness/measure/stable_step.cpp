// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace sphverify {

std::vector<ButcherTable> const& explicit_methods() {
  static std::vector<ButcherTable> const methods{
      {"explicit-euler", {{}}, {1.0}},
      {"heun", {{}, {1.0}}, {0.5, 0.5}},
      {"classical-runge-kutta",
       {{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}},
       {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}},
      {"runge-kutta",
       {{},
        {1.0 / 5},
        {3.0 / 40, 9.0 / 40},
        {44.0 / 45, -56.0 / 15, 32.0 / 9},
        {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
        {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}},
       {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}}};
  return methods;
}

namespace {

/// One step for any kind of state: state + sum of weighted rates.
template <class State, class Rate, class Combine>
State step(ButcherTable const& method, State const& y, Rate const& rate, Combine const& combine) {
  std::vector<State> rates;
  for (auto const& row : method.rows) rates.push_back(rate(combine(y, row, rates)));
  return combine(y, method.weights, rates);
}

}  // namespace

std::complex<double> amplification(ButcherTable const& method, std::complex<double> z) {
  using Complex = std::complex<double>;
  return step(
      method, Complex(1.0), [&](Complex y) { return z * y; },
      [](Complex y, std::vector<double> const& weights, std::vector<Complex> const& rates) {
        for (std::size_t s = 0; s < weights.size(); ++s) y += weights[s] * rates[s];
        return y;
      });
}

StableStep stable_step(ButcherTable const& method, Spectrum const& spectrum) {
  constexpr double round_off = 1e-13;  // of R
  constexpr double stride = 0.01;      // in |lambda| dt
  constexpr double farthest = 20.0;    // no method of these is stable beyond
  double radius = 0.0;
  for (auto const& lambda : spectrum.eigenvalues) radius = std::max(radius, std::abs(lambda));
  StableStep result;
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < spectrum.eigenvalues.size(); ++k) {
    auto const& lambda = spectrum.eigenvalues[k];
    double const size = std::abs(lambda);
    if (size <= spectrum.uncertainty[k]) {
      // Does not move, as far as is known; of a fast mode that would be too little.
      if (size > slow_part * radius)
        return {.theory = {}, .measured = {}, .remark = "a fast mode is not known well enough"};
      continue;
    }
    auto const holds = [&](double z) {
      // For small z what lambda is off moves |R| by as much times the step.
      return std::abs(amplification(method, lambda / size * z)) <=
             1.0 + round_off + spectrum.uncertainty[k] * z / size;
    };
    // A slow mode is looked at too: however short the steps, what grows by itself grows.
    double const end = std::min(farthest, longest * size);
    double low = 0.0;
    double high = std::min(stride, end);
    while (high < end && holds(high)) {
      low = high;
      high = std::min(high + stride, end);
    }
    if (holds(high)) continue;
    for (int halving = 0; halving < 40; ++halving) {
      double const middle = 0.5 * (low + high);
      (holds(middle) ? low : high) = middle;
    }
    // An undamped oscillation that only the allowance for rounding lets pass has no stable step.
    bool const holds_truly = std::abs(amplification(method, lambda / size * (0.5 * low))) <= 1.0;
    longest = holds_truly ? low / size : 0.0;
  }
  if (!std::isfinite(longest)) {
    result.remark = "any step is stable: no mode moves";
  } else if (longest * radius < 1e-3) {
    result.remark = "no step is stable: a mode grows, or oscillates without damping";
  } else {
    result.theory = longest;
  }
  return result;
}

Number measured_stable_step(ButcherTable const& method,
                            std::function<void(double const* y, double* dydt)> const& rate,
                            std::vector<double> const& state, double amplitude, double guess,
                            std::function<bool()> const& out_of_time) {
  constexpr int steps = 3000;
  constexpr double unstable_growth = 1e6;
  constexpr int farthest = 3;  // doublings away from the guess
  using State = std::vector<double>;
  std::size_t const n = state.size();
  State origin(n);
  rate(state.data(), origin.data());
  State shifted(n);
  // Of the perturbation alone: the rate of the state itself is not to move it.
  auto const rate_of = [&](State const& y) {
    State out(n);
    for (std::size_t i = 0; i < n; ++i) shifted[i] = state[i] + y[i];
    rate(shifted.data(), out.data());
    for (std::size_t i = 0; i < n; ++i) out[i] -= origin[i];
    return out;
  };
  bool gave_up = false;
  auto const is_stable = [&](double dt) {
    auto const combine = [&](State y, std::vector<double> const& weights, std::vector<State> const& rates) {
      for (std::size_t s = 0; s < weights.size(); ++s) {
        if (weights[s] == 0.0) continue;
        for (std::size_t i = 0; i < n; ++i) y[i] += dt * weights[s] * rates[s][i];
      }
      return y;
    };
    std::mt19937_64 random(1);
    State y(n);
    for (double& value : y) value = amplitude * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
    double growth = 0.0;  // logarithm
    for (int k = 0; k < steps; ++k) {
      if (out_of_time()) {
        gave_up = true;
        return true;
      }
      y = step(method, y, rate_of, combine);
      double largest = 0.0;
      for (double const value : y) {
        if (!std::isfinite(value)) return false;
        largest = std::max(largest, std::abs(value));
      }
      if (largest == 0.0) return true;
      // Kept at its first size: what decays would drown in rounding, and what grows leave the linear range.
      growth += std::log(largest / amplitude);
      for (double& value : y) value *= amplitude / largest;
      if (growth > std::log(unstable_growth)) return false;
    }
    return true;
  };

  double low = guess;
  double high = guess;
  for (int k = 0; k < farthest && !is_stable(low) && !gave_up; ++k) low *= 0.5;
  if (low == guess) {
    for (int k = 0; k < farthest && is_stable(high *= 2.0) && !gave_up; ++k) low = high;
  } else {
    high = 2.0 * low;
  }
  bool const bracketed = is_stable(low) && !is_stable(high);
  while (bracketed && !gave_up && high > 1.002 * low) {
    double const middle = 0.5 * (low + high);
    (is_stable(middle) ? low : high) = middle;
  }
  if (!bracketed || gave_up) return std::nullopt;
  return low;
}

}  // namespace sphverify
