// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/support/turned.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/support/boxes.hpp"
#include "formulations/layouts/layout.hpp"

BOOST_AUTO_TEST_SUITE(cases_support_turned)

using namespace sphverify;

/// A problem in which every function is there, differs from all others, and depends on every coordinate, so
/// that none can be left out, mixed up or turned the wrong way.
template <int Dim>
struct Everything {
  static double wave(Vector<Dim> const& x, double t, double seed) {
    double phase = seed + t;
    for (int k = 0; k < Dim; ++k) phase += (k + 1.0 + 0.1 * seed) * x[k];
    return std::sin(phase);
  }
  static ScalarFunction<Dim> scalar(double seed) {
    return [seed](Vector<Dim> const& x, double t) { return wave(x, t, seed); };
  }
  static VectorFunction<Dim> vector(double seed) {
    return [seed](Vector<Dim> const& x, double t) {
      Vector<Dim> v;
      for (int k = 0; k < Dim; ++k) v[k] = wave(x, t, seed + 0.1 * (k + 1));
      return v;
    };
  }
  static Problem<Dim> problem() {
    Problem<Dim> p;
    p.domain = slab<Dim>(-0.5, 1.5, 0.75);
    p.walls = slab_walls(p.domain);
    double seed = 1.0;
    for (Wall<Dim>& wall : p.walls) {
      for (auto* f : {&wall.pressure, &wall.temperature, &wall.conductivity}) *f = scalar(seed++);
      for (auto* f : {&wall.velocity, &wall.flux}) *f = vector(seed++);
      wall.path = [start = wall.point, seed](double t) -> Vector<Dim> {
        return start + t * vector(seed)(start, t);
      };
      seed++;
    }
    for (Field const field : {Field::density, Field::temperature, Field::pressure})
      p.scalars[field] = scalar(seed++);
    for (Field const field : {Field::velocity, Field::flux}) p.vectors[field] = vector(seed++);
    p.conductivity = scalar(seed++);
    p.source = scalar(seed++);
    p.body_force = vector(seed++);
    p.acceleration = vector(seed++);
    for (Rate const rate : {Rate::internal_work, Rate::conduction_heating}) p.heating[rate] = scalar(seed++);
    p.holds = [seed](Vector<Dim> const& x, double t) { return wave(x, t, seed) > 0.0; };
    p.point_energy = typename Problem<Dim>::PointEnergy{Vector<Dim>::LinSpaced(0.2, 0.7), 3.0};
    p.landmarks["front"] = [](double t) { return 2.0 * t; };
    p.final_time = 0.25;
    p.gamma = 1.4;
    p.accuracy = 1e-12;
    p.conductivity_depends_on_temperature = true;
    return p;
  }
};

template <class Check>
void in_two_and_three_dimensions(Check const& check) {
  for (double const degrees : {30.0, -71.0}) {
    BOOST_TEST_CONTEXT("2D by " << degrees) { check.template operator()<2>(turned_axes<2>(degrees)); }
    BOOST_TEST_CONTEXT("3D by " << degrees) { check.template operator()<3>(turned_axes<3>(degrees)); }
  }
}

template <int Dim>
void check_scalar(ScalarFunction<Dim> const& found, ScalarFunction<Dim> const& old, Vector<Dim> const& x,
                  Vector<Dim> const& turned_x) {
  BOOST_TEST(std::abs(found(turned_x, 0.3) - old(x, 0.3)) < 1e-14);
}

