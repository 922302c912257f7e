// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(scheme_inputs)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::size_t count = 40;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
void set_field(Particles<Dim>& particles, Field field, double value) {
  particles.allocate(field);
  if (info(field).is_vector) {
    for (int k = 0; k < Dim; ++k) particles.vector(field).component(k).assign(particles.size(), value);
  } else {
    particles.scalar(field).assign(particles.size(), value);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_that_are_not_declared_read_are_not_read, D, Dimensions) {
  constexpr int Dim = D::value;
  for (unsigned prescribed = 0; prescribed < 16; ++prescribed) {
    for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
      RandomScene<Dim> scene = random_scene<Dim>(1, count, subset(prescribed), subset(prescribed));
      scene.closure = closure;
      for (SchemeInfo const* scheme : all_scheme_infos()) {
        RandomScene<Dim> poisoned = scene;
        for (FieldInfo const& field : field_infos) {
          bool const read = fields_read(*scheme).contains(field.field) || field.field == Field::position ||
                            field.field == Field::mass;
          if (!read) set_field(poisoned.particles, field.field, nan);
        }
        BOOST_TEST(same_bits(evaluate(poisoned, scheme->id).numbers(), evaluate(scene, scheme->id).numbers()),
                   scheme->id);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_that_are_declared_read_matter, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(2, count);
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    auto const before = evaluate(scene, scheme->id).numbers();
    for (FieldInfo const& field : field_infos) {
      bool const always = field.field == Field::position || field.field == Field::mass;
      if (!always && !fields_read(*scheme).contains(field.field)) continue;
      if (field.field == Field::mass && scheme->least_squares) continue;  // its weights are of places alone
      if (field.field == Field::density && reads_face_offsets(*scheme)) continue;  // areas of faces are of places alone
      if (field.field == Field::position && Dim == 1 && reads_face_offsets(*scheme)) continue;  // a face on a line is 1 wherever it is
      RandomScene<Dim> changed = scene;
      if (field.field == Field::position) {
        changed.particles.positions().add(5, Vector<Dim>::Constant(1e-3));  // less than the gap to the walls
      } else if (field.is_vector) {
        for (int k = 0; k < Dim; ++k) changed.particles.vector(field.field).component(k)[5] *= 0.99;
      } else {
        changed.particles.scalar(field.field)[5] *= 0.99;
      }
      BOOST_TEST(relative_difference(evaluate(changed, scheme->id).numbers(), before) > 1e-6,
                 scheme->id << " does not read " << field.name);
    }
  }
}

template <int Dim>
void poison(Wall<Dim>& wall, BoundaryValueSet values) {
  auto const scalar = [](Vector<Dim> const&, double) { return nan; };
  auto const vector = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Constant(nan); };
  if (values.contains(BoundaryValue::pressure)) wall.pressure = scalar;
  if (values.contains(BoundaryValue::velocity)) wall.velocity = vector;
  if (values.contains(BoundaryValue::temperature)) wall.temperature = scalar;
  if (values.contains(BoundaryValue::conductivity)) wall.conductivity = scalar;
  if (values.contains(BoundaryValue::flux)) wall.flux = vector;
}

constexpr BoundaryValue boundary_values[] = {BoundaryValue::pressure, BoundaryValue::velocity,
                                             BoundaryValue::temperature, BoundaryValue::conductivity,
                                             BoundaryValue::flux};

BOOST_AUTO_TEST_CASE_TEMPLATE(wall_values_that_are_not_declared_read_are_not_read_and_those_declared_are, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(4, count, subset(15), subset(15));
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    auto const before = evaluate(scene, scheme->id).numbers();
    for (BoundaryValue const value : boundary_values) {
      RandomScene<Dim> poisoned = scene;
      poison(poisoned.walls[0], {value});
      bool const changed = !same_bits(evaluate(poisoned, scheme->id).numbers(), before);
      // These walls prescribe temperature too, so that a scheme which takes the flux only for want of it
      // takes none.
      BoundaryValueSet read = scheme->boundary;
      for (PassInfo const& pass : scheme->first_passes) read = read | pass.boundary;
      BOOST_TEST(changed == read.contains(value), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE(wall_values_that_a_scheme_reads_if_prescribed_matter_where_they_stand_alone) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    for (BoundaryValue const value : boundary_values) {
      if (!scheme->boundary_if_prescribed.contains(value)) continue;
      RandomScene<2> scene = random_scene<2>(3, count, {value}, {});
      auto const before = evaluate(scene, scheme->id).numbers();
      poison(scene.walls[0], {value});
      BOOST_TEST(!same_bits(evaluate(scene, scheme->id).numbers(), before), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rates_of_random_states_are_finite, D, Dimensions) {
  constexpr int Dim = D::value;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    for (std::size_t const particles : {1u, 2u, 3u, 4u, 50u}) {
      for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
        RandomScene<Dim> scene = random_scene<Dim>(seed, particles, subset(static_cast<unsigned>(seed)), subset(5));
        scene.face_weight = rule;
        scene.closure = seed % 2 == 0 ? Closure::interpolated : Closure::one_sided;
        for (SchemeInfo const* scheme : all_scheme_infos()) {
          // Negative weights at a wall may outweigh the neighbours that a particle has.
          if (scheme->needs_partners && (particles < 50 || rule == FaceWeight::balanced)) continue;
          Rates<Dim> const rates = evaluate(scene, scheme->id);
          BOOST_TEST(std::isfinite(largest(rates.numbers())),
                     scheme->id << " with " << particles << " particles");
          BOOST_TEST(std::isfinite(largest(rates.wall_power)), scheme->id);
          BOOST_TEST(std::isfinite(largest(rates.wall_force)), scheme->id);
        }
      }
    }
  }
}

// A particle alone, barely within reach of a wall, sees nothing but itself from its foot point.
BOOST_AUTO_TEST_CASE_TEMPLATE(rates_are_finite_at_the_edge_of_a_walls_reach, D, Dimensions) {
  constexpr int Dim = D::value;
  std::size_t failures = 0;
  std::size_t met = 0;
  Random random(5);
  for (int n = 0; n < 300; ++n) {
    RandomScene<Dim> scene = random_scene<Dim>(static_cast<std::uint64_t>(n), 1);
    double const h = scene.particles.smoothing_length();
    scene.walls.pop_back();
    Vector<Dim> const normal = scene.walls[0].outward_normal;
    scene.walls[0].point = scene.particles.positions()[0] +
                           2.0 * h * (1.0 - std::pow(10.0, random.uniform(-16.0, -8.0))) * normal;
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->needs_partners) continue;
      ++met;
      failures += std::isfinite(largest(evaluate(scene, scheme->id).numbers())) ? 0 : 1;
    }
  }
  BOOST_TEST(failures == 0u, failures << " of " << met << " are not finite");
}

// There A_i and rho_B vanish together, and the wall's force with their quotient (in 1D it stays constant).
BOOST_AUTO_TEST_CASE_TEMPLATE(particle_that_enters_a_walls_reach_alone_is_not_kicked, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact}) {
    RandomScene<Dim> scene = random_scene<Dim>(1, 1);
    scene.face_weight = rule;
    scene.walls.pop_back();
    Wall<Dim>& wall = scene.walls[0];
    auto const approach = [&](double gap) {
      wall.point = scene.particles.positions()[0] +
                   (2.0 - gap) * scene.particles.smoothing_length() * wall.outward_normal;
    };
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->needs_partners) continue;
      approach(0.1);
      double const inside = largest(evaluate(scene, scheme->id).numbers());
      for (double gap = 0.05; gap > 1e-13; gap *= 0.5) {
        approach(gap);
        double const found = largest(evaluate(scene, scheme->id).numbers());
        BOOST_TEST(found <= 2.0 * inside,
                   scheme->id << " at 2h - d = " << gap << " h: " << found << ", at 0.1 h " << inside);
        if (found > 2.0 * inside) break;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particle_without_neighbours_or_walls_has_rate_zero, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(1, 1);
  for (bool const far_walls : {false, true}) {
    for (Wall<Dim>& wall : scene.walls) wall.point += 10.0 * wall.outward_normal;
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->needs_partners) {
        BOOST_CHECK_THROW(evaluate(scene, scheme->id, far_walls), TooFewPartners);
        continue;
      }
      Rates<Dim> const rates = evaluate(scene, scheme->id, far_walls);
      BOOST_TEST(largest(rates.numbers()) == 0.0, scheme->id);
      BOOST_TEST(largest(rates.flux) == 0.0, scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(negative_values_are_refused_by_name_or_give_finite_rates, D, Dimensions) {
  constexpr int Dim = D::value;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    auto const names = [&](std::string const& what) {
      return [&scheme, what](UndefinedRate const& problem) {
        std::string const message = problem.what();
        return message.find(scheme->id) != std::string::npos && message.find(what) != std::string::npos;
      };
    };
    RandomScene<Dim> const scene = random_scene<Dim>(6, count);
    RandomScene<Dim> inside = scene;
    inside.particles.scalar(Field::pressure)[17] = -1e-9;
    RandomScene<Dim> first = scene;
    first.particles.scalar(Field::pressure)[0] = -1e-9;
    RandomScene<Dim> at_wall = scene;
    at_wall.walls[1].pressure = [](Vector<Dim> const&, double) { return -1e-9; };
    RandomScene<Dim> empty = scene;
    empty.particles.scalar(Field::pressure)[17] = 0.0;
    BOOST_CHECK_NO_THROW(evaluate(empty, scheme->id));
    if (scheme->non_negative.contains(Field::pressure)) {
      BOOST_CHECK_EXCEPTION(evaluate(inside, scheme->id), UndefinedRate, names("particle 17"));
      BOOST_CHECK_EXCEPTION(evaluate(first, scheme->id), UndefinedRate, names("particle 0"));
      BOOST_CHECK_EXCEPTION(evaluate(at_wall, scheme->id), UndefinedRate, names("wall 1"));
      BOOST_CHECK_NO_THROW(evaluate(at_wall, scheme->id, false));
    } else {
      BOOST_TEST(std::isfinite(largest(evaluate(inside, scheme->id).numbers())), scheme->id);
      BOOST_TEST(std::isfinite(largest(evaluate(at_wall, scheme->id).numbers())), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
