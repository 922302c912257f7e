// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "formulations/basics/parallel.hpp"
#include "harness/integrate/ode.hpp"
#include "harness/integrate/samples.hpp"

namespace sphverify {

namespace {

// Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19, RK5(4)7M; the last stage is the first of the next step.
constexpr double c2 = 1.0 / 5.0, c3 = 3.0 / 10.0, c4 = 4.0 / 5.0, c5 = 8.0 / 9.0;
constexpr double a21 = 1.0 / 5.0;
constexpr double a31 = 3.0 / 40.0, a32 = 9.0 / 40.0;
constexpr double a41 = 44.0 / 45.0, a42 = -56.0 / 15.0, a43 = 32.0 / 9.0;
constexpr double a51 = 19372.0 / 6561.0, a52 = -25360.0 / 2187.0, a53 = 64448.0 / 6561.0, a54 = -212.0 / 729.0;
constexpr double a61 = 9017.0 / 3168.0, a62 = -355.0 / 33.0, a63 = 46732.0 / 5247.0, a64 = 49.0 / 176.0,
                 a65 = -5103.0 / 18656.0;
constexpr double b1 = 35.0 / 384.0, b3 = 500.0 / 1113.0, b4 = 125.0 / 192.0, b5 = -2187.0 / 6784.0, b6 = 11.0 / 84.0;
/// Of order 5 less of order 4: the estimate of the error.
constexpr double e1 = 71.0 / 57600.0, e3 = -71.0 / 16695.0, e4 = 71.0 / 1920.0, e5 = -17253.0 / 339200.0, e6 = 22.0 / 525.0,
                 e7 = -1.0 / 40.0;
/// Dense output of order 4 (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed., Section II.6).
constexpr double d1 = -12715105075.0 / 11282082432.0, d3 = 87487479700.0 / 32700410799.0, d4 = -10690763975.0 / 1880347072.0,
                 d5 = 701980252875.0 / 199316789632.0, d6 = -1453857185.0 / 822651844.0, d7 = 69997945.0 / 29380423.0;

/// How steps follow errors (the same book, Section II.4; PI control, Section IV.2).
constexpr double safety = 0.9, least_factor = 0.2, most_factor = 10.0, of_error = 0.7 / 5.0, of_error_before = 0.4 / 5.0;

/// Steps that are on average too short, over so many of them, will not end the run. A few may well be short:
/// a rate that jumps (a particle comes into a wall's reach) is passed by steps whose error does not count.
constexpr std::uint64_t steps_to_judge = 1000;
/// Below this part of the whole time a step is lost in rounding; what is left of it by so much of a step belongs to that step.
constexpr double lost_in_rounding = 1e-15, sliver = 1e-9;

/// A rate is no number, and no step however short goes on from there.
struct NotFinite {
  std::size_t unknown;
};

/// The unknowns of one run, followed by quadratures, on which nothing depends; and its steps. Six vectors in all: as soon as
/// four stages are known all that later ones take of them is added up, in their place.
class DormandPrince {
 public:
  DormandPrince(OdeSystem const& system, std::vector<double> y, Tolerances tolerances)
      : system_(system),
        tolerances_(tolerances),
        size_(system.size + system.quadratures),
        y_(std::move(y)),
        stage_(size_),
        sum1_(size_),
        sum2_(size_),
        sum3_(size_),
        rate_(size_) {
    y_.resize(size_, 0.0);
    if (system.sample) {
      first_.resize(size_);
      dense_.resize(size_);
    }
  }

  void begin() { rate(0.0, y_, sum1_); }

  double const* state() const { return y_.data(); }
  double const* quadratures() const { return y_.data() + system_.size; }
  std::size_t bytes() const { return sizeof(double) * (6 * size_ + first_.size() + dense_.size() + system_.scales.size()); }
  std::vector<double> take() && { return std::move(y_); }

