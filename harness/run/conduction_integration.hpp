// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "harness/measure/second_law.hpp"
#include "harness/run/clock.hpp"
#include "harness/run/frozen_conduction.hpp"
#include "harness/run/run.hpp"

namespace sphverify {

/// Largest temperature of the exact solution at the ends of the run, walls included, where it is finite.
template <int Dim>
double temperature_scale(Problem<Dim> const& problem);

/// sum of m T (specific heat 1)
template <int Dim>
double energy_of(Particles<Dim> const& particles, double const* temperature);

/// A run from set-up to its end, whoever asks for it.
template <int Dim>
class ConductionIntegration {
 public:
  ConductionIntegration(Problem<Dim> const& problem, RunOptions const& options, RunRecord& record,
                        double scale, double spent_seconds)
      : problem_(problem), options_(options), record_(record), scale_(scale), spent_before_(spent_seconds) {}

  /// Integrates at one tolerance; empty, with the record's status set, if the run broke.
  std::optional<OdeResult> integrate(FrozenConduction<Dim>& conduction, double tolerance, bool with_quadratures);

 protected:
  /// Of the time budget.
  double spent() const { return spent_before_ + clock_.seconds(); }

  Problem<Dim> const& problem_;
  RunOptions const& options_;
  RunRecord& record_;
  double scale_;
  double spent_before_;
  Clock clock_;
  History history_;
  std::optional<SecondLawWatch<Dim>> watch_;
};

extern template class ConductionIntegration<1>;
extern template class ConductionIntegration<2>;
extern template class ConductionIntegration<3>;

}  // namespace sphverify
