// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/extreme/units.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <string>

BOOST_AUTO_TEST_SUITE(cases_extreme_units)

using namespace sphverify;

template <class UnitCase, int Dim>
Problem<Dim> problem_of(Units const& units) {
  Parameters parameters(UnitCase::info().parameters);
  if (parameters.all().contains("dimension")) parameters.set("dimension", static_cast<double>(Dim));
  parameters.set("length_unit", units.length);
  parameters.set("mass_unit", units.mass);
  parameters.set("time_unit", units.time);
  if (parameters.all().contains("temperature_unit")) parameters.set("temperature_unit", units.temperature);
  return std::get<Problem<Dim>>(UnitCase::problem(parameters));
}

/// Exponents of length, mass, time and temperature.
using Powers = std::array<int, 4>;

double factor(Units const& units, Powers const& powers) {
  return std::pow(units.length, powers[0]) * std::pow(units.mass, powers[1]) *
         std::pow(units.time, powers[2]) * std::pow(units.temperature, powers[3]);
}

// Of a field in Dim dimensions, from textbooks' units: kg/m^Dim, m/s, N/m^(Dim-1), J/kg; heat is in kg K.
template <int Dim>
std::map<Field, Powers> const dimensions{
    {Field::density, {-Dim, 1, 0, 0}},      {Field::velocity, {1, 0, -1, 0}},
    {Field::pressure, {2 - Dim, 1, -2, 0}}, {Field::internal_energy, {2, 0, -2, 0}},
    {Field::temperature, {0, 0, 0, 1}},     {Field::flux, {1 - Dim, 1, -1, 1}}};
template <int Dim>
constexpr Powers conductivity_dimensions{2 - Dim, 1, -1, 0};

Units const powers_of_two{0x1p100, 0x1p-60, 0x1p80, 0x1p-100};
Units const others{3.7, 0.013, 1e5, 290.0};

/// Compares a problem with the same one in units of 1, number by number.
template <class UnitCase, int Dim>
void check(Units const& units, double tolerance) {
  auto const plain = problem_of<UnitCase, Dim>({});
  auto const scaled = problem_of<UnitCase, Dim>(units);
  auto const same = [&](double found, double expected) {
    BOOST_TEST(std::abs(found - expected) <= tolerance * std::abs(expected),
               found << " instead of " << expected);
  };
  double const L = units.length;
  same(scaled.final_time, plain.final_time * units.time);
  for (int k = 0; k < Dim; ++k) {
    same(scaled.domain.lower[k], plain.domain.lower[k] * L);
    same(scaled.domain.upper[k], plain.domain.upper[k] * L);
  }
  BOOST_TEST(scaled.gamma == plain.gamma);
  for (double const part : {0.0, 0.4, 1.0}) {
    double const t = part * plain.final_time;
    double const T = scaled.final_time * part;
    for (double const place : {0.0, 0.13, 0.5, 0.71, 1.0}) {
      Vector<Dim> const x = Vector<Dim>::Constant(place);
      Vector<Dim> const X = x * L;
      for (auto const& [field, f] : plain.scalars)
        same(scaled.scalars.at(field)(X, T), f(x, t) * factor(units, dimensions<Dim>.at(field)));
      for (auto const& [field, f] : plain.vectors)
        same(scaled.vectors.at(field)(X, T)[0], f(x, t)[0] * factor(units, dimensions<Dim>.at(field)));
      double const K = factor(units, conductivity_dimensions<Dim>);
      if (plain.conductivity)
        same(scaled.conductivity(X, 1.3 * units.temperature), plain.conductivity(x, 1.3) * K);
      for (std::size_t w = 0; w < 2; ++w) {
        auto const& wall = plain.walls[w];
        auto const& other = scaled.walls[w];
        same(other.distance(X), wall.distance(x) * L);
        if (wall.temperature) {
          same(other.temperature(X, T), wall.temperature(x, t) * units.temperature);
          same(other.conductivity(X, T), wall.conductivity(x, t) * K);
        }
        if (wall.velocity) same(other.velocity(X, T)[0], wall.velocity(x, t)[0] * L / units.time);
        if (wall.path) same(other.path(T)[0], wall.path(t)[0] * L);
      }
    }
    if (!plain.shocks || part == 0.0) continue;
    ShockFront const front = plain.shocks(t).at(0);
    ShockFront const other = scaled.shocks(T).at(0);
    double const P = factor(units, dimensions<Dim>.at(Field::pressure));
    same(other.position, front.position * L);
    same(other.plateau_lower, front.plateau_lower * L);
    same(other.plateau_upper, front.plateau_upper * L);
    same(other.pressure_ahead, front.pressure_ahead * P);
    same(other.pressure, front.pressure * P);
    same(other.velocity, front.velocity * L / units.time);
    same(other.density, front.density * factor(units, dimensions<Dim>.at(Field::density)));
  }
}

