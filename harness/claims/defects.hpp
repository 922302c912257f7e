// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "formulations/kernels/kernel.hpp"
#include "formulations/scheme.hpp"

// By how much a scheme fails to do a thing: one number each, relative to what it is made of; nothing where the question
// makes no sense. Expected values are derived from the equations that a scheme discretises, never from its own sums.
namespace sphverify::claims {

/// Momentum that pairs of an acceleration make, or energy that those of another rate make.
template <int Dim>
std::optional<double> pair_budget(SchemeInfo const& scheme, Kernel const& kernel);
/// Kinetic and internal energy together, of a momentum form with the energy equation that it names.
template <int Dim>
std::optional<double> energy_with_partner(SchemeInfo const& scheme, Kernel const& kernel);
/// What particles gain less what pairs made and walls say that they gave.
template <int Dim>
std::optional<double> wall_budget(SchemeInfo const& scheme, Kernel const& kernel);
/// Rate of a uniform state on a lattice, far from its edges.
template <int Dim>
std::optional<double> uniform_on_lattice(SchemeInfo const& scheme, Kernel const& kernel);
/// The same on particles that are jittered by a fifth of their spacing.
template <int Dim>
std::optional<double> uniform_on_jittered(SchemeInfo const& scheme, Kernel const& kernel);
/// Difference from the derivative of linear fields on a lattice times powers of the lattice's factor.
template <int Dim>
std::optional<double> linear_on_lattice(SchemeInfo const& scheme, Kernel const& kernel);
/// Change when all is moved, turned and mirrored.
template <int Dim>
std::optional<double> covariance(SchemeInfo const& scheme, Kernel const& kernel);
/// Change when particles are numbered the other way round.
template <int Dim>
std::optional<double> numbering(SchemeInfo const& scheme, Kernel const& kernel);
/// Change when everything has a velocity more.
template <int Dim>
std::optional<double> boost(SchemeInfo const& scheme, Kernel const& kernel);
/// What one neighbour adds just inside the support's edge, over what it adds at half of it.
template <int Dim>
std::optional<double> at_the_support(SchemeInfo const& scheme, Kernel const& kernel);
/// Difference of what two particles of unlike conductivities exchange from what the claimed mean says.
template <int Dim>
std::optional<double> conductivity_mean(SchemeInfo const& scheme, Kernel const& kernel);

}  // namespace sphverify::claims
