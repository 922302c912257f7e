// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "harness/measure/spectrum.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// An explicit Runge-Kutta method by its coefficients: stage s takes the rates of the stages before with the
/// weights of row s.
struct ButcherTable {
  std::string name;
  std::vector<std::vector<double>> rows;
  std::vector<double> weights;
};

/// Methods whose stable steps are reported: explicit Euler, Heun's and the classical Runge-Kutta method, and
/// the one that the runs are integrated with (Dormand & Prince 1980).
std::vector<ButcherTable> const& explicit_methods();

/// R(z): by what one step multiplies a solution of dy/dt = lambda y, z = lambda dt.
std::complex<double> amplification(ButcherTable const& method, std::complex<double> z);

/// The longest step up to which |R(lambda dt)| <= 1 for every eigenvalue, within its uncertainty. What grows
/// by itself has none.
StableStep stable_step(ButcherTable const& method, Spectrum const& spectrum);

/// The same by experiment: steps of the method on the rate itself, from a state about which it is linearised,
/// with a perturbation of all wavelengths that is kept small; bisected to 0.2%.
/// @param rate dy/dt = rate(y)
/// @param amplitude of the perturbation; the rate should be affine over as much
/// @param guess where to begin looking: what is more than eightfold off is not found [s]
/// @param out_of_time asked between steps; true ends the search without a result
Number measured_stable_step(ButcherTable const& method,
                            std::function<void(double const* y, double* dydt)> const& rate,
                            std::vector<double> const& state, double amplitude, double guess,
                            std::function<bool()> const& out_of_time);

}  // namespace sphverify
