// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "cases/hydro/gresho.hpp"
#include "cases/hydro/noh.hpp"
#include "cases/hydro/sedov.hpp"
#include "tests/unit/cases/exact/numerics.hpp"

// Gas in boxes of two and three dimensions: what the cases make of the exact solutions.
BOOST_AUTO_TEST_SUITE(cases_hydro_boxes)

using namespace sphverify;
using namespace sphverify::tests;

/// The problem of a case, with some of its numbers set.
template <class GasCase, int Dim>
Problem<Dim> problem_of(std::map<std::string, ParameterValue> const& values = {}) {
  Parameters parameters(GasCase::info().parameters);
  if (parameters.all().contains("dimension")) parameters.set("dimension", static_cast<double>(Dim));
  for (auto const& [name, value] : values) parameters.set(name, value);
  return std::get<Problem<Dim>>(GasCase::problem(parameters));
}

/// Calls check.operator()<Dim>() for 1 (or `from`) to 3 dimensions.
template <int from, class Check>
void in_all_dimensions(Check const& check) {
  if constexpr (from == 1) check.template operator()<1>();
  check.template operator()<2>();
  check.template operator()<3>();
}

/// A direction off all axes and diagonals.
template <int Dim>
Vector<Dim> slanted() {
  Vector<Dim> direction;
  for (int k = 0; k < Dim; ++k) direction[k] = 1.0 + 0.3 * k;
  return direction.normalized();
}

/// Whether these are walls at rest, which prescribe that they are.
template <int Dim>
bool all_at_rest(Problem<Dim> const& problem) {
  for (Wall<Dim> const& wall : problem.walls) {
    if (!wall.velocity || !wall.path || wall.pressure) return false;
    if (wall.velocity(Vector<Dim>::Constant(0.3), 0.1) != Vector<Dim>::Zero()) return false;
    if (wall.path(0.1) != wall.point) return false;
  }
  return true;
}

/// Sum of f over the cells of the unit box, by their centres.
template <int Dim, class Function>
double midpoint_sum(Function const& f, int cells) {
  double const h = 1.0 / cells;
  double sum = 0.0;
  int const all = static_cast<int>(std::pow(cells, Dim) + 0.5);
  for (int i = 0; i < all; ++i) {
    Vector<Dim> x;
    for (int k = 0, rest = i; k < Dim; ++k, rest /= cells) x[k] = (rest % cells + 0.5) * h;
    sum += f(x);
  }
  return sum * std::pow(h, Dim);
}

BOOST_AUTO_TEST_CASE(sedov_box_holds_the_mass_it_had_and_the_energy_released_in_it) {
  in_all_dimensions<1>([]<int Dim>() {
    auto const problem = problem_of<SedovExplosion, Dim>({{"energy", 2.5}, {"density", 1.2}, {"gamma", 1.4}});
    BOOST_TEST_REQUIRE(problem.point_energy.has_value());
    BOOST_TEST(problem.point_energy->place.norm() == 0.0);
    double const released = problem.point_energy->energy;
    BOOST_TEST(released == 2.5 / (Dim == 1 ? 2.0 : Dim == 2 ? 4.0 : 8.0));
    for (double const t : {0.3 * problem.final_time, problem.final_time}) {
      // Cells that the shock cuts leave an error of first order, which averages out in part.
      int const cells = Dim == 1 ? 10000 : Dim == 2 ? 400 : 80;
      double const tolerance = Dim == 1 ? 1e-3 : Dim == 2 ? 3e-3 : 1e-2;
      auto const mass = [&](Vector<Dim> const& x) { return problem.scalars.at(Field::density)(x, t); };
      BOOST_TEST(midpoint_sum<Dim>(mass, cells) == 1.2, boost::test_tools::tolerance(tolerance));
      auto const energy = [&](Vector<Dim> const& x) {
        double const v = problem.vectors.at(Field::velocity)(x, t).norm();
        return mass(x) * (problem.scalars.at(Field::internal_energy)(x, t) + 0.5 * v * v);
      };
      BOOST_TEST(midpoint_sum<Dim>(energy, cells) == released, boost::test_tools::tolerance(tolerance));
    }
  });
}

