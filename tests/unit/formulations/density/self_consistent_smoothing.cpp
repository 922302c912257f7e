// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/self_consistent_smoothing.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/dense.hpp"
#include "tests/support/kernels.hpp"

BOOST_AUTO_TEST_SUITE(formulations_density_self_consistent_smoothing)

using namespace sphverify;
using namespace sphverify::tests;

/// Particles at random in a slab, walls at both ends of x, periodic along the other axes. Masses span three
/// decades, so that light ones see little but the tails of heavy ones.
template <int Dim>
struct Gas {
  explicit Gas(std::size_t count) : positions(count), masses(count) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> within(0.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      Vector<Dim> x;
      for (int k = 0; k < Dim; ++k) x[k] = within(random);
      positions.set(i, x);
      masses[i] = std::pow(10.0, 3.0 * within(random));
    }
    domain.periodic.fill(true);
    domain.periodic[0] = false;
  }

  std::vector<double> solve(std::vector<double> h, int threads = 1) const {
    SelfConsistentSmoothing<Dim>{positions, masses, domain, walls, ratio, threads, *W}.solve(h);
    return h;
  }

  /// The largest part by which an equation is missed, by a double loop.
  double residual(std::vector<double> const& h) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      double density = 0.0;
      for (std::size_t j = 0; j < h.size(); ++j) {
        double const r = domain.nearest_image(positions[i] - positions[j]).norm();
        density += masses[j] * written::kernel(W->id(), Dim, r, h[i]);
      }
      double inside = 1.0;
      for (Wall<Dim> const& wall : walls) {
        double const d = wall.distance(positions[i]);
        if (d < written::support(W->id()) * h[i])
          inside -= 1.0 - written::inner_fraction(W->id(), Dim, d / h[i]);
      }
      density /= inside;
      worst = std::max(worst, std::abs(ratio * std::pow(masses[i] / density, 1.0 / Dim) / h[i] - 1.0));
    }
    return worst;
  }

  void add_walls() {
    Vector<Dim> const n = Vector<Dim>::Unit(0);
    walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -n});
    walls.push_back({.point = Vector<Dim>::Ones(), .outward_normal = n});
  }

  VectorField<Dim> positions;
  std::vector<double> masses;
  Domain<Dim> domain{.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()};
  std::vector<Wall<Dim>> walls;
  double ratio = 1.2;
  Kernel const* W = &default_kernel(Dim);
};

template <int Dim>
constexpr std::size_t enough = Dim == 1 ? 40 : (Dim == 2 ? 400 : 3000);

BOOST_AUTO_TEST_CASE_TEMPLATE(every_particle_s_own_equation_holds_from_any_guess, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(enough<Dim>);
  for (bool const walls : {false, true}) {
    if (walls) gas.add_walls();
    double const spacing = std::pow(static_cast<double>(enough<Dim>), -1.0 / Dim);
    std::vector<double> const h = gas.solve(std::vector<double>(enough<Dim>, spacing));
    BOOST_TEST(gas.residual(h) < 1e-11);
    for (double const factor : {0.01, 0.5, 1.3}) {
      std::vector<double> const guess(enough<Dim>, factor * spacing);
      BOOST_TEST(relative_difference(gas.solve(guess), h) < 1e-11);
    }
  }
}

