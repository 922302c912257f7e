// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/allowed_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulations/particles/smoothing_length.hpp"

#include "reports/find_error.hpp"

namespace sphverify {

NormSet feature_orders(double exponent, double codimension, double thinning) {
  auto const order = [&](double inverse_p) {
    return std::min(smooth_order, thinning * (exponent + codimension * inverse_p));
  };
  return {order(1.0), order(0.5), order(0.0)};
}

namespace {

/// Whether a particle of the region is so near that it feels the feature, or nearer than all others.
template <int Dim>
bool reaches(Feature<Dim> const& feature, Particles<Dim> const& particles, Region const& region) {
  SmoothingLength const h(particles);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < particles.size(); ++i)
    nearest = std::min(nearest, feature.distance(particles.positions()[i]));
  return std::any_of(region.particles.begin(), region.particles.end(), [&](std::size_t i) {
    double const support = h.support(i);
    return feature.width < h(i) && feature.distance(particles.positions()[i]) <= std::max(support, nearest);
  });
}

/// The power of a distance with which the share of the region within it goes.
template <int Dim>
double codimension_within(Feature<Dim> const& feature, Particles<Dim> const& particles,
                          Region const& region) {
  SmoothingLength const h(particles);
  double near = 0.0;
  double far = 0.0;
  for (std::size_t const i : region.particles) {
    double const support = h.support(i);
    double const distance = feature.distance(particles.positions()[i]);
    if (distance < 2.0 * support) near += 1.0;
    if (distance < 4.0 * support) far += 1.0;
  }
  if (near == 0.0) return 0.0;
  return std::clamp(std::round(std::log2(far / near)), 0.0, static_cast<double>(feature.codimension));
}

}  // namespace

template <int Dim>
std::optional<NormSet> allowed_orders(Field field, Features<Dim> const& features,
                                      Particles<Dim> const& particles, Region const& region) {
  bool const is_thin = region.name == "wall" || region.name == "corner";
  std::optional<NormSet> allowed;
  for (Feature<Dim> const& feature : features) {
    auto const exponent = feature.exponents.find(field);
    if (exponent == feature.exponents.end() || !reaches(feature, particles, region)) continue;
    double const codimension = is_thin ? codimension_within(feature, particles, region) : feature.codimension;
    NormSet const orders = feature_orders(exponent->second, codimension, feature.thinning);
    if (!allowed) allowed = NormSet{smooth_order, smooth_order, smooth_order};
    for (double NormSet::*const norm : {&NormSet::l1, &NormSet::l2, &NormSet::linf})
      *allowed.*norm = std::min(*allowed.*norm, orders.*norm);
  }
  return allowed;
}

NormSet allowed_of_ladder(std::vector<std::vector<RunRecord const*>> const& levels, std::string const& field,
                          std::string const& region) {
  NormSet allowed{smooth_order, smooth_order, smooth_order};
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    bool found = false;
    for (RunRecord const* run : *level) {
      RegionError const* const error = find_error(*run, field, region);
      if (error == nullptr) continue;
      found = true;
      if (!error->allowed) continue;
      for (double NormSet::*const norm : {&NormSet::l1, &NormSet::l2, &NormSet::linf})
        allowed.*norm = std::min(allowed.*norm, (*error->allowed).*norm);
    }
    if (found) break;
  }
  return allowed;
}

template std::optional<NormSet> allowed_orders(Field, Features<1> const&, Particles<1> const&, Region const&);
template std::optional<NormSet> allowed_orders(Field, Features<2> const&, Particles<2> const&, Region const&);
template std::optional<NormSet> allowed_orders(Field, Features<3> const&, Particles<3> const&, Region const&);

}  // namespace sphverify
