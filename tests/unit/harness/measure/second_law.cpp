#include "harness/measure/second_law.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_second_law)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

Problem<1> problem_of(char const* id) {
  Case const* const one = find_case(id);
  return std::get<Problem<1>>(one->problem(Parameters(one->info.parameters)));
}

Scene<1> scene_of(char const* id, char const* formulation, int n) {
  RunChoice const run{.formulation = formulation, .resolution = n};
  return Scene<1>(problem_of(id), {.formulation = run.formulation,
                                   .walls = true,
                                   .discretisation = run.discretisation,
                                   .resolution = run.resolution,
                                   .smoothing_ratio = run.smoothing_ratio,
                                   .threads = 1});
}

/// Of slab-insulated at the start: mean 1, amplitude 0.5 at the outermost particles, nearly.
std::vector<double> initial(Scene<1> const& scene) {
  std::vector<double> T;
  for (std::size_t i = 0; i < scene.particles().size(); ++i)
    T.push_back(scene.problem().scalars.at(Field::temperature)(scene.particles().positions()[i], 0.0));
  return T;
}

BOOST_AUTO_TEST_CASE(a_temperature_beyond_all_that_was_is_an_overshoot) {
  Scene<1> scene = scene_of("conduction/slab-insulated", "conduction/brookshaw", 20);
  SecondLawWatch<1> watch(scene, 1.5);
  std::vector<double> T = initial(scene);
  watch.observe(0.0, T.data());
  BOOST_TEST(watch.result().overshoot.size == 0.0);
  double const range = T.front() - T.back();  // the initial state's, monotonic
  T[7] = T.front() + 0.1 * range;
  T[12] = T.back() - 0.2 * range;
  watch.observe(0.01, T.data());
  BOOST_TEST(watch.result().overshoot.size == 0.1, tolerance(1e-9));
  BOOST_TEST(watch.result().overshoot.time == 0.01);
  BOOST_TEST(watch.result().overshoot.position.at(0) == 0.375, tolerance(1e-12));
  BOOST_TEST(watch.result().undershoot.size == 0.2, tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_environment_of_a_wall_that_loses_heat_bounds_temperatures) {
  Scene<1> scene = scene_of("extreme/radiative-cooling", "conduction/brookshaw", 20);  // from 1 towards 0
  SecondLawWatch<1> watch(scene, 1.0);
  std::vector<double> T(20, 1.0);
  T[5] = 0.1;
  watch.observe(0.0, T.data());
  BOOST_TEST(watch.result().undershoot.size == 0.0);
  T[5] = -0.1;
  watch.observe(0.01, T.data());
  BOOST_TEST(watch.result().undershoot.size == 0.1, tolerance(1e-9));
  BOOST_TEST(watch.result().cold_to_hot.size == 0.0);
}

BOOST_AUTO_TEST_CASE(walls_widen_the_range_and_entropy_counts_what_they_give) {
  // Between walls at 1 and 2 the gas starts at the exact solution and is moved to 1: the wall at 2 heats it.
  Scene<1> scene = scene_of("conduction/slab-dirichlet", "conduction/brookshaw", 20);
  SecondLawWatch<1> watch(scene, 2.0);
  std::vector<double> const cold(20, 1.0);
  watch.observe(0.0, cold.data());
  BOOST_TEST(watch.result().overshoot.size == 0.0);
  // Gas at T gains P/T, the wall at 2 loses P/2: (1 - 1/2)/(1 + 1/2) of the turnover.
  BOOST_TEST(watch.result().smallest_entropy_production.value() == 1.0 / 3.0, tolerance(1e-6));
  BOOST_TEST(watch.result().cold_to_hot.size == 0.0);
}

BOOST_AUTO_TEST_CASE(pairwise_conduction_keeps_the_law_and_two_passes_on_disorder_do_not) {
  RunChoice choice{
      .scene_case = "conduction/slab-insulated", .resolution = 40, .discretisation = jittered_by(0.3, 2)};
  choice.formulation = "conduction/brookshaw";
  RunRecord const pairs = run(choice, {Measure::second_law});
  BOOST_TEST_REQUIRE(pairs.second_law.has_value());
  BOOST_TEST(pairs.second_law->cold_to_hot.size == 0.0);
  BOOST_TEST(pairs.second_law->overshoot.size < 1e-4);
  BOOST_TEST(pairs.second_law->smallest_entropy_production.value() >= 0.0);
  choice.formulation = "conduction/lucy-flux";
  RunRecord const two_pass = run(choice, {Measure::second_law});
  BOOST_TEST_REQUIRE(two_pass.second_law.has_value());
  BOOST_TEST(two_pass.second_law->cold_to_hot.size > 1e-3);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_judged_says_why) {
  RunChoice choice{
      .scene_case = "conduction/manufactured", .formulation = "conduction/brookshaw", .resolution = 20};
  BOOST_TEST(run(choice, {Measure::second_law}).second_law->remark.find("source") != std::string::npos);
  choice.scene_case = "conduction/slab-flux";
  SecondLaw const heated = *run(choice, {Measure::second_law}).second_law;
  BOOST_TEST(heated.remark.find("brings heat") != std::string::npos);
  BOOST_TEST(!heated.smallest_entropy_production.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
