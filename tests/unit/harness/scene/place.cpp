// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/place.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(harness_scene_place)

using namespace sphverify;
using namespace sphverify::tests;

std::vector<LayoutChoice> const all_layouts{{"lattice"},         {"jittered", 0.2, 1}, {"clumped", 0.1},
                                            {"touching", 1e-12}, {"equal-mass"},       {"hexagonal"},
                                            {"close-packed"},    {"glass", 0.0, 1}, {"random", 0.0, 1}};

template <int Dim>
Problem<Dim> problem() {
  Problem<Dim> result;
  result.domain = {.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(1.0)};
  result.scalars[Field::density] = [](Vector<Dim> const& x, double) { return 2.0 + x[0]; };
  return result;
}

bool has(std::string const& id, int dimensions) {
  if (id == "equal-mass") return dimensions == 1;
  if (id == "hexagonal") return dimensions == 2;
  if (id == "close-packed") return dimensions == 3;
  if (id == "glass") return dimensions > 1;
  return true;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(places_as_many_particles_as_it_counts, D, Dimensions) {
  constexpr int Dim = D::value;
  for (LayoutChoice const& layout : all_layouts) {
    if (!has(layout.id, Dim)) continue;
    for (int const resolution : {1, 5, 8}) {
      BOOST_TEST_CONTEXT(layout.id << " " << resolution) {
        BOOST_TEST(particle_count(problem<Dim>().domain, layout, resolution) ==
                   static_cast<double>(place(problem<Dim>(), layout, resolution).volumes.size()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_name_stands_for_its_own_layout, D, Dimensions) {
  constexpr int Dim = D::value;
  std::vector<std::vector<double>> seen;
  for (LayoutChoice const& layout : all_layouts) {
    if (!has(layout.id, Dim)) continue;
    auto const x = place(problem<Dim>(), layout, 8).positions.component(0);
    for (auto const& other : seen) BOOST_TEST(!same_bits(x, other));
    seen.push_back(x);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_layout_that_the_dimension_does_not_have_is_refused, D, Dimensions) {
  constexpr int Dim = D::value;
  std::string const sentences[] = {
      "layout equal-mass is for one dimension", "layout hexagonal is for two dimensions",
      "layout close-packed is for three dimensions", "layout glass is for two and three dimensions",
      "no layout is named quartz"};
  std::string const ids[] = {"equal-mass", "hexagonal", "close-packed", "glass", "quartz"};
  for (int n = 0; n < 5; ++n) {
    if (ids[n] != "quartz" && has(ids[n], Dim)) continue;
    auto const says_so = [&](std::invalid_argument const& error) { return error.what() == sentences[n]; };
    BOOST_CHECK_EXCEPTION(place(problem<Dim>(), {ids[n]}, 4), std::invalid_argument, says_so);
    BOOST_CHECK_EXCEPTION(particle_count(problem<Dim>().domain, {ids[n]}, 4), std::invalid_argument, says_so);
  }
}

BOOST_AUTO_TEST_SUITE_END()
