// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/neighbours.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_neighbours_neighbours)

using namespace sphverify;
using namespace sphverify::tests;

template <int Dim>
struct Cloud {
  VectorField<Dim> positions;
  Domain<Dim> domain;
  double reach;
  NeighbourList list(int threads = 1) const {
    return find_neighbours(CellGrid<Dim>(positions, domain, reach), threads);
  }
};

enum class Box { open, periodic, turned };

/// Particles at random places of a box of extents 1, 1.1, 1.2 from -0.4 on, with all axes periodic or none.
template <int Dim>
Cloud<Dim> cloud(std::uint64_t seed, std::size_t count, double reach, Box box) {
  Random random(seed);
  Vector<Dim> const lower = Vector<Dim>::Constant(-0.4);
  Vector<Dim> extent;
  for (int k = 0; k < Dim; ++k) extent[k] = 1.0 + 0.1 * k;
  Cloud<Dim> c{VectorField<Dim>(count), {.lower = lower, .upper = lower + extent}, reach};
  c.domain.periodic.fill(box != Box::open);
  // A reflection is the only turn in 1D; in 3D it moves all axes as a rotation does.
  if (box == Box::turned) c.domain.axes = Dim == 2 ? random.rotation<Dim>() : random.reflection<Dim>();
  for (std::size_t i = 0; i < count; ++i) {
    Vector<Dim> const along = lower + random.vector<Dim>(0.0, 1.0).cwiseProduct(extent);
    c.positions.set(i, c.domain.to_space(along));
  }
  return c;
}

/// Distance to the nearest of all images.
template <int Dim>
double brute_distance(Cloud<Dim> const& c, std::size_t i, std::size_t j) {
  Vector<Dim> r = c.domain.axes.transpose() * (c.positions[i] - c.positions[j]);
  for (int k = 0; k < Dim; ++k) {
    double const period = c.domain.extent()[k];
    if (c.domain.periodic[k]) r[k] -= period * std::round(r[k] / period);
  }
  return r.norm();
}