BOOST_AUTO_TEST_CASE(sedov_starts_uniform_and_ends_with_its_shock_within_the_walls) {
  in_all_dimensions<1>([]<int Dim>() {
    auto const problem = problem_of<SedovExplosion, Dim>();
    BOOST_TEST(problem.walls.size() == 2u * Dim);
    BOOST_TEST(all_at_rest(problem));
    Vector<Dim> const direction = slanted<Dim>();
    for (double const r : {0.0, 0.01, 0.9}) {
      Vector<Dim> const x = r * direction;
      BOOST_TEST(problem.scalars.at(Field::density)(x, 0.0) == 1.0);
      BOOST_TEST(problem.scalars.at(Field::pressure)(x, 0.0) == 1e-6);
      BOOST_TEST(problem.scalars.at(Field::internal_energy)(x, 0.0) == 1.5e-6,
                 boost::test_tools::tolerance(1e-14));
      BOOST_TEST(problem.vectors.at(Field::velocity)(x, 0.0).norm() == 0.0);
      BOOST_TEST(problem.holds(x, 0.0));
    }
    double const end = problem.final_time;
    BOOST_TEST(problem.landmarks.at("shock")(end) == 0.7, boost::test_tools::tolerance(1e-12));
    Vector<Dim> const behind = 0.699 * direction;
    BOOST_TEST(problem.scalars.at(Field::density)(behind, end) > 3.5);
    Vector<Dim> const v = problem.vectors.at(Field::velocity)(behind, end);
    BOOST_TEST((v - v.norm() * direction).norm() < 1e-14);
    BOOST_TEST(v.norm() > 0.1);
    Vector<Dim> const ahead = 0.701 * direction;
    BOOST_TEST(problem.scalars.at(Field::density)(ahead, end) == 1.0);
    BOOST_TEST(problem.scalars.at(Field::pressure)(ahead, end) == 1e-6);
    // From 0.7 to 1, the shock takes (1/0.7)^((d+2)/2) times as long.
    double const hit = end * std::pow(1.0 / 0.7, 0.5 * Dim + 1.0);
    BOOST_CHECK_NO_THROW((problem_of<SedovExplosion, Dim>({{"final_time", 0.999 * hit}})));
    BOOST_CHECK_THROW((problem_of<SedovExplosion, Dim>({{"final_time", 1.001 * hit}})),
                      std::invalid_argument);
  });
}

BOOST_AUTO_TEST_CASE(sedov_is_compared_where_there_is_gas_and_refuses_a_weak_shock) {
  in_all_dimensions<1>([]<int Dim>() {
    auto const problem = problem_of<SedovExplosion, Dim>();
    double const t = problem.final_time;
    for (double r = 0.005; r < 1.0; r += 0.01) {
      Vector<Dim> const x = r * slanted<Dim>();
      BOOST_TEST(problem.holds(x, t) == (problem.scalars.at(Field::density)(x, t) >= 0.1), "r = " << r);
    }
    BOOST_TEST(!problem.holds(Vector<Dim>(0.01 * slanted<Dim>()), t));
    // The shock runs at about 1 then.
    BOOST_CHECK_THROW((problem_of<SedovExplosion, Dim>({{"pressure", 1e-2}})), std::invalid_argument);
    BOOST_CHECK_THROW((problem_of<SedovExplosion, Dim>({{"pressure", 0.0}})), std::invalid_argument);
    BOOST_CHECK_NO_THROW((problem_of<SedovExplosion, Dim>({{"pressure", 1e-5}})));
  });
}

/// Where gas is at a time that started at r0 towards the centre: it flies freely until the shock, which runs
/// at D from there, takes it, and then stays.
double place_of(double r0, double gamma, double t) {
  double const D = 0.5 * (gamma - 1.0);
  double const shocked_at = r0 / (1.0 + D);
  return t < shocked_at ? r0 - t : D * shocked_at;
}

