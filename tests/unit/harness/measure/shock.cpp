// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/shock.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

BOOST_AUTO_TEST_SUITE(harness_measure_shock)

using namespace sphverify;
using boost::test_tools::tolerance;

struct State {
  double density, velocity, pressure;
};

/// Particles at the given places, of a mass of their own, with what a function of place says.
Particles<1> particles_at(std::vector<double> const& places, std::function<State(double x)> const& state) {
  Particles<1> particles(places.size(), 0.1);
  particles.allocate({Field::density, Field::velocity, Field::pressure});
  for (std::size_t i = 0; i < places.size(); ++i) {
    State const s = state(places[i]);
    particles.positions().set(i, Vector<1>(places[i]));
    particles.masses()[i] = 0.01 * s.density;
    particles.scalar(Field::density)[i] = s.density;
    particles.vector(Field::velocity).set(i, Vector<1>(s.velocity));
    particles.scalar(Field::pressure)[i] = s.pressure;
  }
  return particles;
}

std::vector<double> cell_centres(int n) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back((i + 0.5) / n);
  return x;
}

/// A shock that runs to the right, with its plateau from 0.2 to 0.6.
ShockFront const front{.position = 0.6,
                       .pressure_ahead = 0.5,
                       .plateau_lower = 0.2,
                       .plateau_upper = 0.6,
                       .density = 1.5,
                       .velocity = 0.4,
                       .pressure = 1.0};

/// A ramp of a width about a place.
std::function<State(double)> ramp(double place, double width) {
  return [=](double x) -> State {
    double const part = std::clamp(0.5 - (x - place) / width, 0.0, 1.0);
    return {1.0 + 0.5 * part, 0.4 * part, 0.5 + 0.5 * part};
  };
}

