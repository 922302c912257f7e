// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/box_series.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/slab_dirichlet.hpp"
#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_box_series)

using namespace sphverify;
using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double left = 1.2;
constexpr double right = 3.0;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;

template <int Dim>
std::vector<BoxMode<Dim>> modes() {
  if constexpr (Dim == 2) {
    return {{{1, 1}, 1.0}, {{3, 2}, 0.5}, {{1, 4}, -0.3}};
  } else {
    return {{{1, 1, 1}, 1.0}, {{2, 1, 3}, 0.5}, {{1, 3, 2}, -0.3}};
  }
}

template <int Dim>
BoxSeries<Dim> box(BoxSides sides) {
  return BoxSeries<Dim>(left, right, modes<Dim>(), sides, conductivity, density);
}

/// Places at the centres of equal cells, `count` along each axis.
template <int Dim>
std::vector<Vector<Dim>> cell_centres(int count) {
  std::vector<Vector<Dim>> list{Vector<Dim>::Zero()};
  for (int k = 0; k < Dim; ++k) {
    std::vector<Vector<Dim>> finer;
    for (Vector<Dim> x : list) {
      for (int i = 0; i < count; ++i) {
        x[k] = (i + 0.5) / count;
        finer.push_back(x);
      }
    }
    list = finer;
  }
  return list;
}

template <class Check>
void for_each_box(Check const& check) {
  for (BoxSides const sides : {BoxSides::dirichlet, BoxSides::insulated}) {
    BOOST_TEST_CONTEXT((sides == BoxSides::dirichlet ? "dirichlet" : "insulated")) {
      BOOST_TEST_CONTEXT("2D") { check.template operator()<2>(sides); }
      BOOST_TEST_CONTEXT("3D") { check.template operator()<3>(sides); }
    }
  }
}

// Space step 0.004: truncation below 1e-8 for mode 4, rounding below 1e-9; time step 2e-5: both below 1e-8.
BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation) {
  for_each_box([]<int Dim>(BoxSides sides) {
    BoxSeries<Dim> const exact = box<Dim>(sides);
    double largest = 0.0;
    for (double const t : {0.001, 0.004, 0.02}) {
      for (Vector<Dim> const& r : cell_centres<Dim>(5)) {
        double const rate = first_derivative([&](double s) { return exact.temperature(r, s); }, t, 2e-5);
        double laplacian = 0.0;
        for (int k = 0; k < Dim; ++k) {
          laplacian += second_derivative(
              [&](double s) { return exact.temperature(r + s * Vector<Dim>::Unit(k), t); }, 0.0, 0.004);
        }
        BOOST_TEST(std::abs(density * rate - conductivity * laplacian) < 1e-6,
                   "r = " << r.transpose() << ", t = " << t);
        largest = std::max(largest, std::abs(density * rate));
      }
    }
    BOOST_TEST(largest > 10.0);
  });
}

// Edges and corners included, and at t = 0: what two sides hold where they meet is the same.
BOOST_AUTO_TEST_CASE(sides_keep_their_temperatures_or_pass_no_heat_at_all_times) {
  for_each_box([]<int Dim>(BoxSides sides) {
    BoxSeries<Dim> const exact = box<Dim>(sides);
    for (double const t : {0.0, 0.01, 1.0}) {
      for (Vector<Dim> r : cell_centres<Dim>(4)) {
        for (int k = 0; k < Dim; ++k) {
          for (double const side : {0.0, 1.0}) {
            for (double const edge : {r[(k + 1) % Dim], 0.0, 1.0}) {
              Vector<Dim> foot = r;
              foot[(k + 1) % Dim] = edge;
              foot[k] = side;
              if (k == 0 || sides == BoxSides::dirichlet) {
                double const held = left + (right - left) * foot[0];
                BOOST_TEST(std::abs(exact.temperature(foot, t) - held) <= exact.accuracy());
              } else {
                BOOST_TEST(std::abs(exact.gradient(foot, t)[k]) < 1e-13);
                double const inside = side == 0.0 ? 1.0 : -1.0;
                double const near = exact.temperature(foot + 1e-4 * inside * Vector<Dim>::Unit(k), t);
                BOOST_TEST(std::abs(near - exact.temperature(foot, t)) < 2e-6);  // no slope: a square law
              }
            }
          }
        }
      }
    }
  });
}

// The midpoint rule integrates products of these waves exactly.
BOOST_AUTO_TEST_CASE(initial_state_holds_each_amplitude_in_its_own_mode) {
  for_each_box([]<int Dim>(BoxSides sides) {
    BoxSeries<Dim> const exact = box<Dim>(sides);
    std::vector<Vector<Dim>> const places = cell_centres<Dim>(16);
    for (BoxMode<Dim> const& asked :
         {modes<Dim>()[0], modes<Dim>()[1], modes<Dim>()[2], BoxMode<Dim>{{2, 2}, 0.0}}) {
      double sum = 0.0;
      for (Vector<Dim> const& r : places) {
        double wave = 1.0;
        for (int k = 0; k < Dim; ++k) {
          double const phase = asked.numbers[static_cast<std::size_t>(k)] * std::numbers::pi * r[k];
          wave *= k > 0 && sides == BoxSides::insulated ? std::cos(phase) : std::sin(phase);
        }
        sum += wave * (exact.temperature(r, 0.0) - left - (right - left) * r[0]);
      }
      double const norm = std::pow(2.0, Dim) / static_cast<double>(places.size());
      BOOST_TEST(std::abs(norm * sum - asked.amplitude) < 1e-13);
    }
  });
}