/// Whether a list's rows are the j != i with distance < reach(i, j), each once.
template <int Dim, class Reach>
bool is_brute_force(NeighbourList const& list, Cloud<Dim> const& c, Reach const& reach) {
  bool good = list.rows() == c.positions.size();
  std::size_t pairs = 0;
  for (std::size_t i = 0; good && i < list.rows(); ++i) {
    std::vector<std::uint32_t> expected;
    for (std::size_t j = 0; j < list.rows(); ++j) {
      if (j != i && brute_distance(c, i, j) < reach(i, j)) expected.push_back(static_cast<std::uint32_t>(j));
    }
    pairs += expected.size();
    good = sorted_row(list, i) == expected;
  }
  return good && list.pairs() == pairs;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_are_those_of_brute_force, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic, Box::turned}) {
    for (std::size_t const count : {2u, 3u, 400u}) {
      // Half of the shortest axis is 0.5: two cells there, one where the particles are few.
      for (double const reach : {0.02, 0.15, 0.26, 0.34, 0.4, 0.5}) {
        Cloud<Dim> const c = cloud<Dim>(count, count, reach, box);
        bool const good = is_brute_force(c.list(), c, [&](std::size_t, std::size_t) { return reach; });
        BOOST_TEST(good, count << " particles, reach " << reach << ", box " << static_cast<int>(box));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_of_one_and_of_two_cells_along_a_periodic_axis_meet_once, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::periodic, Box::turned}) {
    // As many cells along an axis as particles at most: 1 and 2.
    for (std::size_t const count : {1u, 2u}) {
      for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Cloud<Dim> const c = cloud<Dim>(seed, count, 0.45, box);
        BOOST_TEST(is_brute_force(c.list(), c, [](std::size_t, std::size_t) { return 0.45; }));
      }
    }
    // Many particles in two cells per axis.
    Cloud<Dim> const c = cloud<Dim>(7, 200, 0.5, box);
    BOOST_TEST(is_brute_force(c.list(), c, [](std::size_t, std::size_t) { return 0.5; }));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(who_is_my_neighbour_has_me_for_one, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic, Box::turned}) {
    NeighbourList const list = cloud<Dim>(1, 300, 0.2, box).list();
    bool symmetric = true;
    for (std::uint32_t i = 0; i < 300; ++i) {
      for (std::uint32_t const j : list.row(i)) {
        auto const row = list.row(j);
        symmetric = symmetric && std::ranges::count(row, i) == 1;
      }
    }
    BOOST_TEST(symmetric);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(own_reaches_and_a_skin_widen_every_pair_s_support, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic, Box::turned}) {
    for (double const skin : {0.0, 0.1, 0.4}) {
      Cloud<Dim> c = cloud<Dim>(2, 300, 0.0, box);
      Particles<Dim> particles(300, 0.1);
      particles.vary_smoothing_length();
      Random random(3);
      for (double& h : particles.smoothing_lengths()) h *= random.uniform(0.3, 1.5);
      // The same reaches by a kernel that goes further.
      if (skin == 0.1) {
        particles.set_kernel(kernel("quintic-spline", Dim));
        for (double& h : particles.smoothing_lengths()) h *= 2.0 / 3.0;
      }
      double const half_support = 0.5 * particles.kernel().support_ratio();
      SmoothingLength const h(particles);
      CellGrid<Dim> const grid(c.positions, c.domain, 2.0 * half_support * (1.0 + skin) * h.largest());
      NeighbourList const list = find_neighbours(grid, h, skin);
      auto const reach = [&](std::size_t i, std::size_t j) {
        return half_support * (1.0 + skin) * (h(i) + h(j));
      };
      BOOST_TEST(is_brute_force(list, c, reach), "skin " << skin << ", box " << static_cast<int>(box));
      auto const larger = [&](std::size_t i, std::size_t j) {
        return 2.0 * half_support * (1.0 + skin) * std::max(h(i), h(j));
      };
      BOOST_TEST(is_brute_force(find_neighbours(grid, h, skin, 1, {}, PairSupport::larger), c, larger),
                 "larger, skin " << skin << ", box " << static_cast<int>(box));
      NeighbourList const common = find_neighbours(grid, SmoothingLength(0.1, default_kernel(Dim)), skin);
      auto const grid_s = [&](std::size_t, std::size_t) { return grid.reach(); };
      BOOST_TEST(is_brute_force(common, c, grid_s));  // where all have one length the grid's reach holds
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_the_list, D, Dimensions) {
  constexpr int Dim = D::value;
  // More than a thousand cells, which are what threads share.
  std::size_t const count = Dim == 1 ? 6000 : 5000;
  double const reach = Dim == 1 ? 3e-4 : (Dim == 2 ? 0.025 : 0.08);
  for (Box const box : {Box::open, Box::turned}) {
    Cloud<Dim> const c = cloud<Dim>(4, count, reach, box);
    CellGrid<Dim> const grid(c.positions, c.domain, reach);
    BOOST_TEST(grid.cells() > 1024u);
    Particles<Dim> particles(count, 0.5 * reach);
    particles.vary_smoothing_length();
    Random random(5);
    for (double& h : particles.smoothing_lengths()) h *= random.uniform(0.5, 1.0);
    SmoothingLength const h(particles);
    NeighbourList const one = c.list(1);
    NeighbourList const own = find_neighbours(grid, h, 0.0, 1);
    BOOST_TEST(one.pairs() > count / 2);
    BOOST_TEST(own.pairs() < one.pairs());
    for (int const threads : {2, 4}) {
      NeighbourList const several = c.list(threads);
      BOOST_TEST((several.first == one.first));
      BOOST_TEST((several.neighbour == one.neighbour));
      NeighbourList const own_several = find_neighbours(grid, h, 0.0, threads);
      BOOST_TEST((own_several.first == own.first));
      BOOST_TEST((own_several.neighbour == own.neighbour));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_old_list_lends_its_memory_and_nothing_else, D, Dimensions) {
  constexpr int Dim = D::value;
  Cloud<Dim> const c = cloud<Dim>(8, 200, 0.2, Box::periodic);
  CellGrid<Dim> const grid(c.positions, c.domain, c.reach);
  NeighbourList const fresh = find_neighbours(grid);
  for (std::size_t const count : {1u, 50u, 400u}) {
    NeighbourList const renewed = find_neighbours(grid, 1, cloud<Dim>(9, count, 0.3, Box::open).list());
    BOOST_TEST((renewed.first == fresh.first));
    BOOST_TEST((renewed.neighbour == fresh.neighbour));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(single_particle_has_an_empty_row_even_where_it_would_meet_its_own_image, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic, Box::turned}) {
    NeighbourList const list = cloud<Dim>(1, 1, 0.5, box).list();
    BOOST_TEST(list.rows() == 1u);
    BOOST_TEST(list.pairs() == 0u);
  }
}

/// Pairs that lie along an axis, far from each other, at their reach times 1 + d, where d is 0 or as little
/// as numbers of double or of single precision can tell, or a few times that.
template <int Dim>
struct PairsAtTheirReach {
  Cloud<Dim> cloud;
  std::vector<double> h;  ///< half the reach of each

  PairsAtTheirReach(double reach, bool own, double scale)
      : cloud{VectorField<Dim>(2 * count), {}, scale * reach} {
    Random random(11);
    std::vector<double> differences{0.0};
    for (double const digit :
         {0x1p-53, 0x1p-52, 0x1p-40, 0x1p-26, 0x1p-25, 0x1p-24, 0x1p-23, 0x1p-22, 0x1p-20}) {
      differences.push_back(digit);
      differences.push_back(-digit);
    }
    for (std::size_t pair = 0; pair < count; ++pair) {
      Vector<Dim> x = random.vector<Dim>(0.0, 1.0) * reach;
      x[0] += 5.0 * reach * static_cast<double>(pair);
      double sum = 0.0;
      for (int of_two = 0; of_two < 2; ++of_two)
        sum += h.emplace_back(0.5 * reach * (own ? random.uniform(0.3, 1.0) : 1.0));
      Vector<Dim> y = x;
      int const axis = static_cast<int>(pair % Dim);
      y[axis] += sum * (1.0 + differences[pair % differences.size()]);
      cloud.positions.set(2 * pair, scale * x);
      cloud.positions.set(2 * pair + 1, scale * y);
    }
    for (double& length : h) length *= scale;
  }
  /// As the numbers are rounded, and no better: all but one coordinate are the same.
  bool are_near(std::size_t pair) const {
    double const reach = h[2 * pair] + h[2 * pair + 1];
    return (cloud.positions[2 * pair] - cloud.positions[2 * pair + 1]).squaredNorm() < reach * reach;
  }
  static constexpr std::size_t count = 600;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(the_last_bit_of_a_distance_decides, D, Dimensions) {
  constexpr int Dim = D::value;
  using Pairs = PairsAtTheirReach<Dim>;
  for (double const reach : {0.25, 0.3}) {
    for (bool const own : {false, true}) {
      // Powers of two scale without rounding; single precision does not hold their squares.
      for (double const scale : {1.0, 0x1p-100, 0x1p100}) {
        Pairs const pairs(reach, own, scale);
        Particles<Dim> particles(2 * Pairs::count, 0.5 * scale * reach);
        if (own) particles.vary_smoothing_length();
        if (own) particles.smoothing_lengths() = pairs.h;
        SmoothingLength const h(particles);
        CellGrid<Dim> const grid(pairs.cloud.positions, pairs.cloud.domain, pairs.cloud.reach);
        NeighbourList const list = find_neighbours(grid, h);
        std::size_t wrong = 0, near = 0;
        for (std::size_t pair = 0; pair < Pairs::count; ++pair) {
          bool const expected = pairs.are_near(pair);
          near += expected ? 1 : 0;
          wrong += list.row(2 * pair).size() == (expected ? 1u : 0u) ? 0 : 1;
          wrong += list.row(2 * pair + 1).size() == (expected ? 1u : 0u) ? 0 : 1;
        }
        BOOST_TEST(wrong == 0u, wrong << " wrong, reach " << reach << ", own " << own << ", scale " << scale);
        BOOST_TEST(near > Pairs::count / 4);
        BOOST_TEST(near < 3 * Pairs::count / 4);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(reaches_far_below_the_largest_are_kept_apart, D, Dimensions) {
  constexpr int Dim = D::value;
  Cloud<Dim> const c = cloud<Dim>(13, 300, 0.2, Box::periodic);
  Particles<Dim> particles(300, 0.1);
  particles.vary_smoothing_length();
  Random random(14);
  for (double& h : particles.smoothing_lengths()) h *= std::pow(10.0, -random.uniform(0.0, 8.0));
  SmoothingLength const h(particles);
  CellGrid<Dim> const grid(c.positions, c.domain, 2.0 * h.largest());
  auto const reach = [&](std::size_t i, std::size_t j) { return h(i) + h(j); };
  BOOST_TEST(is_brute_force(find_neighbours(grid, h), c, reach));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_may_be_farther_off_than_single_precision_holds, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const far : {1e10, 1e60}) {
    Cloud<Dim> c = cloud<Dim>(15, 43, 0.3, Box::open);
    c.positions.set(5, Vector<Dim>::Constant(far));
    c.positions.set(6, Vector<Dim>::Constant(0.01 * far));  // in the cell of all the others
    BOOST_TEST(is_brute_force(c.list(), c, [](std::size_t, std::size_t) { return 0.3; }));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_last_bit_of_a_place_decides_far_from_the_origin, D, Dimensions) {
  constexpr int Dim = D::value;
  // Two particles a bit apart, in one cell or across a border of cells, and on either side a third that only
  // the nearer of them reaches: the middle of the two is no number, and rounding must not lose a pair.
  for (double const place : {0x1p30, 0x1p32, 0x1p34, 0x1p38}) {
    double const bit = place * 0x1p-52;
    double const reach = 0.5 + 0.1 * bit;
    Cloud<Dim> c = cloud<Dim>(16, 4 * 50, reach, Box::open);
    for (std::size_t n = 0; n < 50; ++n) {
      double const x = place + 8.0 * static_cast<double>(n) + 0.25 * static_cast<double>(n % 3) +
                       bit * static_cast<double>(n % 7);
      std::size_t i = 4 * n;
      for (double const along : {x - 0.5, x, x + bit, x + bit + 0.5}) {
        Vector<Dim> at = Vector<Dim>::Zero();
        at[static_cast<int>(n % Dim)] = along;
        c.positions.set(i++, at);
      }
    }
    BOOST_TEST(is_brute_force(c.list(), c, [=](std::size_t, std::size_t) { return reach; }));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_that_all_but_touch_are_neighbours, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic}) {
    Cloud<Dim> c = cloud<Dim>(12, 300, 0.2, box);
    Vector<Dim> beside = c.positions[7];
    beside[Dim - 1] += 1e-14;
    c.positions.set(23, beside);
    BOOST_TEST(is_brute_force(c.list(), c, [](std::size_t, std::size_t) { return 0.2; }));
  }
}

BOOST_AUTO_TEST_CASE(no_particles_have_no_rows) {
  BOOST_TEST(cloud<2>(1, 0, 0.1, Box::open).list().rows() == 0u);
}

bool names_7_and_23(std::invalid_argument const& problem) {
  return std::string(problem.what()).find("particles 7 and 23 are") != std::string::npos;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(two_particles_at_the_same_place_are_refused_by_name, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::periodic, Box::turned}) {
    Cloud<Dim> c = cloud<Dim>(1, 30, 0.2, box);
    c.positions.set(23, c.positions[7]);
    for (int const threads : {1, 2}) {
      BOOST_CHECK_EXCEPTION(c.list(threads), std::invalid_argument, names_7_and_23);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_a_period_apart_are_at_the_same_place, D, Dimensions) {
  constexpr int Dim = D::value;
  for (int axis = 0; axis < Dim; ++axis) {
    // Powers of two, so that the images coincide to the last bit.
    Cloud<Dim> c{
        VectorField<Dim>(30), {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Constant(2.0)}, 0.5};
    Random random(6);
    for (std::size_t i = 0; i < 30; ++i) c.positions.set(i, random.vector<Dim>(0.1, 1.9));
    Vector<Dim> at = Vector<Dim>::Constant(0.25);
    at[axis] = 0.0;
    c.positions.set(7, at);
    at[axis] = 2.0;
    c.positions.set(23, at);
    BOOST_CHECK_NO_THROW(c.list());
    c.domain.periodic[static_cast<std::size_t>(axis)] = true;
    BOOST_CHECK_EXCEPTION(c.list(), std::invalid_argument, names_7_and_23);
  }
}

BOOST_AUTO_TEST_SUITE_END()
