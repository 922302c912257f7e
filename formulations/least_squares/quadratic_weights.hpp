// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/pair_geometry.hpp"

namespace sphverify {

/// Weights of every particle's partners with which differences give the Laplacian of every quadratic polynomial:
///
///   sum_j s_ij (f_j - f_i) + sum_B s_iB (f_B - f_i) = laplacian f,
///
/// those of least sum s^2/w, which are the Laplacian of the polynomial that fits best in least squares weighted by w. Partners are
/// the neighbours, those behind walls where some stand there, else walls' foot points; of a wall that prescribes flux the slope
/// n.grad f at the foot point. w is the kernel at the partner's distance. Not symmetric: s_ij is not s_ji.
/// Source: Schwaiger 2008; Fatehi & Manzari 2011; Trask, Perego & Bochev 2017 (generalised moving least squares).
template <int Dim>
class QuadraticWeights {
 public:
  /// The geometry with s_ij in place of W'(r)/r [m^-2], and with face weights s_iB d_i, or s_iB at a wall that prescribes
  /// flux [m^-1]. Found anew when anything has moved since.
  /// Throws TooFewPartners, which names the first particle whose partners fix no quadratic.
  PairGeometry<Dim>& on(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry, int threads);

  /// What `on` gave last.
  PairGeometry<Dim>& last() { return weighted_; }
  PairGeometry<Dim> const& last() const { return weighted_; }

  std::size_t bytes() const { return weighted_.bytes() + places_.capacity() * sizeof(double); }

 private:
  void weigh(Particles<Dim> const& particles, int threads);

  PairGeometry<Dim> weighted_;
  std::vector<double> places_;  ///< of what the weights were found for
};

}  // namespace sphverify
