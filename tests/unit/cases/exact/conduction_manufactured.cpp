// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/conduction_manufactured.hpp"

#include <boost/mpl/list.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_conduction_manufactured)

using namespace sphverify::exact;
using namespace sphverify::tests;
using sphverify::Vector;

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;
using Dimensions = boost::mpl::list<Dimension<1>, Dimension<2>, Dimension<3>>;
using Transverse = boost::mpl::list<Dimension<2>, Dimension<3>>;

constexpr double scale = 0.7;

template <int Dim>
std::vector<Vector<Dim>> points(std::size_t count) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vector<Dim>> result(count);
  for (Vector<Dim>& r : result) {
    for (int axis = 0; axis < Dim; ++axis) r[axis] = uniform(generator);
  }
  return result;
}

/// The point moved by s along an axis.
template <int Dim>
Vector<Dim> moved(Vector<Dim> const& r, int axis, double s) {
  return r + s * Vector<Dim>::Unit(axis);
}

// The divergence by differences of K times differences of T, from temperature and conductivity alone. Steps
// of 0.004: truncation below 1e-8 for wave numbers up to 10 and products of three waves, rounding about
// 1e-10.
BOOST_AUTO_TEST_CASE_TEMPLATE(temperature_solves_the_equation_with_the_source, D, Dimensions) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  double largest_source = 0.0;
  for (Vector<Dim> const& r : points<Dim>(60)) {
    for (double const t : {0.1, 1.0}) {
      double divergence = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        auto conducted = [&](double s) {
          Vector<Dim> const p = moved<Dim>(r, axis, s);
          double const slope = first_derivative(
              [&](double q) { return exact.temperature(moved<Dim>(p, axis, q), t); }, 0.0, 0.004);
          return exact.conductivity(p, exact.temperature(p, t)) * slope;
        };
        divergence += first_derivative(conducted, 0.0, 0.004);
      }
      double const rate = first_derivative([&](double s) { return exact.temperature(r, s); }, t, 0.004);
      double const source = exact.source(r, t);
      BOOST_TEST(std::abs(rate - divergence / exact.density(r) - source) < 1e-6,
                 "r = " << r.transpose() << ", t = " << t);
      largest_source = std::max(largest_source, std::abs(source));
    }
  }
  BOOST_TEST(largest_source > 1.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_is_the_derivative_of_the_temperature, D, Dimensions) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  for (Vector<Dim> const& r : points<Dim>(20)) {
    Vector<Dim> const gradient = exact.temperature_gradient(r, 0.3);
    for (int axis = 0; axis < Dim; ++axis) {
      auto along = [&](double s) { return exact.temperature(moved<Dim>(r, axis, s), 0.3); };
      BOOST_TEST(std::abs(gradient[axis] - first_derivative(along, 0.0, 0.004)) < 1e-9);
    }
    Vector<Dim> const flux = exact.flux(r, 0.3);
    double const conductivity = exact.conductivity(r, exact.temperature(r, 0.3));
    BOOST_TEST((flux + conductivity * gradient).norm() < 1e-13);
  }
}

// Quadrature over the box; the periodic axis by the trapezoidal rule, exact to rounding with 32 points.
BOOST_AUTO_TEST_CASE(energy_changes_by_wall_fluxes_and_source) {
  ConductionManufactured<2> const exact(scale);
  double const t = 0.4;
  constexpr int count = 32;
  auto mean_over_y = [](auto const& f) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += f(static_cast<double>(i) / count);
    return sum / count;
  };
  auto over_box = [&](auto const& f) {
    return integral([&](double x) { return mean_over_y([&](double y) { return f(Vector<2>(x, y)); }); }, 0.0,
                    1.0);
  };
  auto energy = [&](double s) {
    return over_box([&](Vector<2> const& r) { return exact.density(r) * exact.temperature(r, s); });
  };
  double const source = over_box([&](Vector<2> const& r) { return exact.density(r) * exact.source(r, t); });
  auto through = [&](double x) {
    return mean_over_y([&](double y) { return exact.flux(Vector<2>(x, y), t)[0]; });
  };
  BOOST_TEST(std::abs(first_derivative(energy, t, 0.01) - source - through(0.0) + through(1.0)) < 1e-10);
  BOOST_TEST(std::abs(through(0.0) - through(1.0)) > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_stay_within_their_stated_positive_bounds, D, Dimensions) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  for (Vector<Dim> const& r : points<Dim>(3000)) {
    for (double const t : {0.0, 0.5, 100.0}) {
      double const temperature = exact.temperature(r, t);
      BOOST_TEST_REQUIRE(temperature >= 1.5);
      BOOST_TEST_REQUIRE(temperature <= 3.1);
      double const conductivity = exact.conductivity(r, temperature);
      BOOST_TEST_REQUIRE(conductivity >= 0.5 * scale);
      BOOST_TEST_REQUIRE(conductivity <= 1.9 * scale);
    }
    BOOST_TEST_REQUIRE(exact.density(r) >= 1.0);
    BOOST_TEST_REQUIRE(exact.density(r) <= 1.6);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_repeat_along_every_axis_but_the_first, D, Dimensions) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  for (Vector<Dim> const& r : points<Dim>(20)) {
    for (int axis = 0; axis < Dim; ++axis) {
      Vector<Dim> const p = moved<Dim>(r, axis, 1.0);
      bool const periodic = axis > 0;
      double const value = exact.temperature(r, 0.2);
      BOOST_TEST((std::abs(exact.temperature(p, 0.2) - value) < 1e-13) == periodic);
      BOOST_TEST((std::abs(exact.density(p) - exact.density(r)) < 1e-13) == periodic);
      BOOST_TEST((std::abs(exact.conductivity(p, value) - exact.conductivity(r, value)) < 1e-13) == periodic);
      BOOST_TEST((std::abs(exact.source(p, 0.2) - exact.source(r, 0.2)) < 1e-11) == periodic);
    }
  }
}

