// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "harness/integrate/ode.hpp"

namespace sphverify {

/// Calls a system's `sample` as an integrator passes its times.
class Samples {
 public:
  explicit Samples(OdeSystem const& system) : system_(system) {
    if (system_.sample) state_.resize(system_.size + system_.quadratures);
  }

  /// The next time that is asked for; infinite after the last.
  double next() const {
    return system_.sample && taken_ < system_.sample_times.size() ? system_.sample_times[taken_]
                                                                  : std::numeric_limits<double>::infinity();
  }

  /// Takes all samples up to the end of a step.
  /// @param y,q the state and the quadratures there
  /// @param state_at fills in unknowns and then quadratures at a time within the step, by the integrator's
  /// dense output; called as state_at(time, values)
  template <class StateAt>
  void pass(double time, double const* y, double const* q, StateAt const& state_at) {
    for (; next() <= time; ++taken_) {
      double const at = next();
      if (at == time) {
        system_.sample(at, y, q);
      } else {
        state_at(at, state_.data());
        system_.sample(at, state_.data(), state_.data() + system_.size);
      }
    }
  }

  /// The same of an integrator whose steps end at the samples.
  void pass(double time, double const* y, double const* q) {
    pass(time, y, q, [](double, double*) {});
  }

 private:
  OdeSystem const& system_;
  std::size_t taken_ = 0;
  std::vector<double> state_;
};

}  // namespace sphverify
