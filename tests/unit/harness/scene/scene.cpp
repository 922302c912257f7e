// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/scene.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>

#include "tests/support/gathered_pairs.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_scene_scene)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

template <int Dim>
Problem<Dim> problem_of(char const* id,
                        std::vector<std::pair<std::string, ParameterValue>> const& values = {}) {
  Case const* const one = find_case(id);
  Parameters parameters(one->info.parameters);
  for (auto const& [name, value] : values) parameters.set(name, value);
  return std::get<Problem<Dim>>(one->problem(parameters));
}

SceneChoice choice_of(RunChoice const& run) {
  return {.formulation = run.formulation,
          .walls = run.walls,
          .discretisation = run.discretisation,
          .resolution = run.resolution,
          .smoothing_ratio = run.smoothing_ratio,
          .threads = 1};
}

template <int Dim>
double total_mass(Scene<Dim> const& scene) {
  auto const& m = scene.particles().masses();
  return std::accumulate(m.begin(), m.end(), 0.0);
}

BOOST_AUTO_TEST_CASE(given_density_is_the_case_s_at_the_particle) {
  auto const problem = problem_of<1>("conduction/manufactured");
  Scene<1> const scene(problem, choice_of({.discretisation = jittered_by(0.2, 1)}));
  for (std::size_t i = 0; i < scene.particles().size(); ++i) {
    double const exact = problem.scalars.at(Field::density)(scene.particles().positions()[i], 0.0);
    BOOST_TEST(scene.particles().scalar(Field::density)[i] == exact);
  }
}

BOOST_AUTO_TEST_CASE(summation_density_halves_at_a_wall_and_normalised_density_does_not) {
  auto const problem = problem_of<1>("conduction/slab-dirichlet");
  RunChoice run{.resolution = 100, .smoothing_ratio = 4.0, .discretisation = with_density("summation")};
  Scene<1> const summed(problem, choice_of(run));
  auto const& rho = summed.particles().scalar(Field::density);
  BOOST_TEST(rho[50] == 1.0, tolerance(1e-3));
  BOOST_TEST(rho.front() == 0.5, tolerance(0.2));
  BOOST_TEST(rho.back() == rho.front(), tolerance(1e-12));
  run.discretisation = with_density("normalised");
  Scene<1> const normalised(problem, choice_of(run));
  for (double const density : normalised.particles().scalar(Field::density))
    BOOST_TEST(density == 1.0, tolerance(5e-3));
}

