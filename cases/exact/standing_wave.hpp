// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Standing sound wave between rigid walls at x = 0 and 1, correct to the second order of its amplitude.
///
/// At t = 0 pressure and density are uniform and u = amplitude c0 sin(k x), k = mode pi. A particle that
/// starts at a is at x = a + s(a, t); there rho = rho0/(1 + s_a), P = P0 (rho/rho0)^gamma, u = s_t, so that
/// mass, entropy and walls are exact, and momentum asks for s_tt = c0^2 s_aa (1 + s_a)^(-gamma-1). With
/// omega = k c0
///
///   s = (amplitude/k) sin(k a) sin(omega t) + B(t) sin(2 k a)
///   B = (gamma+1) amplitude^2/(16 k) (1 - cos(2 omega t) - omega t sin(2 omega t))
///
/// solves it but for terms of the third order. (Put the first term into the quadratic part of the equation:
/// it drives the mode 2 k at its own frequency 2 omega, so that this one grows: the wave steepens.) The
/// equation: Lord Rayleigh, Theory of Sound II, chapter XI; the expansion in this form is ours.
///
/// What is left is mainly the same steepening at the next order. Each of the two running waves follows
/// Fubini's series in sigma = (gamma+1) amplitude omega t/4 (D. T. Blackstock, J. Acoust. Soc. Am. 34 (1962)
/// 9), whose first and third harmonics change by sigma^2/8 and 3 sigma^2/8 of the amplitude: together
/// (gamma+1)^2/32 amplitude^3 c0 (omega t)^2. accuracy() is that after one period with a margin for the terms
/// that do not grow. A shock forms near sigma = 1; times from 0 to there are allowed.
class StandingWave {
 public:
  /// The amplitude, below 1/(gamma+1), is the greatest velocity at t = 0 in units of the sound speed.
  StandingWave(double amplitude, int mode, double density, double pressure, double gamma);

  GasState at(double x, double t) const;
  double period() const;
  double shock_formation_time() const;  ///< of the first order: where sigma = 1

  /// Absolute accuracy of the velocity during the first period: 2 (gamma+1)^2 amplitude^3 c0.
  double accuracy() const;

 private:
  struct Pair {
    double first, second;
  };
  Pair harmonics(double t) const;
  Pair harmonic_rates(double t) const;
  double origin(double x, Pair const& s) const;

  double wave_number_;
  double gamma_;
  double amplitude_;
  GasState rest_;
  double frequency_;
};

}  // namespace sphverify::exact
