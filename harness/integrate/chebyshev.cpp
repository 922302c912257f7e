// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <random>

#include "formulations/basics/finite.hpp"
#include "harness/integrate/ode.hpp"
#include "harness/integrate/samples.hpp"

namespace sphverify {

namespace {

/// Coefficients of the stages for a number of stages s >= 2 (Sommeijer, Shampine & Verwer, J. Comput. Appl.
/// Math. 88 (1998) 315): stage j is the polynomial P_j(z) = a_j + b_j T_j(w0 + w1 z) with P_j(0) = 1, P_j' =
/// c_j and P_j'' = c_j^2 for j >= 2, by Chebyshev's recursion.
struct Stages {
  explicit Stages(int s) {
    constexpr double damping = 2.0 / 13.0;
    double const w0 = 1.0 + damping / (static_cast<double>(s) * s);
    auto const count = static_cast<std::size_t>(s) + 1;
    // Chebyshev's polynomials at w0 and their derivatives.
    std::vector<double> T(count), dT(count), d2T(count), b(count), a(count);
    T[0] = 1.0;
    T[1] = w0;
    dT[1] = 1.0;
    for (std::size_t j = 2; j < count; ++j) {
      T[j] = 2.0 * w0 * T[j - 1] - T[j - 2];
      dT[j] = 2.0 * T[j - 1] + 2.0 * w0 * dT[j - 1] - dT[j - 2];
      d2T[j] = 4.0 * dT[j - 1] + 2.0 * w0 * d2T[j - 1] - d2T[j - 2];
    }
    double const w1 = dT.back() / d2T.back();
    for (std::size_t j = 2; j < count; ++j) b[j] = d2T[j] / (dT[j] * dT[j]);
    b[0] = b[1] = b[2];
    for (std::size_t j = 0; j < count; ++j) a[j] = 1.0 - b[j] * T[j];
    for (auto* const list : {&mu, &nu, &mu_rate, &gamma_rate, &c}) list->resize(count);
    mu_rate[1] = c[1] = b[1] * w1;
    for (std::size_t j = 2; j < count; ++j) {
      mu[j] = 2.0 * b[j] * w0 / b[j - 1];
      nu[j] = -b[j] / b[j - 2];
      mu_rate[j] = 2.0 * b[j] * w1 / b[j - 1];
      gamma_rate[j] = -a[j - 1] * mu_rate[j];
      c[j] = w1 * d2T[j] / dT[j];
    }
  }

  std::vector<double> mu, nu, mu_rate, gamma_rate, c;
};

/// Fewest stages that are stable at a step, from beta(s) > 0.65 (s^2 - 1).
int stages_for(double dt, double radius) {
  return std::max(2, 1 + static_cast<int>(std::sqrt(1.0 + 1.54 * dt * radius)));
}

/// Modulus of the largest eigenvalue of the rate about a state, from below, by the power method on
/// differences.
class SpectralRadius {
 public:
  explicit SpectralRadius(OdeSystem const& system) : system_(system), direction_(system.size) { restart(); }

  double operator()(double t, std::vector<double> const& y, std::vector<double> const& rate,
                    double amplitude) {
    std::vector<double> moved(y), moved_rate(system_.size);
    double radius = 0.0;
    for (int k = 0; k < 60; ++k) {
      for (std::size_t i = 0; i < system_.size; ++i) moved[i] = y[i] + amplitude * direction_[i];
      system_.rate(t, moved.data(), moved_rate.data());
      double image = 0.0;
      for (std::size_t i = 0; i < system_.size; ++i) {
        direction_[i] = (moved_rate[i] - rate[i]) / amplitude;
        image += direction_[i] * direction_[i];
      }
      // Root mean squares: the direction is kept at 1.
      double const next = std::sqrt(image / static_cast<double>(system_.size));
      if (!(next > 0.0) || !std::isfinite(next)) {
        restart();
        return next;
      }
      for (double& v : direction_) v /= next;
      bool const settled = std::abs(next - radius) < 1e-3 * next;
      radius = next;
      if (settled && k > 3) break;
    }
    return radius;
  }

 private:
  /// Any direction that no mode is likely to be missing from.
  void restart() {
    std::mt19937_64 random(1);
    for (double& v : direction_) v = random() % 2 == 0 ? 1.0 : -1.0;
  }

