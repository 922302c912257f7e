// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/particles/particles.hpp"

#include <boost/test/unit_test.hpp>
#include <set>
#include <string_view>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_particles_particles)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE_TEMPLATE(only_position_and_mass_exist_until_more_is_asked_for, D, Dimensions) {
  constexpr int Dim = D::value;
  Particles<Dim> particles(100, 0.1);
  for (FieldInfo const& field : field_infos) {
    bool const always = field.field == Field::position || field.field == Field::mass;
    BOOST_TEST(particles.has(field.field) == always, field.name);
  }
  BOOST_TEST(particles.size() == 100u);
  BOOST_TEST(particles.smoothing_length() == 0.1);
  BOOST_TEST(particles.bytes() == (Dim + 1) * 100 * sizeof(double));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(each_field_costs_its_own_memory_only, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FieldInfo const& field : field_infos) {
    Particles<Dim> particles(100, 0.1);
    std::size_t const before = particles.bytes();
    bool const existed = particles.has(field.field);
    particles.allocate(field.field);
    std::size_t const cost = existed ? 0 : static_cast<std::size_t>(field.components(Dim)) * 100 * sizeof(double);
    BOOST_TEST(particles.bytes() == before + cost, field.name);
    for (FieldInfo const& other : field_infos) {
      bool const expected =
          other.field == field.field || other.field == Field::position || other.field == Field::mass;
      BOOST_TEST(particles.has(other.field) == expected, other.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(new_fields_are_zero_and_allocating_again_keeps_their_values) {
  Particles<2> particles(3, 0.1);
  particles.allocate({Field::pressure, Field::velocity});
  BOOST_TEST(particles.scalar(Field::pressure)[2] == 0.0);
  BOOST_TEST(particles.vector(Field::velocity)[2].norm() == 0.0);
  particles.scalar(Field::pressure)[2] = 5.0;
  particles.vector(Field::velocity).set(2, {1.0, 2.0});
  particles.allocate({Field::pressure, Field::velocity, Field::density});
  BOOST_TEST(particles.scalar(Field::pressure)[2] == 5.0);
  BOOST_TEST(particles.vector(Field::velocity)[2][1] == 2.0);
}

BOOST_AUTO_TEST_CASE(tensor_field_sets_and_adds_one_particle) {
  TensorField<3> field(4);
  Tensor<3> first, second;
  first << 1.0, 2.0, 3.0, 2.0, 4.0, 5.0, 3.0, 5.0, 6.0;
  second << 0.5, 0.25, -1.0, 0.25, 0.0, 2.0, -1.0, 2.0, -3.0;
  field.set(2, first);
  field.add(2, second);
  BOOST_TEST((field[2] - first - second).norm() == 0.0);
  BOOST_TEST(field[1].norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(vector_field_sets_and_adds_one_particle) {
  VectorField<3> field(4);
  field.set(2, {1.0, 2.0, 3.0});
  field.add(2, {0.5, 0.0, -1.0});
  BOOST_TEST((field[2] - Vector<3>(1.5, 2.0, 2.0)).norm() == 0.0);
  BOOST_TEST(field[1].norm() == 0.0);
  BOOST_TEST(field.component(2)[2] == 2.0);
  BOOST_TEST(field.size() == 4u);
}

BOOST_AUTO_TEST_CASE(every_field_finds_its_own_description) {
  std::set<std::string_view> names;
  for (FieldInfo const& field : field_infos) {
    BOOST_TEST((info(field.field).field == field.field));
    BOOST_TEST(!field.unit.empty());
    names.insert(field.name);
  }
  BOOST_TEST(names.size() == field_infos.size());
}

BOOST_AUTO_TEST_SUITE_END()
