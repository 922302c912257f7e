// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/support/features.hpp"
#include "formulations/particles/particles.hpp"
#include "harness/measure/norms.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Order of a method that is of second order where the solution is smooth.
inline constexpr double smooth_order = 2.0;

/// Highest orders in l1, l2 and linf of an error that a feature d^s of some codimension makes, where it is
/// resolved on a width of order r = dx^thinning, at most 2. Within r of the feature the error is of order
/// r^s, beyond it r^2 d^(s-2) by the second derivative; the volume within d goes as d^codimension. So the
/// integral of its p-th power goes as r^(ps + codimension) unless it comes from far away, and its root as
///
///   r^min(2, s + codimension/p).
NormSet feature_orders(double exponent, double codimension, double thinning = 1.0);

/// The smallest of these over all features of a field that reach into a region: that have a particle of it
/// within the support, or nearer than any other particle. Empty where none does.
///
/// The regions `wall` and `corner` are as thin as the smearing itself. What counts there is the share of the
/// region within some distance of the feature: it goes as a power of the distance that is found by counting,
/// within two supports and four, and which is 0 where the feature runs along the wall.
template <int Dim>
std::optional<NormSet> allowed_orders(Field field, Features<Dim> const& features,
                                      Particles<Dim> const& particles, Region const& region);

/// What the runs of a ladder allow, which goes by its finest level that has errors there, whose replicates
/// all count: 2 where they do not say.
/// @param levels coarse to fine, each with its replicates
NormSet allowed_of_ladder(std::vector<std::vector<RunRecord const*>> const& levels, std::string const& field,
                          std::string const& region);

}  // namespace sphverify