BOOST_AUTO_TEST_CASE(a_smeared_shock_is_where_its_pressure_crosses_the_middle) {
  for (double const place : {0.6, 0.57, 0.6312}) {
    ShockRecord const record = measure_shock(particles_at(cell_centres(200), ramp(place, 0.05)), front);
    BOOST_TEST(record.position == 0.6);
    BOOST_TEST(std::abs(record.position_error.value() - (place - 0.6)) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_jump_between_two_particles_is_halfway) {
  auto const jump = [](double x) { return x < 0.6 ? State{1.5, 0.4, 1.0} : State{1.0, 0.0, 0.5}; };
  ShockRecord const record = measure_shock(particles_at(cell_centres(20), jump), front);
  BOOST_TEST(std::abs(record.position_error.value()) < 1e-12);  // between 0.575 and 0.625
}

BOOST_AUTO_TEST_CASE(the_plateau_s_values_are_right_to_round_off_where_it_is_flat) {
  ShockRecord const record = measure_shock(particles_at(cell_centres(100), ramp(0.6, 0.05)), front);
  BOOST_TEST(std::abs(record.plateau_density.value()) < 1e-14);
  BOOST_TEST(std::abs(record.plateau_pressure.value()) < 1e-14);
  BOOST_TEST(std::abs(record.plateau_velocity.value()) < 1e-14);
}

BOOST_AUTO_TEST_CASE(errors_of_the_plateau_are_relative_but_for_the_velocity) {
  auto const high = [](double x) { return x < 0.6 ? State{1.5 * 1.1, 0.37, 0.8} : State{1.0, 0.0, 0.5}; };
  ShockRecord const record = measure_shock(particles_at(cell_centres(100), high), front);
  BOOST_TEST(record.plateau_density.value() == 0.1, tolerance(1e-12));
  BOOST_TEST(record.plateau_pressure.value() == -0.2, tolerance(1e-12));
  BOOST_TEST(record.plateau_velocity.value() == -0.03, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(only_the_middle_three_fifths_of_the_plateau_count) {
  // 0.28 to 0.52.
  for (double const x : {0.21, 0.27, 0.53, 0.59, 0.1, 0.7}) {
    auto const spike = [=](double y) {
      return std::abs(y - x) < 0.004 ? State{9.0, 9.0, 9.0} : ramp(0.6, 0.01)(y);
    };
    ShockRecord const record = measure_shock(particles_at(cell_centres(200), spike), front);
    BOOST_TEST(std::abs(record.plateau_pressure.value()) < 1e-14, "a spike at " << x);
  }
  for (double const x : {0.29, 0.4, 0.51}) {
    auto const spike = [=](double y) {
      return std::abs(y - x) < 0.004 ? State{9.0, 9.0, 9.0} : ramp(0.6, 0.01)(y);
    };
    ShockRecord const record = measure_shock(particles_at(cell_centres(200), spike), front);
    BOOST_TEST(record.plateau_pressure.value() > 0.01, "a spike at " << x);
  }
}

BOOST_AUTO_TEST_CASE(means_are_weighted_by_volume) {
  // Two particles on the plateau: of density 1.5 and volume 0.01, and of density 3 and volume 0.03.
  Particles<1> particles = particles_at({0.35, 0.45}, [](double x) {
    return x < 0.4 ? State{1.5, 0.4, 1.0} : State{3.0, 0.8, 2.0};
  });
  particles.masses()[1] *= 3.0;
  ShockRecord const record = measure_shock(particles, front);
  BOOST_TEST(record.plateau_density.value() == 0.75, tolerance(1e-12));
  BOOST_TEST(record.plateau_pressure.value() == 0.75, tolerance(1e-12));
  BOOST_TEST(record.plateau_velocity.value() == 0.3, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(of_several_crossings_the_nearest_counts) {
  auto const pulses = [](double x) {
    bool const on = x < 0.1 || (x > 0.3 && x < 0.59) || (x > 0.9 && x < 0.95);
    return on ? State{1.5, 0.4, 1.0} : State{1.0, 0.0, 0.5};
  };
  ShockRecord const record = measure_shock(particles_at(cell_centres(100), pulses), front);
  BOOST_TEST(record.position_error.value() == -0.01, tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_order_of_the_particles_does_not_matter) {
  std::vector<double> places = cell_centres(50);
  ShockRecord const sorted = measure_shock(particles_at(places, ramp(0.58, 0.07)), front);
  for (std::size_t i = 0; i < places.size(); ++i) std::swap(places[i], places[(i * 17) % places.size()]);
  ShockRecord const mixed = measure_shock(particles_at(places, ramp(0.58, 0.07)), front);
  BOOST_TEST(*mixed.position_error == *sorted.position_error, tolerance(1e-13));
  BOOST_TEST(std::abs(*mixed.plateau_pressure - *sorted.plateau_pressure) < 1e-14);
}

BOOST_AUTO_TEST_CASE(a_shock_that_runs_to_the_left_has_its_plateau_on_the_right) {
  ShockFront left = front;
  left.position = left.plateau_lower = 0.4;
  left.plateau_upper = 0.8;
  auto const mirrored = [](double x) {
    State s = ramp(0.6, 0.05)(1.0 - x);
    return s;
  };
  ShockRecord const record = measure_shock(particles_at(cell_centres(100), mirrored), left);
  BOOST_TEST(std::abs(record.position_error.value()) < 1e-12);
  BOOST_TEST(std::abs(record.plateau_pressure.value()) < 1e-14);
}

BOOST_AUTO_TEST_CASE(where_there_is_no_shock_and_no_particle_on_the_plateau_nothing_is_measured) {
  auto const rest = [](double) { return State{1.0, 0.0, 0.5}; };
  ShockRecord const flat = measure_shock(particles_at(cell_centres(100), rest), front);
  BOOST_TEST(!flat.position_error.has_value());
  BOOST_TEST(flat.plateau_pressure.value() == -0.5, tolerance(1e-12));
  ShockRecord const empty = measure_shock(particles_at({0.1, 0.95}, ramp(0.6, 0.05)), front);
  BOOST_TEST(!empty.plateau_pressure.has_value());
  BOOST_TEST(!empty.plateau_density.has_value());
  BOOST_TEST(!empty.plateau_velocity.has_value());
  BOOST_TEST(empty.position == 0.6);
}

BOOST_AUTO_TEST_CASE(in_two_dimensions_the_first_axis_counts) {
  Particles<2> particles(400, 0.1);
  particles.allocate({Field::density, Field::velocity, Field::pressure});
  for (std::size_t i = 0; i < 400; ++i) {
    double const x = (static_cast<double>(i / 4) + 0.5) / 100.0;
    State const s = ramp(0.61, 0.05)(x);
    particles.positions().set(i, Vector<2>(x, 0.25 * static_cast<double>(i % 4)));
    particles.masses()[i] = 0.01 * s.density;
    particles.scalar(Field::density)[i] = s.density;
    particles.vector(Field::velocity).set(i, Vector<2>(s.velocity, 7.0));
    particles.scalar(Field::pressure)[i] = s.pressure;
  }
  ShockRecord const record = measure_shock(particles, front);
  BOOST_TEST(std::abs(record.position_error.value() - 0.01) < 1e-12);
  BOOST_TEST(std::abs(record.plateau_velocity.value()) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
