// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/integrate/dependencies.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "harness/run/frozen_conduction.hpp"
#include "tests/support/random_particles.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_integrate_dependencies)

using namespace sphverify;
using namespace sphverify::tests;

bool depends(DependencyPattern const& pattern, std::size_t row, std::size_t column) {
  return std::binary_search(pattern.column.begin() + pattern.first[row],
                            pattern.column.begin() + pattern.first[row + 1],
                            static_cast<std::int64_t>(column));
}

/// Perturbs one temperature at a time. Returns how many entries of the pattern were seen to matter.
template <int Dim>
std::size_t check_pattern(Problem<Dim> const& problem, SceneChoice const& choice) {
  FrozenConduction<Dim> conduction(problem, choice, 1.0);
  DependencyPattern const pattern = conduction.jacobian().pattern();
  std::size_t const n = conduction.scene().particles().size();
  BOOST_TEST_REQUIRE(pattern.rows() == n);
  Random random(3);
  std::vector<double> T(n);
  for (double& value : T) value = random.uniform(0.5, 2.0);
  auto const rate = [&] {
    conduction.evaluate(0.01, T.data());
    return conduction.scene().particles().scalar(Field::heating);
  };
  std::vector<double> const base = rate();
  std::size_t used = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double const before = T[j];
    T[j] += 0.7;
    std::vector<double> const changed = rate();
    T[j] = before;
    for (std::size_t i = 0; i < n; ++i) {
      if (depends(pattern, i, j)) {
        used += changed[i] != base[i] ? 1 : 0;
      } else {
        BOOST_REQUIRE_EQUAL(changed[i], base[i]);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    BOOST_REQUIRE(depends(pattern, i, i));
    BOOST_REQUIRE(std::is_sorted(pattern.column.begin() + pattern.first[i],
                                 pattern.column.begin() + pattern.first[i + 1]));
  }
  BOOST_TEST(pattern.column.size() < n * n);
  return used;
}

template <int Dim>
void check_case(char const* scene_case, int resolution, double dimension) {
  Case const* const one = find_case(scene_case);
  Parameters parameters(one->info.parameters);
  if (dimension > 1.0) parameters.set("dimension", dimension);
  auto const problem = std::get<Problem<Dim>>(one->problem(parameters));
  for (std::string const& formulation : conduction_schemes()) {
    for (std::string const walls : {"on", "off", "mirror", "dummy", "voronoi"}) {
      for (char const* closure : {"interpolated", "one-sided"}) {
        SceneChoice choice{.formulation = formulation,
                           .walls = WallChoice(walls == "voronoi" ? "on" : walls),
                           .discretisation = jittered_by(0.2, 4),
                           .resolution = resolution,
                           .smoothing_ratio = 1.3,
                           .threads = 1};
        choice.discretisation.closure = closure;
        if (walls == "voronoi") choice.discretisation.pair_weight = "voronoi";
        BOOST_TEST_CONTEXT(scene_case << " " << formulation << " walls " << walls << " " << closure)
        BOOST_TEST(check_pattern(problem, choice) > 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(no_rate_depends_on_a_temperature_outside_its_row_whatever_the_walls_prescribe) {
  check_case<1>("conduction/slab-dirichlet", 30, 1.0);
  check_case<1>("conduction/slab-insulated", 30, 1.0);
  check_case<1>("conduction/slab-flux", 30, 1.0);
  check_case<1>("conduction/barenblatt", 30, 1.0);
  check_case<1>("extreme/radiative-cooling", 30, 1.0);
}

BOOST_AUTO_TEST_CASE(no_rate_depends_on_a_temperature_outside_its_row_in_more_dimensions) {
  check_case<2>("conduction/manufactured", 14, 2.0);
  check_case<2>("extreme/radiative-cooling", 14, 2.0);
}

BOOST_AUTO_TEST_CASE(away_from_walls_a_row_is_no_longer_than_it_must_be) {
  // h/dx = 1.2 on a lattice: two neighbours on each side, four through the flux.
  for (bool const two_pass : {false, true}) {
    auto const problem = std::get<Problem<1>>(
        find_case("conduction/slab-dirichlet")
            ->problem(Parameters(find_case("conduction/slab-dirichlet")->info.parameters)));
    SceneChoice const choice{.formulation = two_pass ? "conduction/lucy-flux" : "conduction/brookshaw",
                             .walls = true,
                             .discretisation = {},
                             .resolution = 40,
                             .smoothing_ratio = 1.2,
                             .threads = 1};
    sphverify::Scene<1> const scene(problem, choice);
    DependencyPattern const pattern = dependencies(scene.geometry(), two_pass ? 2 : 1);
    BOOST_TEST(pattern.first[21] - pattern.first[20] == (two_pass ? 9 : 5));
    BOOST_TEST(depends(pattern, 20, two_pass ? 24 : 22));
    BOOST_TEST(!depends(pattern, 20, two_pass ? 25 : 23));
  }
}

BOOST_AUTO_TEST_CASE(a_row_holds_what_is_interpolated_to_its_foot_point_even_if_it_is_no_neighbour) {
  PairGeometry<2> geometry;
  geometry.neighbours.first = {0, 0, 0, 0};
  WallContacts<2> contacts;
  contacts.particle = {1};
  contacts.interpolation_first = {0, 2};
  contacts.interpolation_neighbour = {0, 1};
  geometry.contacts = {contacts};
  DependencyPattern const pattern = dependencies(geometry, false);
  BOOST_TEST(pattern.first == (std::vector<std::int64_t>{0, 1, 3, 4}), boost::test_tools::per_element());
  BOOST_TEST(pattern.column == (std::vector<std::int64_t>{0, 0, 1, 2}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
