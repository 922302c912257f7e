// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/second_law.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "harness/measure/sample_times.hpp"
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

/// Waves of opposite sign between walls at 1 and 2: for a moment two passes send heat from cold to hot.
RunChoice const fleeting{
    .formulation = "conduction/lucy-flux",
    .resolution = 30,
    .parameters = {{"modes", std::vector<std::vector<double>>{{1.0, -0.8}, {4.0, 0.6}}}}};

/// Extremes of the semi-discrete equations dT/dt = A T + b by the matrix exponential, at times that are
/// given: the integrators and the product's search for neighbours have no part in it.
struct Extremes {
  double cold_to_hot = 0.0, overshoot = 0.0, undershoot = 0.0, least_production = 1.0;
};

class Exponential {
 public:
  explicit Exponential(RunChoice const& choice) : scene_(make_scene(choice)) {
    auto const n = static_cast<Eigen::Index>(scene_.particles().size());
    // (T, 1)' = [[A, b], [0, 0]] (T, 1)
    generator_ = Eigen::MatrixXd::Zero(n + 1, n + 1);
    generator_.col(n).head(n) = heating(Eigen::VectorXd::Zero(n));
    for (Eigen::Index k = 0; k < n; ++k)
      generator_.col(k).head(n) = heating(Eigen::VectorXd::Unit(n, k)) - generator_.col(n).head(n);
    start_ = Eigen::VectorXd::Ones(n + 1);
    for (Eigen::Index i = 0; i < n; ++i)
      start_[i] = scene_.problem().scalars.at(Field::temperature)(at(i), 0.0);
  }

  Extremes extremes(std::vector<double> const& times) {
    Eigen::Index const n = start_.size() - 1;
    Extremes found;
    double low = std::min(1.0, start_.head(n).minCoeff());
    double high = std::max(2.0, start_.head(n).maxCoeff());
    for (double const t : times) {
      Eigen::VectorXd const state = (generator_ * t).exp() * start_;
      Eigen::VectorXd const T = state.head(n);
      Eigen::VectorXd const rate = (generator_ * state).head(n);
      found.overshoot = std::max(found.overshoot, (T.maxCoeff() - high) / (high - low));
      found.undershoot = std::max(found.undershoot, (low - T.minCoeff()) / (high - low));
      double const largest = rate.cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < n; ++i) {
        // h/dx = 1.2: two neighbours to either side, felt through two passes; a wall by the nearest two.
        double coldest = 1e9, hottest = -1e9;
        for (Eigen::Index j = std::max<Eigen::Index>(0, i - 4); j <= std::min(n - 1, i + 4); ++j) {
          if (j == i) continue;
          coldest = std::min(coldest, T[j]);
          hottest = std::max(hottest, T[j]);
        }
        if (i <= 3) coldest = std::min(coldest, 1.0), hottest = std::max(hottest, 1.0);
        if (i >= n - 4) coldest = std::min(coldest, 2.0), hottest = std::max(hottest, 2.0);
        double const wrong = T[i] >= hottest ? rate[i] : T[i] <= coldest ? -rate[i] : 0.0;
        found.cold_to_hot = std::max(found.cold_to_hot, wrong / largest);
      }
      // What the walls give at 1 and 2 is what the gas gains and pairs do not lose: by the scene itself.
      scene_.set_temperature(T.data());
      scene_.evaluate(t);
      double production = 0.0, turnover = 0.0;
      for (Eigen::Index i = 0; i < n; ++i) {
        double const gain = scene_.particles().masses()[static_cast<std::size_t>(i)] * rate[i] / T[i];
        production += gain;
        turnover += std::abs(gain);
      }
      auto const power = scene_.wall_power();
      production -= power[0] / 1.0 + power[1] / 2.0;
      turnover += std::abs(power[0]) / 1.0 + std::abs(power[1]) / 2.0;
      found.least_production = std::min(found.least_production, production / turnover);
    }
    return found;
  }

 private:
  static Scene<1> make_scene(RunChoice const& choice) {
    RunSpec const spec = make_spec(choice);
    return Scene<1>(std::get<Problem<1>>(spec.scene_case->problem(spec.parameters)),
                    {.formulation = choice.formulation,
                     .walls = true,
                     .discretisation = choice.discretisation,
                     .resolution = choice.resolution,
                     .smoothing_ratio = choice.smoothing_ratio,
                     .threads = 1});
  }
  Vector<1> at(Eigen::Index i) const { return scene_.particles().positions()[static_cast<std::size_t>(i)]; }
  Eigen::VectorXd heating(Eigen::VectorXd const& T) {
    Eigen::VectorXd out(T.size());
    scene_.set_temperature(T.data());
    scene_.evaluate(0.0);
    scene_.heating(0.0, out.data());
    return out;
  }

  Scene<1> scene_;
  Eigen::MatrixXd generator_;
  Eigen::VectorXd start_;
};