BOOST_AUTO_TEST_CASE(walls_differ_in_value_flux_and_curvature_and_none_vanishes) {
  ConductionManufactured<1> const exact(scale);
  for (double const t : {0.0, 0.05, 1.0}) {
    Vector<1> const left(0.0);
    Vector<1> const right(1.0);
    auto curvature = [&](double x) {
      return second_derivative([&](double s) { return exact.temperature(Vector<1>(s), t); }, x, 0.01);
    };
    BOOST_TEST(std::abs(exact.temperature(left, t) - exact.temperature(right, t)) > 0.3);
    BOOST_TEST(std::abs(std::abs(exact.flux(left, t)[0]) - std::abs(exact.flux(right, t)[0])) > 0.3);
    BOOST_TEST(std::abs(std::abs(curvature(0.0)) - std::abs(curvature(1.0))) > 0.03);
    for (double const wall : {0.0, 1.0}) {
      BOOST_TEST(std::abs(exact.flux(Vector<1>(wall), t)[0]) > 0.03);
      BOOST_TEST(std::abs(curvature(wall)) > 0.3);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradients_of_density_conductivity_and_temperature_are_not_parallel, D,
                              Transverse) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  auto gradient = [](auto const& f, Vector<Dim> const& r) {
    Vector<Dim> result;
    for (int axis = 0; axis < Dim; ++axis) {
      result[axis] = first_derivative([&](double s) { return f(moved<Dim>(r, axis, s)); }, 0.0, 0.004);
    }
    return result;
  };
  auto sine = [](Vector<Dim> const& a, Vector<Dim> const& b) {
    double const cosine = a.dot(b) / (a.norm() * b.norm());
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  };
  double temperature_density = 0.0;
  double temperature_conductivity = 0.0;
  double density_conductivity = 0.0;
  auto const places = points<Dim>(50);
  for (Vector<Dim> const& r : places) {
    Vector<Dim> const by_temperature = exact.temperature_gradient(r, 0.1);
    Vector<Dim> const by_density = gradient([&](Vector<Dim> const& p) { return exact.density(p); }, r);
    Vector<Dim> const by_conductivity =
        gradient([&](Vector<Dim> const& p) { return exact.conductivity(p, 2.0); }, r);
    temperature_density += sine(by_temperature, by_density) / 50.0;
    temperature_conductivity += sine(by_temperature, by_conductivity) / 50.0;
    density_conductivity += sine(by_density, by_conductivity) / 50.0;
  }
  BOOST_TEST(temperature_density > 0.1);
  BOOST_TEST(temperature_conductivity > 0.1);
  BOOST_TEST(density_conductivity > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(conductivity_depends_on_place_and_temperature_and_carries_the_scale, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  ConductionManufactured<Dim> const exact(scale);
  ConductionManufactured<Dim> const doubled(2.0 * scale);
  Vector<Dim> const r = Vector<Dim>::Constant(0.3);
  Vector<Dim> const p = moved<Dim>(r, 0, 0.5);
  BOOST_TEST(std::abs(exact.conductivity(r, 2.0) - exact.conductivity(p, 2.0)) > 0.1 * scale);
  BOOST_TEST(std::abs(exact.conductivity(r, 2.0) - exact.conductivity(r, 3.0)) > 0.1 * scale);
  BOOST_TEST(std::abs(doubled.conductivity(r, 2.0) - 2.0 * exact.conductivity(r, 2.0)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(one_dimensional_fields_have_their_documented_values) {
  ConductionManufactured<1> const exact(2.0);
  Vector<1> const r(0.5);
  double const t = 0.2;
  double const temperature = 2.3 + 0.25 * (1.0 + std::exp(-0.2)) * std::sin(1.55);
  BOOST_TEST(std::abs(exact.temperature(r, t) - temperature) <= exact.accuracy());
  BOOST_TEST(std::abs(exact.density(r) - (1.3 + 0.3 * std::cos(1.75))) < 1e-14);
  BOOST_TEST(std::abs(exact.conductivity(r, 3.0) - 2.0 * (1.0 + 0.3 * std::sin(2.25)) * 1.4) < 1e-14);
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { ConductionManufactured<2>(-1.0); }, "conductivity must be positive, found -1"));
  BOOST_CHECK_THROW(ConductionManufactured<1>{std::numeric_limits<double>::infinity()},
                    std::invalid_argument);
  ConductionManufactured<1> const exact(1.0);
  Vector<1> const r(0.5);
  BOOST_TEST(refuses([&] { exact.temperature(r, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(exact.temperature_gradient(r, -1.0), std::invalid_argument);
  BOOST_CHECK_THROW(exact.source(r, -1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