BOOST_AUTO_TEST_CASE(normalised_density_is_summation_without_walls_to_normalise_by) {
  Problem<1> open = problem_of<1>("conduction/slab-dirichlet");
  open.walls.clear();
  Scene<1> const summed(open, choice_of({.discretisation = with_density("summation")}));
  Scene<1> const normalised(open, choice_of({.discretisation = with_density("normalised")}));
  BOOST_TEST(summed.particles().scalar(Field::density) == normalised.particles().scalar(Field::density),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_mass_of_the_slab_is_the_integral_of_its_density_to_second_order) {
  auto const problem = problem_of<1>("conduction/manufactured");
  // 1.3 + 0.3 cos(0.9 + 1.7 x)
  double const exact = 1.3 + 0.3 / 1.7 * (std::sin(2.6) - std::sin(0.9));
  std::vector<double> errors;
  for (int const n : {20, 40, 80}) {
    Scene<1> const scene(problem, choice_of({.resolution = n}));
    errors.push_back(std::abs(total_mass(scene) - exact));
  }
  BOOST_TEST(errors[0] / errors[1] == 4.0, tolerance(0.02));
  BOOST_TEST(errors[1] / errors[2] == 4.0, tolerance(0.02));
  Scene<1> const disordered(problem, choice_of({.resolution = 80, .discretisation = jittered_by(0.3, 2)}));
  BOOST_TEST(total_mass(disordered) == exact, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(particles_start_with_the_exact_temperature_and_conductivity) {
  auto const problem = problem_of<1>("conduction/manufactured");
  Scene<1> const scene(problem, choice_of({}));
  for (std::size_t i = 0; i < scene.particles().size(); ++i) {
    Vector<1> const x = scene.particles().positions()[i];
    double const T = problem.scalars.at(Field::temperature)(x, 0.0);
    BOOST_TEST(scene.particles().scalar(Field::temperature)[i] == T);
    BOOST_TEST(scene.particles().scalar(Field::conductivity)[i] == problem.conductivity(x, T));
  }
}

BOOST_AUTO_TEST_CASE(a_conductivity_that_depends_on_temperature_follows_it) {
  auto const problem = problem_of<1>("conduction/manufactured");
  Scene<1> scene(problem, choice_of({}));
  std::vector<double> const T(scene.particles().size(), 1.7);
  scene.set_temperature(T.data());
  for (std::size_t i = 0; i < T.size(); ++i) {
    BOOST_TEST(scene.particles().scalar(Field::temperature)[i] == 1.7);
    BOOST_TEST(scene.particles().scalar(Field::conductivity)[i] ==
               problem.conductivity(scene.particles().positions()[i], 1.7));
  }
}

BOOST_AUTO_TEST_CASE(heating_is_the_scheme_s_rate_plus_the_source) {
  auto const problem = problem_of<1>("conduction/manufactured");
  Scene<1> scene(problem, choice_of({}));
  scene.evaluate(0.02);
  std::vector<double> heating(scene.particles().size());
  scene.heating(0.02, heating.data());
  double power = 0.0;
  for (std::size_t i = 0; i < heating.size(); ++i) {
    double const source = problem.source(scene.particles().positions()[i], 0.02);
    BOOST_TEST(heating[i] == scene.particles().scalar(Field::heating)[i] + source, tolerance(1e-13));
    power += scene.particles().masses()[i] * source;
  }
  BOOST_TEST(scene.source_power(0.02) == power, tolerance(1e-13));
  BOOST_TEST((Scene<1>(problem_of<1>("conduction/slab-dirichlet"), choice_of({})).source_power(0.0)) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_wall_is_as_large_as_the_domain_is_across) {
  Problem<2> flat = problem_of<2>("conduction/manufactured", {{"dimension", 2.0}});
  Scene<2> const two(flat, choice_of({.resolution = 10}));
  BOOST_TEST(two.wall_areas() == (std::vector<double>{1.0, 1.0}), boost::test_tools::per_element());
  Problem<3> deep = problem_of<3>("conduction/manufactured", {{"dimension", 3.0}});
  deep.domain.upper[1] = 2.0;
  deep.domain.upper[2] = 1.5;
  Scene<3> const three(deep, choice_of({.resolution = 6}));
  for (double const area : three.wall_areas()) BOOST_TEST(area == 3.0, tolerance(1e-13));
  Scene<1> const one(problem_of<1>("conduction/slab-flux"), choice_of({}));
  BOOST_TEST(one.wall_areas() == (std::vector<double>{1.0, 1.0}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_flux_walls_prescribe_is_their_flux_times_their_area) {
  Scene<1> slab(problem_of<1>("conduction/slab-flux", {{"flux", 2.5}}), choice_of({}));
  slab.evaluate(0.0);
  std::vector<Number> const power = slab.prescribed_wall_power(0.0);
  BOOST_TEST(power.size() == 2u);
  BOOST_TEST(power[0].value() == 2.5, tolerance(1e-13));
  BOOST_TEST(power[1].value() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_scheme_that_knows_of_no_flux_at_a_wall_has_no_prescribed_power_there) {
  auto const problem = problem_of<1>("conduction/slab-dirichlet");
  Scene<1> brookshaw(problem, choice_of({}));
  brookshaw.evaluate(0.0);
  for (Number const& power : brookshaw.prescribed_wall_power(0.0)) BOOST_TEST(!power.has_value());
  Scene<1> lucy(problem, choice_of({.formulation = "conduction/lucy-flux"}));
  lucy.evaluate(0.0);
  for (Number const& power : lucy.prescribed_wall_power(0.0)) BOOST_TEST(power.has_value());
}

BOOST_AUTO_TEST_CASE(without_wall_terms_the_walls_give_nothing) {
  Scene<1> scene(problem_of<1>("conduction/slab-dirichlet"), choice_of({.walls = false}));
  scene.evaluate(0.0);
  BOOST_TEST(scene.wall_power() == (std::vector<double>{0.0, 0.0}), boost::test_tools::per_element());
  BOOST_TEST(scene.prescribed_wall_power(0.0).empty());
  BOOST_TEST(scene.geometry().contacts.empty());
}

BOOST_AUTO_TEST_CASE(a_balanced_face_keeps_the_gradient_of_a_constant_zero_at_the_wall) {
  Scene<1> const scene(
      problem_of<1>("conduction/slab-dirichlet"),
      choice_of(
          {.formulation = "conduction/lucy-flux", .resolution = 30, .discretisation = weighted("balanced")}));
  auto const& contacts = scene.geometry().contacts[0];
  GatheredPairs<1> const pairs = gathered_pairs(scene.particles(), scene.geometry());
  BOOST_TEST(contacts.size() > 0u);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    std::size_t const i = contacts.particle[c];
    double sum = contacts.face_weight[c] * contacts.outward_normal[0];
    for (std::uint64_t k = scene.geometry().neighbours.first[i]; k < scene.geometry().neighbours.first[i + 1];
         ++k)
      sum += scene.spacing() * pairs.gradient(k)[0];
    BOOST_TEST(std::abs(sum) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(the_same_choice_gives_the_same_particles) {
  auto const problem = problem_of<1>("conduction/slab-dirichlet");
  auto const x = [&](std::uint64_t seed) {
    return Scene<1>(problem, choice_of({.discretisation = jittered_by(0.2, seed)}))
        .particles()
        .positions()
        .component(0);
  };
  BOOST_TEST(x(5) == x(5), boost::test_tools::per_element());
  BOOST_TEST(x(5)[3] != x(6)[3]);
}

BOOST_AUTO_TEST_CASE(an_unknown_formulation_is_refused) {
  BOOST_CHECK_THROW(
      (Scene<1>{problem_of<1>("conduction/slab-dirichlet"), choice_of({.formulation = "conduction/none"})}),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