template <int Dim>
void check_vector(VectorFunction<Dim> const& found, VectorFunction<Dim> const& old,
                  typename Domain<Dim>::Axes const& R, Vector<Dim> const& x, Vector<Dim> const& turned_x) {
  BOOST_TEST((found(turned_x, 0.3) - R * old(x, 0.3)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(axes_are_turned_about_the_third_then_the_first_and_none_stays) {
  double const c = std::sqrt(0.75);
  BOOST_TEST((turned_axes<2>(30.0).col(0) - Vector<2>(c, 0.5)).norm() < 1e-15);
  BOOST_TEST((turned_axes<2>(30.0).col(1) - Vector<2>(-0.5, c)).norm() < 1e-15);
  auto const R = turned_axes<3>(30.0);
  BOOST_TEST((R.col(0) - Vector<3>(c, 0.5 * c, 0.25)).norm() < 1e-15);
  BOOST_TEST((R.col(1) - Vector<3>(-0.5, 0.75, 0.5 * c)).norm() < 1e-15);
  BOOST_TEST((R.col(2) - Vector<3>(0.0, -0.5, c)).norm() < 1e-15);
  BOOST_TEST((R.transpose() * R - Domain<3>::Axes::Identity()).norm() < 1e-15);
  BOOST_TEST(std::abs(R.determinant() - 1.0) < 1e-15);
  BOOST_TEST((turned_axes<3>(0.0) - Domain<3>::Axes::Identity()).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(fields_and_what_drives_the_scene_are_turned_along) {
  in_two_and_three_dimensions([]<int Dim>(typename Domain<Dim>::Axes const& R) {
    Problem<Dim> const old = Everything<Dim>::problem();
    Problem<Dim> const found = turned(old, R);
    VectorField<Dim> const places = jittered(old.domain, 5, 0.3, 3).positions;
    bool holds_somewhere = false;
    bool holds_everywhere = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      Vector<Dim> const x = places[i];
      Vector<Dim> const y = R * x;
      for (auto const& [field, f] : old.scalars) check_scalar<Dim>(found.scalars.at(field), f, x, y);
      for (auto const& [field, f] : old.vectors) check_vector<Dim>(found.vectors.at(field), f, R, x, y);
      for (auto const& [rate, f] : old.heating) check_scalar<Dim>(found.heating.at(rate), f, x, y);
      check_scalar<Dim>(found.conductivity, old.conductivity, x, y);
      check_scalar<Dim>(found.source, old.source, x, y);
      check_vector<Dim>(found.body_force, old.body_force, R, x, y);
      check_vector<Dim>(found.acceleration, old.acceleration, R, x, y);
      BOOST_TEST(found.holds(y, 0.3) == old.holds(x, 0.3));
      holds_somewhere = holds_somewhere || old.holds(x, 0.3);
      holds_everywhere = holds_everywhere && old.holds(x, 0.3);
    }
    BOOST_TEST((holds_somewhere && !holds_everywhere));
    BOOST_TEST((found.point_energy->place - R * old.point_energy->place).norm() < 1e-15);
    BOOST_TEST(found.point_energy->energy == old.point_energy->energy);
  });
}

BOOST_AUTO_TEST_CASE(walls_keep_their_distances_and_what_they_prescribe) {
  in_two_and_three_dimensions([]<int Dim>(typename Domain<Dim>::Axes const& R) {
    Problem<Dim> const old = Everything<Dim>::problem();
    Problem<Dim> const found = turned(old, R);
    auto const on_the_box = slab_walls(found.domain);
    BOOST_TEST_REQUIRE(found.walls.size() == old.walls.size());
    VectorField<Dim> const places = jittered(old.domain, 5, 0.3, 3).positions;
    for (std::size_t w = 0; w < old.walls.size(); ++w) {
      Wall<Dim> const& was = old.walls[w];
      Wall<Dim> const& is = found.walls[w];
      BOOST_TEST((is.point - on_the_box[w].point).norm() < 1e-15);
      BOOST_TEST((is.outward_normal - on_the_box[w].outward_normal).norm() < 1e-15);
      BOOST_TEST((is.path(0.3) - R * was.path(0.3)).norm() < 1e-15);
      for (std::size_t i = 0; i < places.size(); ++i) {
        Vector<Dim> const x = places[i];
        Vector<Dim> const y = R * x;
        BOOST_TEST(std::abs(is.distance(y) - was.distance(x)) < 1e-15);
        BOOST_TEST((is.foot(y) - R * was.foot(x)).norm() < 2e-15);
        check_scalar<Dim>(is.pressure, was.pressure, x, y);
        check_scalar<Dim>(is.temperature, was.temperature, x, y);
        check_scalar<Dim>(is.conductivity, was.conductivity, x, y);
        check_vector<Dim>(is.velocity, was.velocity, R, x, y);
        check_vector<Dim>(is.flux, was.flux, R, x, y);
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(the_domain_keeps_its_coordinates_along_its_own_turned_axes) {
  in_two_and_three_dimensions([]<int Dim>(typename Domain<Dim>::Axes const& R) {
    Problem<Dim> const old = Everything<Dim>::problem();
    Problem<Dim> const found = turned(old, R);
    BOOST_TEST((found.domain.lower == old.domain.lower && found.domain.upper == old.domain.upper));
    BOOST_TEST((found.domain.periodic == old.domain.periodic));
    BOOST_TEST((found.domain.axes - R).norm() < 1e-15);
    VectorField<Dim> const was = jittered(old.domain, 5, 0.3, 3).positions;
    VectorField<Dim> const is = jittered(found.domain, 5, 0.3, 3).positions;
    for (std::size_t i = 0; i < was.size(); ++i) BOOST_TEST((is[i] - R * was[i]).norm() < 2e-15);
    // Turning twice is turning by both.
    BOOST_TEST((turned(found, R).domain.axes - R * R).norm() < 1e-15);
  });
}

BOOST_AUTO_TEST_CASE(numbers_stay_and_what_is_not_there_stays_away) {
  Problem<2> const old = Everything<2>::problem();
  Problem<2> const found = turned(old, turned_axes<2>(30.0));
  BOOST_TEST(found.final_time == old.final_time);
  BOOST_TEST(found.gamma == old.gamma);
  BOOST_TEST(found.accuracy >= old.accuracy);
  BOOST_TEST(found.conductivity_depends_on_temperature);
  BOOST_TEST(found.landmarks.at("front")(0.1) == old.landmarks.at("front")(0.1));
  Problem<2> bare;
  bare.domain = slab<2>(0.0, 1.0);
  bare.walls = slab_walls(bare.domain);
  Problem<2> const empty = turned(bare, turned_axes<2>(30.0));
  BOOST_TEST(
      (!empty.conductivity && !empty.source && !empty.body_force && !empty.acceleration && !empty.holds));
  BOOST_TEST(!empty.point_energy.has_value());
  for (Wall<2> const& wall : empty.walls) {
    BOOST_TEST((!wall.pressure && !wall.velocity && !wall.temperature && !wall.conductivity && !wall.flux &&
                !wall.path));
  }
}

BOOST_AUTO_TEST_SUITE_END()