BOOST_AUTO_TEST_CASE(modes_uniform_along_the_insulated_axes_are_those_of_the_slab) {
  SlabDirichlet const slab(left, right, {{2, 0.7}}, conductivity, density);
  BoxSeries<2> const square(left, right, {{{2, 0}, 0.7}}, BoxSides::insulated, conductivity, density);
  BoxSeries<3> const cube(left, right, {{{2, 0, 0}, 0.7}}, BoxSides::insulated, conductivity, density);
  for (double const t : {0.0, 0.01, 0.1}) {
    for (Vector<3> const& r : cell_centres<3>(4)) {
      double const expected = slab.temperature(r[0], t);
      BOOST_TEST(std::abs(square.temperature(r.head<2>(), t) - expected) <= square.accuracy());
      BOOST_TEST(std::abs(cube.temperature(r, t) - expected) <= cube.accuracy());
      BOOST_TEST(std::abs(cube.gradient(r, t)[0] - slab.gradient(r[0], t)) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  for_each_box([]<int Dim>(BoxSides sides) {
    BoxSeries<Dim> const exact = box<Dim>(sides);
    for (double const t : {0.0, 0.01}) {
      for (Vector<Dim> const& r : cell_centres<Dim>(4)) {
        for (int k = 0; k < Dim; ++k) {
          double const expected = first_derivative(
              [&](double s) { return exact.temperature(r + s * Vector<Dim>::Unit(k), t); }, 0.0, 0.002);
          BOOST_TEST(std::abs(exact.gradient(r, t)[k] - expected) < 1e-9);
        }
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  for_each_box([]<int Dim>(BoxSides sides) {
    BoxSeries<Dim> const exact = box<Dim>(sides);
    BOOST_TEST(exact.accuracy() < 1e-13);
    constexpr long double pi = std::numbers::pi_v<long double>;
    for (double t = 0.0; t < 0.05; t += 0.013) {
      for (Vector<Dim> const& r : cell_centres<Dim>(Dim == 2 ? 23 : 11)) {
        long double sum = left + (static_cast<long double>(right) - left) * r[0];
        for (BoxMode<Dim> const& mode : modes<Dim>()) {
          long double product = mode.amplitude;
          long double square = 0.0L;
          for (int k = 0; k < Dim; ++k) {
            long double const wavenumber = mode.numbers[static_cast<std::size_t>(k)] * pi;
            bool const cosine = k > 0 && sides == BoxSides::insulated;
            product *= cosine ? std::cos(wavenumber * r[k]) : std::sin(wavenumber * r[k]);
            square += wavenumber * wavenumber;
          }
          sum += product * std::exp(-square * conductivity / density * t);
        }
        BOOST_TEST(std::abs(static_cast<double>(exact.temperature(r, t) - sum)) <= exact.accuracy());
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  auto const square = [](std::vector<BoxMode<2>> list, BoxSides sides) {
    return [=] { BoxSeries<2>(1, 2, list, sides, 1, 1); };
  };
  BOOST_TEST(refuses(square({{{1, 0}, 1.0}}, BoxSides::dirichlet), "mode number must be 1 or more, found 0"));
  BOOST_TEST(refuses(square({{{0, 1}, 1.0}}, BoxSides::insulated), "mode number must be 1 or more, found 0"));
  BOOST_TEST(refuses(square({{{1, -1}, 1.0}}, BoxSides::insulated),
                     "mode number along an insulated axis must be zero or positive, found -1"));
  BOOST_CHECK_NO_THROW(square({{{1, 0}, 1.0}}, BoxSides::insulated)());
  double const nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(square({{{1, 1}, nan}}, BoxSides::dirichlet)(), std::invalid_argument);
  BOOST_TEST(refuses([] { BoxSeries<2>(1, 2, {}, BoxSides::dirichlet, -1, 1); },
                     "conductivity must be positive, found -1"));
  BOOST_TEST(refuses([] { BoxSeries<3>(1, 2, {}, BoxSides::dirichlet, 1, 0); },
                     "density must be positive, found 0"));
  BOOST_CHECK_THROW(BoxSeries<2>(nan, 2, {}, BoxSides::dirichlet, 1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(BoxSeries<2>(1, nan, {}, BoxSides::dirichlet, 1, 1), std::invalid_argument);
  BoxSeries<2> const exact = box<2>(BoxSides::dirichlet);
  BOOST_TEST(refuses(
      [&] {
        exact.temperature({0.5, 0.5}, -1.0);
      },
      "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(exact.gradient({0.5, 0.5}, -1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