BOOST_AUTO_TEST_CASE(noh_is_compared_on_the_gas_that_started_far_from_the_free_surface) {
  in_all_dimensions<2>([]<int Dim>() {
    for (double const gamma : {1.4, 5.0 / 3.0}) {
      auto const problem = problem_of<NohProblem, Dim>({{"gamma", gamma}, {"final_time", 0.6}});
      BOOST_TEST(problem.not_run_because.empty());
      BOOST_TEST(!problem.shocks);
      for (double const t : {0.0, 0.3, 0.6, 0.7, 0.8}) {
        for (double r0 = 0.0; r0 < 1.2; r0 += 0.007) {
          Vector<Dim> const x = place_of(r0, gamma, t) * slanted<Dim>();
          BOOST_TEST(problem.holds(x, t) == (r0 < 0.85), "started at " << r0 << ", t = " << t);
        }
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(noh_has_walls_through_the_origin_only_and_ends_before_its_free_surface_is_shocked) {
  in_all_dimensions<2>([]<int Dim>() {
    auto const problem = problem_of<NohProblem, Dim>();
    BOOST_TEST(problem.walls.size() == static_cast<std::size_t>(Dim));
    BOOST_TEST(all_at_rest(problem));
    for (std::size_t k = 0; k < problem.walls.size(); ++k) {
      BOOST_TEST(problem.walls[k].distance(Vector<Dim>::Zero()) == 0.0);
      Vector<Dim> x = Vector<Dim>::Ones();
      x[static_cast<int>(k)] = 0.25;
      BOOST_TEST(problem.walls[k].distance(x) == 0.25);
    }
    Vector<Dim> const x = 0.6 * slanted<Dim>();
    BOOST_TEST((problem.vectors.at(Field::velocity)(x, 0.0) + slanted<Dim>()).norm() < 1e-15);
    BOOST_TEST(problem.scalars.at(Field::density)(x, 0.0) == 1.0);
    BOOST_TEST(problem.scalars.at(Field::internal_energy)(x, 0.0) == 0.0);
    // 0.85/(1 + 1/3)
    BOOST_CHECK_NO_THROW((problem_of<NohProblem, Dim>({{"final_time", 0.637}})));
    BOOST_CHECK_THROW((problem_of<NohProblem, Dim>({{"final_time", 0.638}})), std::invalid_argument);
  });
}

BOOST_AUTO_TEST_CASE(noh_in_one_dimension_keeps_its_piston) {
  auto const problem = problem_of<NohProblem, 1>();
  BOOST_TEST(problem.walls.size() == 2u);
  BOOST_TEST(problem.walls[1].velocity(Vector<1>(1.0), 0.1)[0] == -1.0);
  BOOST_TEST(problem.walls[1].path(0.1)[0] == 0.9);
  BOOST_TEST(!problem.holds);
  BOOST_TEST(static_cast<bool>(problem.shocks));
  BOOST_CHECK_NO_THROW((problem_of<NohProblem, 1>({{"final_time", 0.749}})));
  BOOST_CHECK_THROW((problem_of<NohProblem, 1>({{"final_time", 0.751}})), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(gresho_is_steady_in_the_plane) {
  auto const problem = problem_of<GreshoVortex, 2>();
  auto const& v = problem.vectors.at(Field::velocity);
  auto const& P = problem.scalars.at(Field::pressure);
  double const h = 1e-3;
  for (Vector<2> const& x : {Vector<2>(0.03, -0.01), Vector<2>(-0.1, 0.12), Vector<2>(0.2, 0.2),
                             Vector<2>(-0.33, -0.05), Vector<2>(0.45, 0.4)}) {
    auto const slope = [&](auto const& f, int k) {
      return first_derivative([&](double s) { return f(Vector<2>(x + s * Vector<2>::Unit(k))); }, 0.0, h);
    };
    double divergence = 0.0;
    for (int i = 0; i < 2; ++i) {
      auto const component = [&](Vector<2> const& y) { return v(y, 0.3)[i]; };
      auto const pressure = [&](Vector<2> const& y) { return P(y, 0.3); };
      double const force = slope(pressure, i);  // of density 1
      BOOST_TEST(std::abs(v(x, 0.3)[0] * slope(component, 0) + v(x, 0.3)[1] * slope(component, 1) + force) <
                 1e-9);
      divergence += slope(component, i);
    }
    BOOST_TEST(std::abs(divergence) < 1e-9);
    BOOST_TEST((v(x, 0.0) - v(x, 0.9)).norm() == 0.0);
    BOOST_TEST(problem.scalars.at(Field::internal_energy)(x, 0.0) == P(x, 0.0) / 0.4,
               boost::test_tools::tolerance(1e-14));
  }
  BOOST_TEST(v(Vector<2>(0.1, 0.0), 0.0)[1] == 0.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(v(Vector<2>::Zero(), 0.0).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(gresho_has_periodic_sides_or_walls_at_rest) {
  auto const periodic = problem_of<GreshoVortex, 2>();
  BOOST_TEST(periodic.walls.empty());
  BOOST_TEST((periodic.domain.periodic[0] && periodic.domain.periodic[1]));
  auto const& v = periodic.vectors.at(Field::velocity);
  BOOST_TEST((v(Vector<2>(0.8, -0.1), 0.0) - v(Vector<2>(-0.2, -0.1), 0.0)).norm() < 1e-14);
  auto const walled = problem_of<GreshoVortex, 2>({{"boundary", std::string("velocity")}});
  BOOST_TEST(walled.walls.size() == 4u);
  BOOST_TEST(all_at_rest(walled));
  BOOST_TEST(!walled.domain.is_periodic());
  BOOST_CHECK_THROW((problem_of<GreshoVortex, 2>({{"boundary", std::string("pressure")}})),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(gresho_takes_its_pressure_from_the_mach_number) {
  Vector<2> const fastest(0.0, -0.2);
  auto const usual = problem_of<GreshoVortex, 2>();
  BOOST_TEST(usual.scalars.at(Field::pressure)(fastest, 0.0) == 5.5, boost::test_tools::tolerance(1e-14));
  for (double const mach : {0.01, 0.5}) {
    auto const problem = problem_of<GreshoVortex, 2>({{"mach", mach}});
    double const e = problem.scalars.at(Field::internal_energy)(fastest, 0.0);
    double const sound = std::sqrt(1.4 * 0.4 * e);
    BOOST_TEST(problem.vectors.at(Field::velocity)(fastest, 0.0).norm() / sound == mach,
               boost::test_tools::tolerance(1e-12));
  }
  BOOST_CHECK_THROW((problem_of<GreshoVortex, 2>({{"mach", 1.3}})), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
