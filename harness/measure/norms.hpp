// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cases/support/features.hpp"
#include "formulations/particles/domain.hpp"
#include "formulations/particles/particles.hpp"
#include "formulations/walls/walls.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Weighted l1, l2 and maximum norm of numbers; the weights are normalised to sum 1, so that l1 <= l2 <=
/// linf. All NaN where a value or a weight is not finite. Expects as many weights as values and a positive
/// sum.
NormSet norms(std::span<double const> values, std::span<double const> weights);

/// Which particles an error is taken over. Two-pass forms feel a wall to twice the support.
struct Region {
  std::string name;
  std::vector<std::size_t> particles;
};

/// `all`; `wall`: within the support of a wall (2h with the cubic spline); `corner`: of those, within it of
/// two that are not parallel; `interior`: beyond two supports from every wall; `smooth`, where there are
/// features: beyond two supports and `smooth_margin` from every one of them. Regions without particles are
/// left out.
/// @param counts which particles count at all; empty: all of them
/// @param features of the exact solution; a wide one that the particles resolve is none
/// @param smooth_margin [m]
template <int Dim>
std::vector<Region> regions(Particles<Dim> const& particles, std::vector<Wall<Dim>> const& walls,
                            std::function<bool(std::size_t)> const& counts = {},
                            Features<Dim> const& features = {}, double smooth_margin = 0.0);

/// How far `smooth` keeps from features at least: a twentieth of the domain's first extent. Within a distance
/// that shrinks with h there is always the same part of what a shock's viscosity smears, and of a front's
/// curvature: the maximum error there falls no faster than at the feature itself. [m]
template <int Dim>
double smooth_margin(Domain<Dim> const& domain) {
  return 0.05 * domain.extent()[0];
}

/// Norms of |computed - exact| and of |exact| by region. `components` lists of one value per particle each; a
/// vector's error is the length of the difference.
/// @param weights V_i, volumes of the exact solution
/// @param round_off error that rounding alone explains
FieldErrors field_errors(std::vector<std::span<double const>> const& computed,
                         std::vector<std::span<double const>> const& exact, std::span<double const> weights,
                         std::vector<Region> const& regions, double round_off);

/// Weighted mean of computed - exact over a region, with its sign; empty where it is not finite.
Number mean_difference(std::span<double const> computed, std::span<double const> exact,
                       std::span<double const> weights, Region const& region);

}  // namespace sphverify