  /// From how far apart a step by Euler's rule finds the rates (the same book, Section II.4), in parts of the longest, so that
  /// units do not matter. The rule's step changes no unknown by much, and is shortened where it meets a state without a rate.
  double first_step(double longest) {
    constexpr double small = 1e-5;
    double const of_state = largest([&](std::size_t k) { return y_[k]; });
    double const largest_rate = longest * largest([&](std::size_t k) { return sum1_[k]; });
    double guess = std::min(1.0, of_state < small || largest_rate < small ? 1e-6 : 0.01 * of_state / largest_rate);
    for (int left = 5;; --left, guess *= 0.1) {
      for_each([&](std::size_t k) { stage_[k] = y_[k] + guess * longest * sum1_[k]; });
      try {
        rate(guess * longest, stage_, rate_);
        break;
      } catch (NotFinite const&) {
        if (left == 0) throw;
      } catch (RateFailure const&) {
        if (left == 0) throw;
      }
    }
    double const of_rate = longest * norm([&](std::size_t k) { return sum1_[k]; });
    double const curvature = longest * norm([&](std::size_t k) { return rate_[k] - sum1_[k]; }) / guess;
    double const most = std::max(of_rate, curvature);
    double const by_error = most <= 1e-15 ? std::max(1e-6, 1e-3 * guess) : std::pow(0.01 / most, 0.2);
    return longest * std::min({1.0, 100.0 * guess, by_error});
  }

  /// Tries a step from `t`: the error of what would be the state, over the tolerance. `accept` or `reject` goes on from there.
  double attempt(double t, double dt) {
    auto &k1 = sum1_, &k2 = sum2_, &k3 = sum3_, &k4 = rate_;
    if (system_.sample) first_ = k1;
    for_each([&](std::size_t k) { stage_[k] = y_[k] + dt * (a21 * k1[k]); });
    rate(t + c2 * dt, stage_, k2);
    for_each([&](std::size_t k) { stage_[k] = y_[k] + dt * (a31 * k1[k] + a32 * k2[k]); });
    rate(t + c3 * dt, stage_, k3);
    for_each([&](std::size_t k) { stage_[k] = y_[k] + dt * (a41 * k1[k] + a42 * k2[k] + a43 * k3[k]); });
    rate(t + c4 * dt, stage_, k4);
    // All that is still to come of these four: of the sixth stage, of the new state, of the error.
    auto &sixth = sum1_, &next = sum2_, &error = sum3_;
    for_each([&](std::size_t k) {
      double const one = k1[k], two = k2[k], three = k3[k], four = k4[k];
      stage_[k] = y_[k] + dt * (a51 * one + a52 * two + a53 * three + a54 * four);
      sixth[k] = a61 * one + a62 * two + a63 * three + a64 * four;
      next[k] = b1 * one + b3 * three + b4 * four;
      error[k] = e1 * one + e3 * three + e4 * four;
      if (system_.sample) dense_[k] = d1 * one + d3 * three + d4 * four;
    });
    rate(t + c5 * dt, stage_, rate_);
    for_each([&](std::size_t k) {
      stage_[k] = y_[k] + dt * (sixth[k] + a65 * rate_[k]);
      next[k] += b5 * rate_[k];
      error[k] += e5 * rate_[k];
      if (system_.sample) dense_[k] += d5 * rate_[k];
    });
    rate(t + dt, stage_, rate_);
    for_each([&](std::size_t k) {
      stage_[k] = y_[k] + dt * (next[k] + b6 * rate_[k]);
      error[k] += e6 * rate_[k];
      if (system_.sample) dense_[k] += d6 * rate_[k];
    });
    rate(t + dt, stage_, rate_);
    return norm([&](std::size_t k) { return dt * (error[k] + e7 * rate_[k]); }, &stage_);
  }

  /// The step is taken; `state_at` knows it until the next attempt.
  void accept() {
    std::swap(y_, stage_);
    std::swap(sum1_, rate_);
  }
  /// The state is as it was before; its rate is asked for again.
  void reject(double t) { rate(t, y_, sum1_); }

  /// Within the last step, which began with `begin` and took dt.
  void state_at(double t, double begin, double dt, double* values) const {
    double const theta = (t - begin) / dt;
    auto const &before = stage_, &after = y_, &last_rate = sum1_;
    for (std::size_t k = 0; k < size_; ++k) {
      double const change = after[k] - before[k];
      double const bent = dt * first_[k] - change;
      double const twisted = change - dt * last_rate[k] - bent;
      double const fourth = dt * (dense_[k] + d7 * last_rate[k]);
      values[k] = before[k] + theta * (change + (1.0 - theta) * (bent + theta * (twisted + (1.0 - theta) * fourth)));
    }
  }

 private:
  void for_each(auto const& row) const { for_each_row(size_, system_.threads, row); }

  /// Throws NotFinite.
  void rate(double t, std::vector<double> const& at, std::vector<double>& out) const {
    system_.rate(t, at.data(), out.data());
    if (system_.quadratures > 0) system_.quadrature(t, at.data(), out.data() + system_.size);
    if (auto const unknown = first_row(size_, system_.threads, [&](std::size_t k) { return !std::isfinite(out[k]); }))
      throw NotFinite{*unknown};
  }

