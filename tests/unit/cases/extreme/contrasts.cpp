// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "cases/extreme/cold_front.hpp"
#include "cases/extreme/conductivity_contrast.hpp"
#include "cases/extreme/density_contrast.hpp"
#include "cases/extreme/radiative_cooling.hpp"
#include "cases/extreme/radiative_wall.hpp"
#include "formulations/layouts/layout.hpp"

// What the cases make of the exact solutions, where the contract does not look.
BOOST_AUTO_TEST_SUITE(cases_extreme_contrasts)

using namespace sphverify;

template <class ExtremeCase, int Dim = 1>
Problem<Dim> problem_of(std::map<std::string, ParameterValue> const& values = {}) {
  Parameters parameters(ExtremeCase::info().parameters);
  parameters.set("dimension", static_cast<double>(Dim));
  for (auto const& [name, value] : values) parameters.set(name, value);
  return std::get<Problem<Dim>>(ExtremeCase::problem(parameters));
}

template <int Dim>
double at(Problem<Dim> const& problem, Field field, double x, double t) {
  return problem.scalars.at(field)(Vector<Dim>::Constant(x), t);
}

BOOST_AUTO_TEST_CASE(density_jumps_by_the_contrast_and_pressure_does_not) {
  for (double const contrast : {1e-3, 1.0, 1e6}) {
    auto const problem = problem_of<DensityContrast, 2>({{"contrast", contrast}, {"pressure", 3.0}});
    for (double const t : {0.0, 0.7}) {
      BOOST_TEST(at(problem, Field::density, 0.49, t) == contrast);
      BOOST_TEST(at(problem, Field::density, 0.51, t) == 1.0);
      BOOST_TEST(at(problem, Field::pressure, 0.49, t) == 3.0);
      BOOST_TEST(at(problem, Field::pressure, 0.51, t) == 3.0);
      double const energies =
          at(problem, Field::internal_energy, 0.51, t) / at(problem, Field::internal_energy, 0.49, t);
      BOOST_TEST(energies == contrast, boost::test_tools::tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(layouts_choose_between_unequal_and_equal_masses) {
  auto const problem = problem_of<DensityContrast>({{"contrast", 9.0}});
  auto const density = [&](double x) { return at(problem, Field::density, x, 0.0); };
  auto const masses = [&](Layout<1> const& layout) {
    std::pair<double, double> least_and_most{1e300, 0.0};
    std::size_t light = 0;
    for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
      double const mass = density(layout.positions[i][0]) * layout.volumes[i];
      least_and_most = {std::min(least_and_most.first, mass), std::max(least_and_most.second, mass)};
      light += layout.positions[i][0] > 0.5 ? 1 : 0;
    }
    return std::tuple{least_and_most.second / least_and_most.first, light};
  };
  auto const [unequal, half] = masses(lattice(problem.domain, 100));
  BOOST_TEST(unequal == 9.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(half == 50u);
  auto const [equal, tenth] = masses(equal_mass(problem.domain, 100, density));
  BOOST_TEST(equal == 1.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(tenth == 10u);
}

BOOST_AUTO_TEST_CASE(walls_of_the_contrast_stand_still_or_press) {
  auto const standing = problem_of<DensityContrast, 3>();
  BOOST_TEST(standing.walls.size() == 6u);
  for (auto const& wall : standing.walls) {
    BOOST_TEST((wall.velocity && wall.path && !wall.pressure));
    BOOST_TEST(wall.velocity(Vector<3>::Zero(), 0.3).norm() == 0.0);
  }
  auto const pressing = problem_of<DensityContrast, 3>({{"boundary", std::string("pressure")}});
  for (auto const& wall : pressing.walls) {
    BOOST_TEST((wall.pressure && !wall.velocity && !wall.path));
    BOOST_TEST(wall.pressure(Vector<3>::Zero(), 0.3) == 1.0);
  }
}

BOOST_AUTO_TEST_CASE(layers_conduct_by_their_contrast) {
  for (double const contrast : {1e-4, 1e8}) {
    auto const problem = problem_of<ConductivityContrast>({{"contrast", contrast}});
    BOOST_TEST(problem.conductivity(Vector<1>(0.49), 7.0) == 1.0);
    BOOST_TEST(problem.conductivity(Vector<1>(0.51), 7.0) == contrast);
    BOOST_TEST(problem.walls[0].conductivity(Vector<1>(0.0), 0.1) == 1.0);
    BOOST_TEST(problem.walls[1].conductivity(Vector<1>(1.0), 0.1) == contrast);
    BOOST_TEST(problem.walls[0].temperature(Vector<1>(0.0), 0.01) == 1.0);
    BOOST_TEST(problem.walls[1].temperature(Vector<1>(1.0), 0.01) == 2.0);
  }
}

BOOST_AUTO_TEST_CASE(the_mode_decays_at_the_rate_that_is_told) {
  auto const problem = problem_of<ConductivityContrast>({{"contrast", 7.0}, {"amplitude", 3.0}});
  auto const steady = problem_of<ConductivityContrast>({{"contrast", 7.0}, {"amplitude", 0.0}});
  double const rate = problem.landmarks.at("decay_rate")(0.0);
  auto const departure = [&](double t) {
    return at(problem, Field::temperature, 0.3, t) - at(steady, Field::temperature, 0.3, t);
  };
  BOOST_TEST(departure(0.05) == departure(0.0) * std::exp(-0.05 * rate), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(departure(0.0) > 2.0);
}

BOOST_AUTO_TEST_CASE(the_exponent_of_the_cold_front_is_that_of_its_conductivity) {
  for (double const n : {0.0, 3.0, 6.5}) {
    auto const problem = problem_of<ColdFront>({{"exponent", n}, {"ratio", 1e4}, {"conductivity", 2.0}});
    BOOST_TEST(problem.conductivity(Vector<1>(0.4), 0.5) == 2.0 * std::pow(0.5, n),
               boost::test_tools::tolerance(1e-14));
    BOOST_TEST(problem.conductivity_depends_on_temperature == (n > 0.0));
    BOOST_TEST(at(problem, Field::temperature, 0.4, 0.0) == 1e-4);
    BOOST_TEST(at(problem, Field::temperature, 0.0, 0.01) == 1.0);
    BOOST_TEST(problem.landmarks.contains("front") == (n > 0.0));
  }
}

BOOST_AUTO_TEST_CASE(a_hardly_nonlinear_cold_front_is_the_linear_one) {
  auto const linear = problem_of<ColdFront>();
  auto const nearly = problem_of<ColdFront>({{"exponent", 1e-7}});
  for (double x = 0.05; x < 1.0; x += 0.05) {
    BOOST_TEST(std::abs(at(linear, Field::temperature, x, 0.05) - at(nearly, Field::temperature, x, 0.05)) <
               1e-6);
  }
}

BOOST_AUTO_TEST_CASE(the_radiating_wall_prescribes_the_flux_of_its_exact_temperature_and_no_temperature) {
  auto const problem = problem_of<RadiativeWall>({{"radiation", 0.4}, {"environment", 0.5}});
  BOOST_TEST((!problem.walls[0].temperature && !problem.walls[1].temperature));
  for (double const t : {0.0, 0.02, 0.05}) {
    double const T = at(problem, Field::temperature, 1.0, t);
    BOOST_TEST(problem.walls[0].flux(Vector<1>(0.0), t)[0] == 0.0);
    BOOST_TEST(problem.walls[1].flux(Vector<1>(1.0), t)[0] == 0.4 * (std::pow(T, 4) - std::pow(0.5, 4)),
               boost::test_tools::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(the_radiating_half_space_loses_heat_by_its_own_temperature_and_is_no_linear_problem) {
  auto const problem = problem_of<RadiativeCooling>({{"radiation", 0.4}, {"environment", 0.5}});
  Wall<1> const& wall = problem.walls[0];
  BOOST_TEST((!wall.temperature && !wall.flux && wall.heat_loss));
  BOOST_TEST(wall.prescribes(BoundaryValue::flux));
  BOOST_TEST(wall.heat_loss->environment == 0.5);
  BOOST_TEST(wall.heat_loss->flux(1.3) == 0.4 * (std::pow(1.3, 4) - std::pow(0.5, 4)),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(!problem.conducts_linearly());
  BOOST_TEST(problem_of<RadiativeWall>().conducts_linearly());
  BOOST_TEST(!problem_of<ColdFront>({{"exponent", 3.0}}).conducts_linearly());
  BOOST_TEST(problem.landmarks.at("wall_temperature")(0.05) == at(problem, Field::temperature, 0.0, 0.05));
}

BOOST_AUTO_TEST_SUITE_END()
