// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "formulations/particles/domain.hpp"
#include "formulations/particles/particles.hpp"
#include "formulations/walls/walls.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Where a mode of a linearised rate lives, and how short its waves are.
///
/// The wavelength is that of the plane wave with the same mean squared difference between particles closer
/// than 1.3 dx: along each of Dim axes, 1 - cos(2 pi dx/wavelength) summed over the axes is Dim times the
/// mean of |v_i - v_j|^2 over that of |v_i|^2 + |v_j|^2; what would be shorter than 2 dx is given as 2 dx.
/// @param amplitude one complex number per particle and component, component by component
template <int Dim>
Mode mode_shape(std::complex<double> eigenvalue, Eigen::Ref<Eigen::VectorXcd const> const& amplitude,
                Particles<Dim> const& particles, Domain<Dim> const& domain,
                std::vector<Wall<Dim>> const& walls, double spacing);

}  // namespace sphverify
