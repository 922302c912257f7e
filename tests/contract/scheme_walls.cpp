// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "formulations/kernels/kernel.hpp"
#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(scheme_walls)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::size_t count = 60;

BOOST_AUTO_TEST_CASE_TEMPLATE(without_contacts_the_walls_are_not_felt, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& of : all_kernel_infos()) {
    RandomScene<Dim> const scene = random_scene<Dim>(kernel(of.id, Dim), 1);
    RandomScene<Dim> open = scene;
    open.walls.clear();
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      Rates<Dim> const control = evaluate(scene, scheme->id, false);
      // Cells end at walls that push nothing, too.
      BOOST_TEST((reads_face_offsets(*scheme) || same_bits(control.numbers(), evaluate(open, scheme->id).numbers())),
                 scheme->id << ", " << of.id);
      BOOST_TEST(control.work.wall_interactions == 0u);
      BOOST_TEST(control.wall_force.empty());
      BOOST_TEST(control.wall_power.empty());
      BOOST_TEST(relative_difference(evaluate(scene, scheme->id).numbers(), control.numbers()) > 1e-2,
                 scheme->id << ", " << of.id);
    }
  }
}

/// Particles that a wall's term can reach: in contact with it, or of a two-pass form beside one that is.
template <int Dim>
std::vector<bool> within_reach_of_walls(RandomScene<Dim> const& scene, bool two_pass) {
  PairGeometry<Dim> const geometry = geometry_of(scene);
  std::vector<bool> touched(count, false);
  for (auto const& contacts : geometry.contacts) {
    for (std::uint32_t const i : contacts.particle) touched[i] = true;
  }
  std::vector<bool> reached = touched;
  for (std::uint32_t i = 0; two_pass && i < count; ++i) {
    for (std::uint32_t const j : geometry.neighbours.row(i)) {
      if (touched[j]) reached[i] = true;
    }
  }
  return reached;
}

BOOST_AUTO_TEST_CASE(walls_reach_as_far_as_the_kernel_and_twice_that_in_two_passes) {
  for (KernelInfo const& of : all_kernel_infos()) {
    RandomScene<1> const narrow = random_scene<1>(kernel(of.id, 1), 1);
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (reads_face_offsets(*scheme)) continue;  // a wall is felt by the cells that end there
      RandomScene<1> const scene = scheme->needs_partners ? widened(narrow) : narrow;
      auto const with = evaluate(scene, scheme->id, geometry_of(scene)).numbers();
      auto const without = evaluate(scene, scheme->id, geometry_of(scene, false)).numbers();
      std::vector<bool> const reached = within_reach_of_walls(scene, supports_seen(*scheme) > 1);
      std::vector<bool> const near = within_reach_of_walls(scene, false);
      std::size_t untouched = 0;
      for (std::size_t i = 0; i < count; ++i) {
        bool const is_felt = with[i] != without[i];
        // Towards the edge of two wide supports what is felt may be less than rounding, as 1 - Gamma is towards that of one.
        bool const fades = scheme->needs_partners || std::any_of(scheme->first_passes.begin(), scheme->first_passes.end(),
                                                                 [](PassInfo const& pass) { return pass.normalised; });
        bool const is_right = fades ? (reached[i] || !is_felt) && (is_felt || !near[i]) : is_felt == reached[i];
        BOOST_TEST(is_right, scheme->id << ", " << of.id << ", particle " << i);
        untouched += reached[i] ? 0 : 1;
      }
      BOOST_TEST(untouched > 0u);
    }
  }
}

/// The scheme's rates where one of the walls is not felt. It still bounds the other's face.
template <int Dim>
Rates<Dim> without_contacts(RandomScene<Dim> scene, std::string_view id, std::size_t wall) {
  PairGeometry<Dim> geometry = geometry_for(id, scene);
  geometry.contacts.erase(geometry.contacts.begin() + static_cast<std::ptrdiff_t>(wall));
  geometry.walls.erase(geometry.walls.begin() + static_cast<std::ptrdiff_t>(wall));
  return evaluate(scene, id, geometry);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(wall_totals_are_the_sum_over_particles_of_what_each_wall_adds, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& of : all_kernel_infos()) {
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      // There walls act through the first pass, or through pairs' weights, as well.
      if (pass_count(*scheme) > 1 || scheme->least_squares) continue;
      RandomScene<Dim> const scene = random_scene<Dim>(kernel(of.id, Dim), 2);
      Rates<Dim> const both = evaluate(scene, scheme->id);
      for (std::size_t w = 0; w < 2; ++w) {
        Rates<Dim> const other = without_contacts(scene, scheme->id, w);
        double power = 0.0;
        Vector<Dim> force = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < count; ++i) {
          double const m = scene.particles.masses()[i];
          if (scheme->rate == Rate::acceleration)
            force += m * (both.acceleration[i] - other.acceleration[i]);
          else
            power += m * (both.heating[i] - other.heating[i]);
        }
        if (scheme->rate == Rate::acceleration) {
          BOOST_TEST((force - both.wall_force[w]).norm() < 1e-11 * largest(both.wall_force), scheme->id << ", " << of.id);
        } else {
          BOOST_TEST(std::abs(power - both.wall_power[w]) < 1e-11 * largest(both.wall_power), scheme->id << ", " << of.id);
        }
      }
    }
  }
}

