#include "formulations/support/neighbours.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_support_neighbours)

using namespace sphverify;
using namespace sphverify::tests;

template <int Dim>
struct Cloud {
  VectorField<Dim> positions;
  Domain<Dim> domain;
  double reach;
  NeighbourList list() const { return find_neighbours(CellGrid<Dim>(positions, domain, reach)); }
};

template <int Dim>
Cloud<Dim> cloud(std::uint64_t seed, std::size_t count, double reach, bool periodic) {
  Random random(seed);
  Cloud<Dim> c{VectorField<Dim>(count), {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()}, reach};
  c.domain.periodic.fill(periodic);
  for (std::size_t i = 0; i < count; ++i) c.positions.set(i, random.vector<Dim>(0.0, 1.0));
  return c;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_are_those_of_brute_force_in_ascending_order, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    for (std::size_t const count : {2u, 3u, 400u}) {
      for (double const reach : {0.02, 0.15, 0.4}) {
        Cloud<Dim> const c = cloud<Dim>(count, count, reach, periodic);
        NeighbourList const list = c.list();
        BOOST_TEST(list.rows() == count);
        bool good = true;
        std::size_t pairs = 0;
        for (std::size_t i = 0; i < count; ++i) {
          std::vector<std::uint32_t> expected;
          for (std::size_t j = 0; j < count; ++j) {
            Vector<Dim> r = c.positions[i] - c.positions[j];
            if (periodic) r -= r.array().round().matrix().eval();
            if (j != i && r.norm() < reach) expected.push_back(static_cast<std::uint32_t>(j));
          }
          pairs += expected.size();
          good = good && std::ranges::equal(list.row(i), expected);
        }
        BOOST_TEST(good, count << " particles, reach " << reach << ", periodic " << periodic);
        BOOST_TEST(list.pairs() == pairs);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(who_is_my_neighbour_has_me_for_one, D, Dimensions) {
  constexpr int Dim = D::value;
  NeighbourList const list = cloud<Dim>(1, 300, 0.2, true).list();
  bool symmetric = true;
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (std::uint32_t const j : list.row(i))
      symmetric = symmetric && std::ranges::binary_search(list.row(j), i);
  }
  BOOST_TEST(symmetric);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(single_particle_has_an_empty_row_even_where_it_would_meet_its_own_image, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    NeighbourList const list = cloud<Dim>(1, 1, 0.5, periodic).list();
    BOOST_TEST(list.rows() == 1u);
    BOOST_TEST(list.pairs() == 0u);
  }
}

BOOST_AUTO_TEST_CASE(no_particles_have_no_rows) {
  BOOST_TEST(cloud<2>(1, 0, 0.1, false).list().rows() == 0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(two_particles_at_the_same_place_are_refused_by_name, D, Dimensions) {
  constexpr int Dim = D::value;
  Cloud<Dim> c = cloud<Dim>(1, 30, 0.2, false);
  c.positions.set(23, c.positions[7]);
  auto const names_both = [](std::invalid_argument const& problem) {
    std::string const message = problem.what();
    return message.find("7") != std::string::npos && message.find("23") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(c.list(), std::invalid_argument, names_both);
}

BOOST_AUTO_TEST_CASE(particles_one_period_apart_are_at_the_same_place) {
  Cloud<1> c{VectorField<1>(2), {.lower = Vector<1>(0.0), .upper = Vector<1>(1.0), .periodic = {true}}, 0.2};
  c.positions.component(0) = {0.0, 1.0};
  BOOST_CHECK_THROW(c.list(), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
