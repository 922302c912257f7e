// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/defects.hpp"
#include "harness/claims/random_scene.hpp"

namespace sphverify::claims {

namespace {

/// Sum of m times the rate, and the sum of its magnitudes.
template <int Dim>
struct Budget {
  Vector<Dim> force = Vector<Dim>::Zero();
  double power = 0.0;
  double gross = 0.0;

  Budget(RandomScene<Dim> const& scene, Rates<Dim> const& rates) {
    auto const& m = scene.particles.masses();
    for (std::size_t i = 0; i < rates.acceleration.size(); ++i) {
      force += m[i] * rates.acceleration[i];
      gross += m[i] * rates.acceleration[i].norm();
    }
    for (std::size_t i = 0; i < rates.heating.size(); ++i) {
      power += m[i] * rates.heating[i];
      gross += m[i] * std::abs(rates.heating[i]);
    }
  }
  double net() const { return force.norm() + std::abs(power); }
};

}  // namespace

template <int Dim>
std::optional<double> pair_budget(SchemeInfo const& scheme, Kernel const& kernel) {
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 1);
  Budget<Dim> const budget(scene, evaluate(scene, scheme.id, false));
  return budget.net() / budget.gross;
}

template <int Dim>
std::optional<double> energy_with_partner(SchemeInfo const& scheme, Kernel const& kernel) {
  if (scheme.rate != Rate::acceleration || scheme.work_partner.empty()) return std::nullopt;
  SchemeInfo const* const partner = find_scheme(scheme.work_partner);
  if (!partner || partner->rate != Rate::internal_work) return std::nullopt;
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 2);
  auto const a = evaluate(scene, scheme.id, false).acceleration;
  auto const heating = evaluate(scene, partner->id, false).heating;
  double net = 0.0, gross = 0.0;
  for (std::size_t i = 0; i < usual_count; ++i) {
    double const kinetic = scene.particles.masses()[i] * scene.particles.vector(Field::velocity)[i].dot(a[i]);
    double const internal = scene.particles.masses()[i] * heating[i];
    net += kinetic + internal;
    gross += std::abs(kinetic) + std::abs(internal);
  }
  return std::abs(net) / gross;
}

template <int Dim>
std::optional<double> wall_budget(SchemeInfo const& scheme, Kernel const& kernel) {
  // Where walls act through an earlier pass, or through weights, as well, pairs with walls are not pairs without.
  if (supports_seen(scheme) > 1 || scheme.least_squares) return std::nullopt;
  for (PassInfo const& pass : scheme.first_passes) {
    if (pass.normalised) return std::nullopt;
  }
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 3);
  Rates<Dim> const rates = evaluate(scene, scheme.id);
  Budget<Dim> const gained(scene, rates);
  Budget<Dim> const by_pairs(scene, evaluate(scene, scheme.id, false));
  Vector<Dim> force = Vector<Dim>::Zero();
  double power = 0.0;
  for (Vector<Dim> const& wall : rates.wall_force) force += wall;
  for (double const wall : rates.wall_power) power += wall;
  return ((gained.force - by_pairs.force - force).norm() + std::abs(gained.power - by_pairs.power - power)) / gained.gross;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                             \
  template std::optional<double> pair_budget<Dim>(SchemeInfo const&, Kernel const&);         \
  template std::optional<double> energy_with_partner<Dim>(SchemeInfo const&, Kernel const&); \
  template std::optional<double> wall_budget<Dim>(SchemeInfo const&, Kernel const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify::claims