BOOST_AUTO_TEST_CASE(powers_of_two_change_no_bit_of_the_mantissas) {
  check<ConductionUnits, 1>(powers_of_two, 0.0);
  check<ConductionUnits, 2>(powers_of_two, 0.0);
  check<ConductionUnits, 3>(powers_of_two, 0.0);
  check<GasUnits, 1>(powers_of_two, 0.0);
}

BOOST_AUTO_TEST_CASE(other_units_change_no_more_than_rounding) {
  check<ConductionUnits, 1>(others, 1e-14);
  check<ConductionUnits, 2>(others, 1e-14);
  check<ConductionUnits, 3>(others, 1e-14);
  check<GasUnits, 1>(others, 1e-14);
}

BOOST_AUTO_TEST_CASE(sources_forces_conductivity_and_where_a_solution_holds_are_scaled_too) {
  Problem<1> plain;
  plain.domain = slab<1>(0.0, 1.0);
  plain.final_time = 2.0;
  plain.source = [](Vector<1> const& x, double t) { return x[0] + t; };
  plain.body_force = [](Vector<1> const& x, double t) { return Vector<1>(x[0] - t); };
  plain.holds = [](Vector<1> const& x, double t) { return x[0] > t; };
  plain.accuracy = 1e-12;
  plain.gamma = 1.4;
  Units const units{8.0, 2.0, 4.0, 16.0};
  Problem<1> const gas = in_units(plain, units);
  Vector<1> const x(0.25 * 8.0);
  double const t = 0.125 * 4.0;
  BOOST_TEST(gas.source(x, t) == 0.375 * 8.0 * 8.0 / (4.0 * 4.0 * 4.0));
  BOOST_TEST(gas.body_force(x, t)[0] == 0.125 * 8.0 / (4.0 * 4.0));
  BOOST_TEST(gas.holds(x, t));
  BOOST_TEST(!gas.holds(x, 3.0 * t));
  BOOST_TEST(gas.accuracy == 1e-12);
  plain.gamma = 0.0;
  plain.conductivity = [](Vector<1> const& y, double T) { return y[0] + T; };
  plain.walls = slab_walls(plain.domain);
  plain.walls[0].heat_loss = HeatLoss{.flux = [](double T) { return T - 0.5; }, .environment = 0.5};
  Problem<1> const heat = in_units(plain, units);
  BOOST_TEST(heat.walls[0].heat_loss->flux(3.0 * 16.0) == 2.5 * 16.0 * 2.0 / 8.0 * 8.0 / 4.0);
  BOOST_TEST(heat.walls[0].heat_loss->environment == 0.5 * 16.0);
  BOOST_TEST(!heat.walls[1].heat_loss);
  BOOST_TEST(heat.source(x, t) == 0.375 * 16.0 / 4.0);
  BOOST_TEST(heat.accuracy == 16e-12);
  BOOST_TEST(heat.conductivity(x, 3.0 * 16.0) == 3.25 * 2.0 * 8.0 / 4.0);
}

BOOST_AUTO_TEST_CASE(units_that_leave_no_numbers_are_refused) {
  for (Units const& units :
       {Units{0.0, 1.0, 1.0, 1.0}, Units{1.0, -1.0, 1.0, 1.0}, Units{1.0, 1.0, 1e-320, 1.0},
        Units{1.0, 1.0, 1e-200, 1e200}, Units{1e200, 1e-200, 1.0, 1.0}}) {
    BOOST_CHECK_THROW((problem_of<ConductionUnits, 1>(units)), std::invalid_argument);
  }
  BOOST_CHECK_THROW((problem_of<ConductionUnits, 3>({1e110, 1.0, 1.0, 1.0})), std::invalid_argument);
  BOOST_CHECK_THROW((problem_of<GasUnits, 1>({1e200, 1.0, 1.0, 1.0})), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
