// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/defects.hpp"
#include "harness/claims/random_scene.hpp"

namespace sphverify::claims {

namespace {

/// Two particles at some distance, unlike in everything, without walls.
template <int Dim>
RandomScene<Dim> two_at(Kernel const& kernel, double distance) {
  Random random(7);
  RandomScene<Dim> scene{.particles = Particles<Dim>(2, 1.0),
                         .domain = {.lower = Vector<Dim>::Constant(-5.0), .upper = Vector<Dim>::Constant(5.0)}};
  scene.particles.set_kernel(kernel);
  randomise_fields(scene.particles, random);
  Vector<Dim> const direction = random.direction<Dim>();
  for (std::size_t i = 0; i < 2; ++i) scene.particles.positions().set(i, (i == 0 ? -0.5 : 0.5) * distance * direction);
  return scene;
}

template <int Dim>
double largest_rate(SchemeInfo const& scheme, RandomScene<Dim> const& scene) {
  return largest(evaluate(scene, scheme.id).numbers());
}

}  // namespace

template <int Dim>
std::optional<double> at_the_support(SchemeInfo const& scheme, Kernel const& kernel) {
  // What is divided by a sum over neighbours, as a renormalised form is, has no limit where only one is left.
  if (scheme.claims.lattice_factors == 0) return std::nullopt;
  double const edge = kernel.support_ratio();
  double const inside = largest_rate<Dim>(scheme, two_at<Dim>(kernel, 0.5 * edge));
  double const beyond = largest_rate<Dim>(scheme, two_at<Dim>(kernel, edge * (1.0 + 1e-9)));
  double const last = largest_rate<Dim>(scheme, two_at<Dim>(kernel, edge * (1.0 - 1e-6)));
  return std::abs(last - beyond) / inside;
}

template <int Dim>
std::optional<double> conductivity_mean(SchemeInfo const& scheme, Kernel const& kernel) {
  if (scheme.needs_partners || scheme.rate != Rate::conduction_heating || scheme.claims.mean == ConductivityMean::unknown) return std::nullopt;
  auto const exchanged = [&](double first, double second) {
    RandomScene<Dim> scene = two_at<Dim>(kernel, 0.5);
    scene.particles.scalar(Field::conductivity) = {first, second};
    return evaluate(scene, scheme.id).heating[0];
  };
  double worst = 0.0;
  for (double const second : {0.01, 3.0}) {
    double const mean = scheme.claims.mean == ConductivityMean::arithmetic ? 0.5 * (1.0 + second)
                        : scheme.claims.mean == ConductivityMean::harmonic ? 2.0 * second / (1.0 + second)
                                                                           : std::sqrt(second);
    double const defect = std::abs(exchanged(1.0, second) / exchanged(1.0, 1.0) / mean - 1.0);
    worst = std::isnan(defect) ? INFINITY : std::max(worst, defect);
  }
  return worst;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                        \
  template std::optional<double> at_the_support<Dim>(SchemeInfo const&, Kernel const&); \
  template std::optional<double> conductivity_mean<Dim>(SchemeInfo const&, Kernel const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify::claims