  /// A number of unknown k over what is tolerated of it beside the state, or beside the larger of it and another. Nothing is
  /// tolerated where nothing is.
  double relative(double value, std::size_t k, std::vector<double> const* other) const {
    if (value == 0.0) return 0.0;
    double const scale = k < system_.scales.size() ? system_.scales[k] : 1.0;
    double const size = other ? std::max(std::abs(y_[k]), std::abs((*other)[k])) : std::abs(y_[k]);
    return value / (tolerances_.relative * size + tolerances_.absolute * scale);
  }
  /// Root mean square of value(k), relative.
  double norm(auto const& value, std::vector<double> const* other = nullptr) const {
    double const sum = sum_of_rows(size_, system_.threads, 0.0, [&](std::size_t k) {
      double const part = relative(value(k), k, other);
      return part * part;
    });
    return std::sqrt(sum / static_cast<double>(size_));
  }
  double largest(auto const& value) const {
    return joined_blocks(
        size_, system_.threads, 0.0,
        [&](std::size_t begin, std::size_t end) {
          double most = 0.0;
          for (std::size_t k = begin; k < end; ++k) most = std::max(most, std::abs(relative(value(k), k, nullptr)));
          return most;
        },
        [](double& all, double part) { all = std::max(all, part); });
  }

  OdeSystem const& system_;
  Tolerances tolerances_;
  std::size_t size_;
  std::vector<double> y_, stage_;
  std::vector<double> sum1_, sum2_, sum3_;  ///< rates of the first three stages, then sums; the first is that at the step's beginning
  std::vector<double> rate_;                ///< of the last stage
  std::vector<double> first_, dense_;       ///< for samples: the rate at the step's beginning, the sum of dense output
};

}  // namespace

OdeResult integrate_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time, Tolerances tolerances) {
  OdeResult result;
  auto const fail = [&](OdeOutcome outcome, std::string reason) {
    result.outcome = outcome;
    result.reason = std::move(reason);
  };
  DormandPrince solver(system, std::move(y), tolerances);
  try {
    Samples samples(system);
    samples.pass(0.0, solver.state(), solver.quadratures());
    solver.begin();
    double dt = solver.first_step(final_time);
    double error_before = 1e-4;
    double judged = 0.0;  // the time up to which steps have been judged
    bool was_rejected = false;
    while (result.time < final_time) {
      double const begin = result.time;
      bool const is_last = dt >= (final_time - begin) * (1.0 - sliver);
      if (is_last) dt = final_time - begin;
      if (!is_last && !(dt > lost_in_rounding * final_time)) {
        fail(OdeOutcome::failed, "the explicit integrator's step shrank to nothing");
        break;
      }
      double const error = solver.attempt(begin, dt);
      double const factor = error > 0.0 ? safety * std::pow(error, -of_error) * std::pow(error_before, of_error_before) : most_factor;
      if (!(error <= 1.0)) {
        solver.reject(begin);
        was_rejected = true;
        dt *= std::isfinite(error) ? std::clamp(safety * std::pow(error, -0.2), least_factor, safety) : least_factor;
        continue;
      }
      solver.accept();
      result.time = is_last ? final_time : begin + dt;
      ++result.steps;
      if (result.steps % steps_to_judge == 0) {
        if (result.time - judged < steps_to_judge * system.smallest_step) {
          fail(OdeOutcome::failed, "the explicit integrator's step collapsed");
          break;
        }
        judged = result.time;
      }
      samples.pass(result.time, solver.state(), solver.quadratures(),
                   [&](double t, double* values) { solver.state_at(t, begin, dt, values); });
      result.reason = system.monitor ? system.monitor(result.time, solver.state(), solver.quadratures()) : "";
      if (!result.reason.empty()) {
        result.outcome = OdeOutcome::stopped;
        break;
      }
      dt *= std::clamp(factor, least_factor, std::exchange(was_rejected, false) ? 1.0 : most_factor);
      error_before = std::max(error, 1e-4);
    }
  } catch (NotFinite const& found) {
    fail(OdeOutcome::not_finite, "the explicit integrator met a rate that is not finite");
    result.not_finite = found.unknown;
  }
  result.bytes = solver.bytes();
  result.y = std::move(solver).take();
  result.quadratures.assign(result.y.begin() + static_cast<std::ptrdiff_t>(system.size), result.y.end());
  result.y.resize(system.size);
  return result;
}

}  // namespace sphverify
