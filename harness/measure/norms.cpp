// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/norms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/finite.hpp"
#include "formulations/particles/smoothing_length.hpp"
#include "reports/extremes.hpp"

namespace sphverify {

NormSet norms(std::span<double const> values, std::span<double const> weights) {
  expects(values.size() == weights.size());
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double total = 0.0;
  for (double const w : weights) total += w;
  // What one of them is not known of is not known of all: a maximum would pass over it.
  if (first_not_finite(values) || !std::isfinite(total)) return {unknown, unknown, unknown};
  expects(total > 0.0);
  NormSet norm;
  for (double const value : values) norm.linf = std::max(norm.linf, std::abs(value));
  if (norm.linf == 0.0) return norm;
  // Relative to the largest value, so that squares neither overflow nor vanish.
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const ratio = std::abs(values[i]) / norm.linf;
    double const w = weights[i] / total;
    norm.l1 += w * ratio;
    squares += w * ratio * ratio;
  }
  // Round-off must not put l1 above l2, nor l2 above linf.
  norm.l2 = norm.linf * std::min(1.0, std::sqrt(squares));
  norm.l1 = std::min(norm.linf * norm.l1, norm.l2);
  return norm;
}

namespace {

/// Whether a point is within a distance of two walls that are not parallel.
template <int Dim>
bool is_in_corner(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double distance) {
  constexpr double least_sine = 1e-6;
  for (auto one = walls.begin(); one != walls.end(); ++one) {
    if (one->distance(x) >= distance) continue;
    for (auto other = std::next(one); other != walls.end(); ++other) {
      Vector<Dim> const n = one->outward_normal;
      Vector<Dim> const across = other->outward_normal - n.dot(other->outward_normal) * n;
      if (other->distance(x) < distance && across.norm() > least_sine) return true;
    }
  }
  return false;
}

}  // namespace

template <int Dim>
std::vector<Region> regions(Particles<Dim> const& particles, std::vector<Wall<Dim>> const& walls,
                            std::function<bool(std::size_t)> const& counts, Features<Dim> const& features,
                            double smooth_margin) {
  SmoothingLength const h(particles);
  Region all{"all", {}}, wall{"wall", {}}, corner{"corner", {}}, interior{"interior", {}},
      smooth{"smooth", {}};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (counts && !counts(i)) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (Wall<Dim> const& one : walls) nearest = smaller(nearest, one.distance(particles.positions()[i]));
    double const support = h.support(i);
    all.particles.push_back(i);
    if (nearest < support) wall.particles.push_back(i);
    if (nearest < support && is_in_corner(particles.positions()[i], walls, support))
      corner.particles.push_back(i);
    if (nearest > 2.0 * support) interior.particles.push_back(i);
    bool const is_smooth = std::all_of(features.begin(), features.end(), [&](Feature<Dim> const& one) {
      return one.width > h(i) ||
             one.distance(particles.positions()[i]) > std::max(2.0 * support, smooth_margin);
    });
    if (is_smooth && !features.empty()) smooth.particles.push_back(i);
  }
  std::vector<Region> found;
  for (Region& region :
       {std::ref(all), std::ref(wall), std::ref(corner), std::ref(interior), std::ref(smooth)}) {
    if (!region.particles.empty()) found.push_back(std::move(region));
  }
  return found;
}

FieldErrors field_errors(std::vector<std::span<double const>> const& computed,
                         std::vector<std::span<double const>> const& exact, std::span<double const> weights,
                         std::vector<Region> const& regions, double round_off) {
  expects(computed.size() == exact.size() && !computed.empty());
  FieldErrors errors;
  for (Region const& region : regions) {
    std::vector<double> difference, size, weight;
    for (std::vector<double>* list : {&difference, &size, &weight}) list->reserve(region.particles.size());
    for (std::size_t const i : region.particles) {
      double length_of_difference = std::abs(computed[0][i] - exact[0][i]);
      double length_of_exact = std::abs(exact[0][i]);
      for (std::size_t k = 1; k < computed.size(); ++k) {
        length_of_difference = std::hypot(length_of_difference, computed[k][i] - exact[k][i]);
        length_of_exact = std::hypot(length_of_exact, exact[k][i]);
      }
      difference.push_back(length_of_difference);
      size.push_back(length_of_exact);
      weight.push_back(weights[i]);
    }
    errors[region.name] = {norms(difference, weight), norms(size, weight), round_off};
  }
  return errors;
}

Number mean_difference(std::span<double const> computed, std::span<double const> exact,
                       std::span<double const> weights, Region const& region) {
  double total = 0.0;
  for (std::size_t const i : region.particles) total += weights[i];
  double mean = 0.0;
  for (std::size_t const i : region.particles) mean += weights[i] / total * (computed[i] - exact[i]);
  return std::isfinite(mean) ? Number(mean) : std::nullopt;
}

template std::vector<Region> regions(Particles<1> const&, std::vector<Wall<1>> const&,
                                     std::function<bool(std::size_t)> const&, Features<1> const&, double);
template std::vector<Region> regions(Particles<2> const&, std::vector<Wall<2>> const&,
                                     std::function<bool(std::size_t)> const&, Features<2> const&, double);
template std::vector<Region> regions(Particles<3> const&, std::vector<Wall<3>> const&,
                                     std::function<bool(std::size_t)> const&, Features<3> const&, double);

}  // namespace sphverify