// In units of the guess a density that hardly depends on h leaves h itself undetermined but for the tails of
// those farther away; to iterate between the two creeps there.
BOOST_AUTO_TEST_CASE(a_clumped_pair_whose_next_neighbour_is_at_the_edge_of_the_support) {
  Gas<1> gas(5);
  gas.domain.periodic = {false};
  double const places[] = {0.450, 0.468, 0.473, 0.498, 0.518};
  for (std::size_t i = 0; i < 5; ++i) {
    gas.positions.set(i, Vector<1>(places[i]));
    gas.masses[i] = i < 3 ? 0.28 : 0.02;
  }
  for (double const guess : {0.001, 0.0115, 0.024, 0.3}) {
    std::vector<double> const h = gas.solve(std::vector<double>(5, guess));
    BOOST_TEST(gas.residual(h) < 1e-12);
    BOOST_TEST(h[2] == 0.01227, boost::test_tools::tolerance(0.01));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(units_of_powers_of_two_and_threads_change_no_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(enough<Dim>);
  gas.add_walls();
  std::vector<double> const guess(enough<Dim>, std::pow(static_cast<double>(enough<Dim>), -1.0 / Dim));
  std::vector<double> const h = gas.solve(guess);
  BOOST_TEST(same_bits(gas.solve(guess, 3), h));
  Gas<Dim> scaled(enough<Dim>);
  double const unit = std::ldexp(1.0, 40);
  for (std::size_t i = 0; i < h.size(); ++i) {
    scaled.positions.set(i, unit * gas.positions[i]);
    scaled.masses[i] *= 8.0;
  }
  scaled.domain.upper *= unit;
  scaled.add_walls();
  scaled.walls[1].point *= unit;
  std::vector<double> larger = guess;
  for (double& one : larger) one *= unit;
  larger = scaled.solve(larger);
  for (double& one : larger) one /= unit;
  BOOST_TEST(same_bits(larger, h));
}

BOOST_AUTO_TEST_CASE(equations_without_a_solution_are_refused) {
  Gas<1> gas(40);
  std::vector<double> const guess(40, 0.03);
  gas.ratio = 0.66;  // a particle's own W(0) h is 2/3
  BOOST_CHECK_THROW(gas.solve(guess), std::invalid_argument);
  gas.ratio = 0.67;
  BOOST_CHECK_NO_THROW(gas.solve(guess));
  gas.ratio = 1.2;
  gas.positions.set(1, gas.positions[0]);
  gas.masses[1] = gas.masses[0];  // together 4/3
  BOOST_CHECK_THROW(gas.solve(guess), std::invalid_argument);
  Gas<1> lone(1);
  lone.domain.periodic = {false};
  BOOST_CHECK_THROW(lone.solve({0.03}), std::invalid_argument);
  lone.add_walls();  // the normalised density tends to the mass over all that is between them
  BOOST_TEST(lone.residual(lone.solve({0.03})) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_support_longer_than_half_the_periodic_box_is_refused_and_one_that_fits_is_found) {
  Gas<1> gas(8);
  gas.domain.periodic = {true};
  for (std::size_t i = 0; i < 8; ++i) {
    gas.positions.set(i, Vector<1>((static_cast<double>(i) + 0.5) / 8.0));
    gas.masses[i] = 1.0;
  }
  gas.ratio = 1.99;  // a support of 3.98 of the 4 spacings that there is room for
  BOOST_TEST(gas.residual(gas.solve(std::vector<double>(8, 0.2))) < 1e-12);
  BOOST_TEST(gas.residual(gas.solve(std::vector<double>(8, 0.4))) < 1e-12);  // a guess that does not
  gas.ratio = 2.1;
  BOOST_CHECK_THROW(gas.solve(std::vector<double>(8, 0.2)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_short_guess_beside_long_ones_is_looked_beyond_again) {
  Gas<1> gas(12);
  gas.domain.periodic = {true};
  for (double& mass : gas.masses) mass = 1.0;
  for (std::size_t i = 0; i < 12; ++i) {  // a void of a third of the box
    gas.positions.set(i, Vector<1>(0.05 + 0.6 * static_cast<double>(i * i) / 121.0));
  }
  std::vector<double> const h = gas.solve(std::vector<double>(12, 0.1));
  BOOST_TEST_REQUIRE(2.0 * 1.2 * *std::max_element(h.begin(), h.end()) > 0.3);
  for (std::size_t i = 0; i < 12; ++i) {
    for (double const factor : {0.83, 0.5, 0.1}) {
      std::vector<double> guess = h;
      guess[i] *= factor;
      BOOST_TEST(relative_difference(gas.solve(guess), h) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_guess_is_kept_where_there_is_no_solution_and_numbers_must_be_finite) {
  Gas<1> gas(40);
  gas.positions.set(1, gas.positions[0]);
  gas.masses[1] = gas.masses[0];
  std::vector<double> const guess(40, 0.03);
  std::vector<double> h = guess;
  SelfConsistentSmoothing<1> const equations{gas.positions, gas.masses, gas.domain,       gas.walls,
                                             1.2,           2,          default_kernel(1)};
  BOOST_CHECK_THROW(equations.solve(h), std::invalid_argument);
  BOOST_TEST(same_bits(h, guess));
  Gas<1> whole(40);
  for (double const wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    Gas<1> one = whole;
    one.masses[7] = wrong;
    BOOST_CHECK_THROW(one.solve(guess), std::invalid_argument);
    h = guess;
    h[7] = wrong;
    BOOST_CHECK_THROW(whole.solve(h), std::invalid_argument);
  }
  whole.add_walls();
  whole.positions.set(3, Vector<1>(0.0));  // sees twice its own term, 4/3
  BOOST_CHECK_THROW(whole.solve(guess), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(equations_hold_with_every_kernel, D, Dimensions) {
  constexpr int Dim = D::value;
  constexpr std::size_t count = Dim == 1 ? 40 : (Dim == 2 ? 400 : 1000);
  for (KernelInfo const& info : all_kernel_infos()) {
    Gas<Dim> gas(count);
    gas.W = &kernel(info.id, Dim);
    if (Dim == 3) {  // room for the longest support across a period
      gas.domain.periodic.fill(false);
    }
    gas.add_walls();
    double const spacing = std::pow(static_cast<double>(count), -1.0 / Dim);
    BOOST_TEST(gas.residual(gas.solve(std::vector<double>(count, spacing))) < 1e-11, info.id);
  }
}

BOOST_AUTO_TEST_SUITE_END()
