// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "harness/run/clock.hpp"
#include "harness/run/moving_gas.hpp"
#include "harness/run/run.hpp"

namespace sphverify {

/// The particles as a run left them: what its errors are taken of.
template <int Dim>
struct FinalState {
  std::unique_ptr<MovingGas<Dim>> gas;
  GasBudgets<Dim> budgets;
  std::uint64_t steps = 0;
  double lowest_density = std::numeric_limits<double>::infinity();
  double lowest_pressure = std::numeric_limits<double>::infinity();
  History history;
  Cost cost;
};

template <int Dim>
Motion motion_of(FinalState<Dim> const& state);

/// A run from set-up to its end, whoever asks for it.
template <int Dim>
class MovingIntegration {
 public:
  MovingIntegration(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options, MeasuredRun& run)
      : problem_(problem),
        choice_(choice),
        options_(options),
        run_(run),
        record_(run.record),
        spent_before_(run.spent_seconds) {}

  /// One run at a rung of the ladder; empty, with the record's status set, if it broke.
  std::optional<FinalState<Dim>> integrate(SceneChoice const& choice, double rung);

 protected:
  /// Of the time budget.
  double spent() const { return spent_before_ + clock_.seconds(); }

  std::string const& method() const { return record_.discretisation.integrator; }
  bool is_leapfrog() const { return method() == "leapfrog"; }

  Problem<Dim> const& problem_;
  SceneChoice const& choice_;
  RunOptions const& options_;
  MeasuredRun& run_;
  RunRecord& record_;

 private:
  std::nullopt_t give_up(FinalState<Dim> const& state, std::string const& status, std::string const& reason);

  double spent_before_;
  Clock clock_;
};

extern template class MovingIntegration<1>;
extern template class MovingIntegration<2>;
extern template class MovingIntegration<3>;

}  // namespace sphverify