  OdeSystem const& system_;
  std::vector<double> direction_;
};

}  // namespace

OdeResult integrate_chebyshev(OdeSystem const& system, std::vector<double> y, double final_time,
                              Tolerances tolerances) {
  constexpr double margin = 1.2;          // the power method comes from below
  constexpr int steps_per_estimate = 25;  // of the spectral radius
  constexpr int most_rejections = 60;
  constexpr double shortest = 1e-14;  // part of the whole time, below which a step is lost in rounding
  std::size_t const n = system.size;
  std::size_t const all = n + system.quadratures;
  OdeResult result;
  y.resize(all, 0.0);
  // The quadratures go along: nothing depends on them, and the same weights keep what is linear.
  auto const rate = [&](double t, std::vector<double> const& at, std::vector<double>& out) {
    system.rate(t, at.data(), out.data());
    if (system.quadratures > 0) system.quadrature(t, at.data(), out.data() + n);
  };
  // Because a rate is no number, if one is.
  auto const fail = [&](char const* why, std::vector<double> const& of_rate) {
    auto const component = first_not_finite(of_rate);
    result.outcome = component ? OdeOutcome::not_finite : OdeOutcome::failed;
    result.not_finite = component.value_or(0);
    result.reason = why;
  };
  std::vector<double> first(all), last(all), before(all), now(all), next(all), stage_rate(all);
  rate(0.0, y, first);
  SpectralRadius spectral_radius(system);
  double radius = 0.0;
  double dt = 0.0;
  int rejections = 0;
  Samples samples(system);
  samples.pass(0.0, y.data(), y.data() + n);
  std::exception_ptr failure;
  while (result.time < final_time) {
    if (result.steps % steps_per_estimate == 0 && rejections == 0) {
      // A small part of a typical unknown, which is what the two tolerances have between them.
      radius =
          margin * spectral_radius(result.time,
                                   std::vector<double>(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)),
                                   first, 1e-7 * tolerances.absolute / tolerances.relative);
    }
    if (!std::isfinite(radius)) {
      fail("the stabilised integrator met a rate that is not finite", first);
      break;
    }
    double const stop = std::min(samples.next(), final_time);
    double const remaining = stop - result.time;
    if (dt == 0.0) dt = radius > 0.0 ? 1.0 / radius : remaining;
    double const h = std::min(dt, remaining);
    double const time = h >= remaining ? stop : result.time + h;
    Stages const stage(stages_for(h, radius));
    double error = std::numeric_limits<double>::infinity();
    try {
      before = y;
      for (std::size_t i = 0; i < all; ++i) now[i] = y[i] + h * stage.mu_rate[1] * first[i];
      for (std::size_t j = 2; j < stage.c.size(); ++j) {
        rate(result.time + stage.c[j - 1] * h, now, stage_rate);
        double const of_start = 1.0 - stage.mu[j] - stage.nu[j];
        for (std::size_t i = 0; i < all; ++i) {
          next[i] = of_start * y[i] + stage.mu[j] * now[i] + stage.nu[j] * before[i] +
                    h * (stage.mu_rate[j] * stage_rate[i] + stage.gamma_rate[j] * first[i]);
        }
        before.swap(now);
        now.swap(next);
      }
      rate(time, now, last);
      error = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        double const defect = 0.8 * (y[i] - now[i]) + 0.4 * h * (first[i] + last[i]);
        double const allowed =
            tolerances.absolute + tolerances.relative * std::max(std::abs(y[i]), std::abs(now[i]));
        error += defect / allowed * (defect / allowed);
      }
      error = std::sqrt(error / static_cast<double>(n));
    } catch (RateFailure const&) {
      // Perhaps only the step was too long.
      failure = std::current_exception();
    }
    if (!std::isfinite(error) || error > 1.0) {
      if (++rejections > most_rejections || h < shortest * final_time) {
        if (failure) std::rethrow_exception(failure);
        fail("the stabilised integrator's step shrank to nothing", last);
        break;
      }
      dt = h * (std::isfinite(error) ? std::max(0.1, 0.8 / std::cbrt(error)) : 0.1);
      continue;
    }
    rejections = 0;
    failure = nullptr;
    y.swap(now);
    first.swap(last);
    result.time = time;
    ++result.steps;
    // A step that was cut for a sample says nothing against a longer one.
    double const following = h * std::clamp(0.8 / std::cbrt(std::max(error, 1e-9)), 0.2, 5.0);
    dt = h < dt ? std::max(dt, following) : following;
    samples.pass(result.time, y.data(), y.data() + n);
    result.reason = system.monitor ? system.monitor(result.time, y.data(), y.data() + n) : "";
    if (!result.reason.empty()) {
      result.outcome = OdeOutcome::stopped;
      break;
    }
  }
  result.quadratures.assign(y.begin() + static_cast<std::ptrdiff_t>(n), y.end());
  y.resize(n);
  result.y = std::move(y);
  return result;
}

}  // namespace sphverify
