// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/random_particles.hpp"

// Rates do not depend on the units. Powers of four change no digit of a number nor of its square root, so
// that the results must agree bit for bit.
BOOST_AUTO_TEST_SUITE(scheme_units)

using namespace sphverify;
using namespace sphverify::tests;

struct Units {
  double length, mass, time, temperature;
};

template <int Dim>
double scale(Field field, Units const& u) {
  double const volume = std::pow(u.length, Dim);
  double const speed = u.length / u.time;
  switch (field) {
    case Field::position:
      return u.length;
    case Field::mass:
      return u.mass;
    case Field::density:
      return u.mass / volume;
    case Field::velocity:
      return speed;
    case Field::pressure:
      return u.mass / volume * speed * speed;
    case Field::internal_energy:
      return speed * speed;
    case Field::temperature:
      return u.temperature;
    case Field::conductivity:
      return u.mass / volume * speed * speed * speed * u.length / u.temperature;
    case Field::flux:
      return u.mass / volume * speed * speed * speed;
    case Field::acceleration:
      return speed / u.time;
    case Field::heating:
      return speed * speed / u.time;
    case Field::sound_speed:
      return speed;
    case Field::density_rate:
      return u.mass / volume / u.time;
  }
  return 1.0;
}

template <int Dim>
RandomScene<Dim> in_units(RandomScene<Dim> const& scene, Units const& u) {
  std::size_t const n = scene.particles.size();
  RandomScene<Dim> scaled{.particles = Particles<Dim>(n, u.length * scene.particles.smoothing_length()),
                    .domain = scene.domain,
                    .walls = scene.walls,
                    .face_weight = scene.face_weight,
                    .closure = scene.closure,
                    .time = u.time * scene.time};
  scaled.particles.set_kernel(scene.particles.kernel());
  scaled.domain.lower *= u.length;
  scaled.domain.upper *= u.length;
  scaled.particles.allocate(all_fields);
  for (FieldInfo const& field : field_infos) {
    if (!scene.particles.has(field.field)) continue;
    double const factor = scale<Dim>(field.field, u);
    for (std::size_t i = 0; i < n; ++i) {
      if (field.is_vector) {
        scaled.particles.vector(field.field).set(i, factor * scene.particles.vector(field.field)[i]);
      } else {
        scaled.particles.scalar(field.field)[i] = factor * scene.particles.scalar(field.field)[i];
      }
    }
  }
  scaled.enclosure = scene.enclosure;
  for (Wall<Dim>& side : scaled.enclosure) side.point *= u.length;
  for (Wall<Dim>& wall : scaled.walls) {
    wall.point *= u.length;
    auto const scalar = [&u](ScalarAtWall<Dim>& value, double factor) {
      if (!value) return;
      value = [old = value, factor, u](Vector<Dim> const& x, double t) {
        return factor * old(x / u.length, t / u.time);
      };
    };
    auto const vector = [&u](VectorAtWall<Dim>& value, double factor) {
      if (!value) return;
      value = [old = value, factor, u](Vector<Dim> const& x, double t) -> Vector<Dim> {
        return factor * old(x / u.length, t / u.time);
      };
    };
    scalar(wall.pressure, scale<Dim>(Field::pressure, u));
    scalar(wall.temperature, scale<Dim>(Field::temperature, u));
    scalar(wall.conductivity, scale<Dim>(Field::conductivity, u));
    vector(wall.velocity, scale<Dim>(Field::velocity, u));
    vector(wall.flux, scale<Dim>(Field::flux, u));
  }
  return scaled;
}

/// Cells in 3D are cut out of a box whose size is a cube root, which does change digits: of them no bits are asked.
template <int Dim>
bool agree(SchemeInfo const& scheme, std::vector<double> const& found, std::vector<double> const& expected) {
  return Dim == 3 && reads_face_offsets(scheme) ? relative_difference(found, expected) < 1e-12 : same_bits(found, expected);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rates_scale_with_their_units_with_every_kernel, D, Dimensions) {
  constexpr int Dim = D::value;
  Units const units{1.0 / 64.0, 4.0, 16.0, 0.25};
  for (KernelInfo const& of : all_kernel_infos()) {
    RandomScene<Dim> const scene = random_scene<Dim>(kernel(of.id, Dim), 2);
    RandomScene<Dim> const scaled = in_units(scene, units);
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      std::vector<double> expected = evaluate(scene, scheme->id).numbers();
      for (double& rate : expected) rate *= scale<Dim>(output_field(scheme->rate), units);
      BOOST_TEST(agree<Dim>(*scheme, evaluate(scaled, scheme->id).numbers(), expected), scheme->id << ", " << of.id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rates_scale_with_their_units_bit_for_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Units const& units :
       {Units{4.0, 1.0, 1.0, 1.0}, Units{1.0, 16.0, 1.0, 1.0}, Units{1.0, 1.0, 0.25, 1.0},
        Units{1.0, 1.0, 1.0, 64.0}, Units{1.0 / 64.0, 4.0, 16.0, 0.25}}) {
    for (unsigned prescribed : {0u, 7u, 8u, 15u}) {
      for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
        RandomScene<Dim> scene = random_scene<Dim>(1, 50, subset(prescribed), subset(7));
        scene.face_weight = rule;
        scene.closure = prescribed == 8u ? Closure::one_sided : Closure::interpolated;
        RandomScene<Dim> const scaled = in_units(scene, units);
        for (SchemeInfo const* scheme : all_scheme_infos()) {
          std::vector<double> expected = evaluate(scene, scheme->id).numbers();
          for (double& rate : expected) rate *= scale<Dim>(output_field(scheme->rate), units);
          BOOST_TEST(agree<Dim>(*scheme, evaluate(scaled, scheme->id).numbers(), expected), scheme->id);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