/// Scenes in which heating is linear in temperature and in conductivity: no flux is prescribed.
template <int Dim>
std::vector<RandomScene<Dim>> without_prescribed_flux() {
  std::vector<RandomScene<Dim>> list;
  for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
    list.push_back(random_scene<Dim>(3, count));
    list.back().closure = closure;
    list.push_back(random_scene<Dim>(4, count, no_flux, {}));
    list.back().closure = closure;
  }
  return list;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(twice_the_conductivity_gives_twice_the_heating, D, Dimensions) {
  constexpr int Dim = D::value;
  for (RandomScene<Dim> const& scene : without_prescribed_flux<Dim>()) {
    RandomScene<Dim> twice = scene;
    for (double& K : twice.particles.scalar(Field::conductivity)) K *= 2.0;
    for (Wall<Dim>& wall : twice.walls) {
      if (!wall.conductivity) continue;
      wall.conductivity = [old = wall.conductivity](Vector<Dim> const& x, double t) {
        return 2.0 * old(x, t);
      };
    }
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->rate != Rate::conduction_heating) continue;
      std::vector<double> expected = evaluate(scene, scheme->id).heating;
      for (double& rate : expected) rate *= 2.0;
      BOOST_TEST(same_bits(evaluate(twice, scheme->id).heating, expected), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(twice_the_temperature_gives_twice_the_heating, D, Dimensions) {
  constexpr int Dim = D::value;
  for (RandomScene<Dim> const& scene : without_prescribed_flux<Dim>()) {
    RandomScene<Dim> twice = scene;
    for (double& T : twice.particles.scalar(Field::temperature)) T *= 2.0;
    for (Wall<Dim>& wall : twice.walls) {
      if (!wall.temperature) continue;
      wall.temperature = [old = wall.temperature](Vector<Dim> const& x, double t) { return 2.0 * old(x, t); };
    }
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->rate != Rate::conduction_heating) continue;
      std::vector<double> expected = evaluate(scene, scheme->id).heating;
      for (double& rate : expected) rate *= 2.0;
      BOOST_TEST(same_bits(evaluate(twice, scheme->id).heating, expected), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(hot_wall_heats_and_high_pressure_pushes_inwards, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 3 ? 9 : 12, 0.1, 1.2);
  std::size_t const n = scene.particles.size();
  for (Field const field : {Field::pressure, Field::temperature, Field::conductivity}) {
    scene.particles.scalar(field).assign(n, 1.0);
  }
  Vector<Dim> const normal = Vector<Dim>::Unit(0);
  scene.walls.push_back({.point = scene.domain.upper, .outward_normal = normal});
  Wall<Dim>& wall = scene.walls[0];
  auto const set = [&wall, &normal](double value, double speed) {
    wall.pressure = [value](Vector<Dim> const&, double) { return value; };
    wall.temperature = wall.pressure;
    wall.conductivity = [](Vector<Dim> const&, double) { return 1.0; };
    wall.velocity = [speed, normal](Vector<Dim> const&, double) -> Vector<Dim> { return speed * normal; };
  };
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->needs_partners) continue;  // their wall terms are no flux
    // A wall that advances compresses. The two-pass forms feel the temperature through the particles' fluxes.
    set(1.0, 0.0);
    auto const neutral = evaluate(scene, scheme->id);
    set(3.0, -1.0);
    auto const driven = evaluate(scene, scheme->id);
    if (scheme->rate == Rate::acceleration) {
      BOOST_TEST(driven.wall_force[0].dot(normal) < neutral.wall_force[0].dot(normal), scheme->id);
    } else {
      BOOST_TEST(driven.wall_power[0] > neutral.wall_power[0], scheme->id);
    }
  }
}

/// A wall's terms are along its normal: what the missing half of the kernel takes from a gradient along the
/// wall they do not give back.
BOOST_AUTO_TEST_CASE_TEMPLATE(along_a_wall_a_gradient_is_felt_by_the_part_of_the_kernel_inside, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  if constexpr (Dim > 1) {
    constexpr double spacing = 0.1;
    constexpr double ratio = 2.4;
    constexpr double slope = 1e-4;  // so small that the root of pressure is linear too
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->rate != Rate::acceleration) continue;
      int const side = 2 * static_cast<int>(std::ceil(2.0 * ratio * supports_seen(*scheme))) + 2;
      RandomScene<Dim> scene = lattice_scene<Dim>(side, spacing, ratio);
      Particles<Dim>& p = scene.particles;
      Wall<Dim> wall;
      wall.point = scene.domain.lower;
      wall.outward_normal = -Vector<Dim>::Unit(0);
      wall.pressure = [](Vector<Dim> const& x, double) { return 0.9 + slope * x[1]; };
      scene.walls = {wall};
      for (std::size_t i = 0; i < p.size(); ++i)
        p.scalar(Field::pressure)[i] = 0.9 + slope * p.positions()[i][1];
      Rates<Dim> const rates = evaluate(scene, scheme->id, geometry_for(scheme->id, scene));
      for (std::size_t i = 0; i < p.size(); ++i) {
        Vector<Dim> const across = p.positions()[i] - p.positions()[i][0] * Vector<Dim>::Unit(0);
        if (across.template lpNorm<Eigen::Infinity>() > 0.6 * spacing) continue;  // the middle sees no edge
        double const d = wall.distance(p.positions()[i]);
        if (d > 0.5 * spacing * side) continue;
        double const inside = reads_face_offsets(*scheme) ? 1.0 : default_kernel(Dim).inner_fraction(d, ratio * spacing);
        BOOST_TEST(rates.acceleration[i][1] == -slope * inside, boost::test_tools::tolerance(0.02));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
