// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/defects.hpp"
#include "harness/claims/random_scene.hpp"

namespace sphverify::claims {

template <int Dim>
std::optional<double> covariance(SchemeInfo const& scheme, Kernel const& kernel) {
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 11);
  Random random(1);
  Rates<Dim> const before = evaluate(scene, scheme.id);
  double worst = 0.0;
  for (Matrix<Dim> const& turn : {random.rotation<Dim>(), random.reflection<Dim>()}) {
    Rates<Dim> const found = evaluate(transformed(scene, turn, random.vector<Dim>(-3.0, 3.0)), scheme.id);
    Rates<Dim> expected = before;
    for (auto* vectors : {&expected.acceleration, &expected.wall_force}) {
      for (Vector<Dim>& v : *vectors) v = turn * v;
    }
    worst = std::max({worst, relative_difference(found.acceleration, expected.acceleration),
                      relative_difference(found.heating, expected.heating),
                      relative_difference(found.wall_force, expected.wall_force),
                      relative_difference(found.wall_power, expected.wall_power)});
  }
  return worst;
}

template <int Dim>
std::optional<double> numbering(SchemeInfo const& scheme, Kernel const& kernel) {
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 14);
  RandomScene<Dim> reversed = scene;
  for (FieldInfo const& field : field_infos) {
    if (!all_fields.contains(field.field)) continue;
    for (std::size_t i = 0; i < usual_count; ++i) {
      std::size_t const j = usual_count - 1 - i;
      if (field.is_vector) {
        reversed.particles.vector(field.field).set(i, scene.particles.vector(field.field)[j]);
      } else {
        reversed.particles.scalar(field.field)[i] = scene.particles.scalar(field.field)[j];
      }
    }
  }
  Rates<Dim> found = evaluate(reversed, scheme.id);
  std::reverse(found.acceleration.begin(), found.acceleration.end());
  std::reverse(found.heating.begin(), found.heating.end());
  return relative_difference(found.numbers(), evaluate(scene, scheme.id).numbers());
}

template <int Dim>
std::optional<double> boost(SchemeInfo const& scheme, Kernel const& kernel) {
  if (!fields_read(scheme).contains(Field::velocity)) return std::nullopt;
  RandomScene<Dim> const scene = random_scene<Dim>(kernel, 15);
  Vector<Dim> const u = Random(1).vector<Dim>(0.5, 2.0);
  RandomScene<Dim> faster = scene;
  for (std::size_t i = 0; i < usual_count; ++i) faster.particles.vector(Field::velocity).add(i, u);
  for (Wall<Dim>& wall : faster.walls) {
    wall.velocity = [old = wall.velocity, u](Vector<Dim> const& x, double t) -> Vector<Dim> { return old(x, t) + u; };
  }
  return relative_difference(evaluate(faster, scheme.id).numbers(), evaluate(scene, scheme.id).numbers());
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                    \
  template std::optional<double> covariance<Dim>(SchemeInfo const&, Kernel const&); \
  template std::optional<double> numbering<Dim>(SchemeInfo const&, Kernel const&);  \
  template std::optional<double> boost<Dim>(SchemeInfo const&, Kernel const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify::claims