BOOST_AUTO_TEST_CASE(extremes_do_not_depend_on_where_the_integrator_steps) {
  Extremes const exact = Exponential(fleeting).extremes(sample_times(0.05));
  BOOST_TEST_MESSAGE("cold to hot " << exact.cold_to_hot << ", overshoot " << exact.overshoot
                                    << ", undershoot " << exact.undershoot << ", least production "
                                    << exact.least_production);
  BOOST_TEST(exact.cold_to_hot > 0.1);
  for (char const* integrator : {"bdf", "runge-kutta", "runge-kutta-chebyshev", "implicit-runge-kutta"}) {
    BOOST_TEST_CONTEXT(integrator) {
      RunChoice choice = fleeting;
      choice.discretisation.integrator = integrator;
      SecondLaw const law = *run(choice, {Measure::second_law}).second_law;
      BOOST_TEST_MESSAGE(integrator << ": " << law.cold_to_hot.size - exact.cold_to_hot << " "
                                    << law.overshoot.size - exact.overshoot << " "
                                    << law.undershoot.size - exact.undershoot << " "
                                    << *law.smallest_entropy_production - exact.least_production);
      BOOST_TEST(law.instants == sample_times(0.05).size());
      // The tolerance that docs/measures.md states.
      BOOST_TEST(std::abs(law.cold_to_hot.size - exact.cold_to_hot) < 1e-4);
      BOOST_TEST(std::abs(law.overshoot.size - exact.overshoot) < 1e-4);
      BOOST_TEST(std::abs(law.undershoot.size - exact.undershoot) < 1e-4);
      BOOST_TEST(std::abs(*law.smallest_entropy_production - exact.least_production) < 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_instants_looked_at_come_close_to_the_worst_of_all) {
  std::vector<double> dense;
  for (int k = 0; k <= 4000; ++k) dense.push_back(0.05 * k / 4000);
  Extremes const all = Exponential(fleeting).extremes(dense);
  Extremes const seen = Exponential(fleeting).extremes(sample_times(0.05));
  BOOST_TEST_MESSAGE("cold to hot: " << seen.cold_to_hot << " of " << all.cold_to_hot);
  BOOST_TEST(seen.cold_to_hot > 0.9 * all.cold_to_hot);
}

BOOST_AUTO_TEST_CASE(a_history_is_the_same_whatever_integrates) {
  RunChoice choice = fleeting;
  MeasureSet const measure{Measure::error, Measure::history, Measure::conservation};
  History const by_bdf = *run(choice, measure).history;
  for (char const* integrator : {"runge-kutta", "runge-kutta-chebyshev", "implicit-runge-kutta"}) {
    choice.discretisation.integrator = integrator;
    RunRecord const record = run(choice, measure);
    History const& other = *record.history;
    BOOST_TEST(other.time == by_bdf.time, boost::test_tools::per_element());
    BOOST_TEST(other.time == sample_times(0.05), boost::test_tools::per_element());
    for (std::size_t k = 0; k < other.time.size(); ++k) {
      BOOST_TEST(std::abs(other.energy[k] - by_bdf.energy[k]) < 2e-3);
      BOOST_TEST(std::abs(other.exchanged[k] - by_bdf.exchanged[k]) < 2e-3);
    }
    BOOST_TEST(other.energy.back() == record.conservation.at("energy").final);
  }
}

BOOST_AUTO_TEST_CASE(near_a_steady_state_ratios_of_what_is_left_are_not_taken) {
  // After a hundred times of relaxation only rounding is left to conduct.
  RunChoice choice{
      .formulation = "conduction/brookshaw", .resolution = 20, .parameters = {{"final_time", 10.0}}};
  for (char const* integrator : {"bdf", "runge-kutta-chebyshev"}) {
    choice.discretisation.integrator = integrator;
    SecondLaw const law = *run(choice, {Measure::second_law}).second_law;
    BOOST_TEST(law.cold_to_hot.size == 0.0);
    BOOST_TEST(law.smallest_entropy_production.value() > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_rate_that_is_no_number_is_no_law_kept) {
  Scene<1> scene = scene_of("conduction/slab-insulated", "conduction/brookshaw", 20);
  SecondLawWatch<1> watch(scene, 1.5);
  std::vector<double> T = initial(scene);
  watch.observe(0.0, T.data());
  T[7] = std::numeric_limits<double>::infinity();
  watch.observe(0.01, T.data());
  BOOST_TEST(watch.result().remark.find("is not finite at t = 0.01") != std::string::npos);
  BOOST_TEST(std::isnan(watch.result().cold_to_hot.size));
  BOOST_TEST(!watch.result().smallest_entropy_production.has_value());
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
