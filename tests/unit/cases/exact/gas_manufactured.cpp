// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/gas_manufactured.hpp"

#include <algorithm>
#include <boost/mpl/list.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_gas_manufactured)

using namespace sphverify::exact;
using namespace sphverify::tests;
using sphverify::Vector;

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;
using Dimensions = boost::mpl::list<Dimension<1>, Dimension<2>, Dimension<3>>;
using Transverse = boost::mpl::list<Dimension<2>, Dimension<3>>;

constexpr double gamma = 1.4;
constexpr double scale = 0.3;
constexpr double times[] = {0.0, 0.35, 1.7};

// Wave numbers to 14 (two waves of 2 pi, and products) and frequencies to 4: a step of 0.003 leaves below
// 1e-9 of first derivatives and 1e-8 of second ones.
constexpr double h = 0.003;

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

/// The derivative along an axis of f(r).
template <int Dim, class Function>
double slope(Function const& f, Vector<Dim> const& r, int axis) {
  return first_derivative([&](double s) { return f(moved<Dim>(r, axis, s)); }, 0.0, h);
}

template <int Dim, class Function>
Vector<Dim> gradient(Function const& f, Vector<Dim> const& r) {
  Vector<Dim> result;
  for (int axis = 0; axis < Dim; ++axis) result[axis] = slope<Dim>(f, r, axis);
  return result;
}

template <int Dim, class Check>
void everywhere(Check const& check) {
  for (Vector<Dim> const& r : points<Dim>(30)) {
    for (double const t : times) check(r, t);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(mass_is_conserved_without_source, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, 0.0);
  double largest = 0.0;
  everywhere<Dim>([&](Vector<Dim> const& r, double t) {
    double const rate = first_derivative([&](double s) { return exact.density(r, s); }, t, h);
    double divergence = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      auto flow = [&](Vector<Dim> const& p) { return exact.density(p, t) * exact.velocity(p, t)[axis]; };
      divergence += slope<Dim>(flow, r, axis);
    }
    BOOST_TEST(std::abs(rate + divergence) < 1e-9, "r = " << r.transpose() << ", t = " << t);
    largest = std::max(largest, std::abs(rate));
  });
  BOOST_TEST(largest > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(momentum_asks_for_the_acceleration_source, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, 0.0);
  Vector<Dim> largest = Vector<Dim>::Zero();
  everywhere<Dim>([&](Vector<Dim> const& r, double t) {
    Vector<Dim> const velocity = exact.velocity(r, t);
    Vector<Dim> const source = exact.acceleration_source(r, t);
    Vector<Dim> const push = gradient<Dim>([&](Vector<Dim> const& p) { return exact.pressure(p, t); }, r);
    for (int axis = 0; axis < Dim; ++axis) {
      double const rate = first_derivative([&](double s) { return exact.velocity(r, s)[axis]; }, t, h);
      auto along = [&](Vector<Dim> const& p) { return exact.velocity(p, t)[axis]; };
      double const expected = rate + velocity.dot(gradient<Dim>(along, r)) + push[axis] / exact.density(r, t);
      BOOST_TEST(std::abs(source[axis] - expected) < 1e-9, "r = " << r.transpose() << ", t = " << t);
    }
    largest = largest.cwiseMax(source.cwiseAbs());
  });
  BOOST_TEST(largest.minCoeff() > 0.3);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(energy_asks_for_the_heating_source, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const conductivity_scale : {0.0, scale}) {
    GasManufactured<Dim> const exact(gamma, conductivity_scale);
    double largest = 0.0;
    everywhere<Dim>([&](Vector<Dim> const& r, double t) {
      auto energy = [&](Vector<Dim> const& p) { return exact.internal_energy(p, t); };
      double expected = first_derivative([&](double s) { return exact.internal_energy(r, s); }, t, h) +
                        exact.velocity(r, t).dot(gradient<Dim>(energy, r));
      for (int axis = 0; axis < Dim; ++axis) {
        auto velocity = [&](Vector<Dim> const& p) { return exact.velocity(p, t)[axis]; };
        auto conducted = [&](Vector<Dim> const& p) {
          return exact.conductivity(energy(p)) * slope<Dim>(energy, p, axis);
        };
        expected += (exact.pressure(r, t) * slope<Dim>(velocity, r, axis) - slope<Dim>(conducted, r, axis)) /
                    exact.density(r, t);
      }
      double const source = exact.heating_source(r, t);
      BOOST_TEST(std::abs(source - expected) < 1e-8,
                 "r = " << r.transpose() << ", t = " << t << ": " << source - expected);
      largest = std::max(largest, std::abs(source));
    });
    BOOST_TEST(largest > 0.3);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(flux_is_that_of_the_temperature, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, scale);
  everywhere<Dim>([&](Vector<Dim> const& r, double t) {
    auto energy = [&](Vector<Dim> const& p) { return exact.internal_energy(p, t); };
    double const temperature = energy(r);
    Vector<Dim> const expected = -scale * (1.0 + 0.2 * temperature) * gradient<Dim>(energy, r);
    BOOST_TEST((exact.flux(r, t) - expected).norm() < 1e-9);
    BOOST_TEST((GasManufactured<Dim>(gamma, 0.0).flux(r, t).norm() == 0.0));
  });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gas_moves_with_the_walls, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, 0.0);
  for (int const side : {0, 1}) {
    BOOST_TEST(exact.wall_position(side, 0.0) == side);
    BOOST_TEST(std::abs(exact.wall_velocity(side, 0.0)) > 0.1);
    for (double const t : {0.0, 0.2, 1.1, 3.7}) {
      double const rate = first_derivative([&](double s) { return exact.wall_position(side, s); }, t, 0.01);
      BOOST_TEST(std::abs(exact.wall_velocity(side, t) - rate) < 1e-9);
      Vector<Dim> r = Vector<Dim>::Constant(0.3);
      r[0] = exact.wall_position(side, t);
      BOOST_TEST(std::abs(exact.velocity(r, t)[0] - rate) < 1e-9);
    }
  }
  BOOST_TEST(std::abs(exact.wall_velocity(0, 0.0) + exact.wall_velocity(1, 0.0)) > 0.01);
}

// Over y by the trapezoidal rule, exact to rounding with 32 points of a periodic function.
BOOST_AUTO_TEST_CASE(mass_between_the_walls_is_constant) {
  GasManufactured<1> const line(gamma, 0.0);
  GasManufactured<2> const plane(gamma, 0.0);
  auto over_x = [&](auto const& f, double t) {
    return integral(f, line.wall_position(0, t), line.wall_position(1, t));
  };
  auto mean_over_y = [&](double x, double t) {
    double sum = 0.0;
    for (int i = 0; i < 32; ++i) sum += plane.density(Vector<2>(x, i / 32.0), t);
    return sum / 32.0;
  };
  // m(1) = 1.2 + 0.25 (sin 2.3 - sin 0.4)/1.9, and the mean of 1/h is 1/sqrt(1 - 0.15^2).
  double const expected = 1.2 + 0.25 * (std::sin(2.3) - std::sin(0.4)) / 1.9;
  for (double const t : times) {
    double const in_line = over_x([&](double x) { return line.density(Vector<1>(x), t); }, t);
    double const in_plane = over_x([&](double x) { return mean_over_y(x, t); }, t);
    BOOST_TEST(in_line == expected, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(in_plane == expected / std::sqrt(1.0 - 0.15 * 0.15), boost::test_tools::tolerance(1e-12));
  }
}

// Times up to 30 meet nearly every combination of the phases, whose frequencies have no common period.
BOOST_AUTO_TEST_CASE_TEMPLATE(fields_stay_within_their_stated_bounds, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, 0.0);
  for (Vector<Dim> r : points<Dim>(300)) {
    double const zeta = r[0];
    for (double t = 0.0; t < 30.0; t += 0.37) {
      double const left = exact.wall_position(0, t);
      double const length = exact.wall_position(1, t) - left;
      BOOST_TEST_REQUIRE(length >= 0.87);
      BOOST_TEST_REQUIRE(length <= 1.1);
      r[0] = left + zeta * length;
      BOOST_TEST_REQUIRE(exact.density(r, t) >= (Dim == 1 ? 0.75 : 0.65));
      BOOST_TEST_REQUIRE(exact.density(r, t) <= (Dim == 1 ? 1.9 : 2.2));
      BOOST_TEST_REQUIRE(exact.pressure(r, t) >= 1.75);
      BOOST_TEST_REQUIRE(exact.pressure(r, t) <= 2.71);
      if (Dim > 1) continue;
      auto pressure = [&](Vector<Dim> const& p) { return exact.pressure(p, t); };
      BOOST_TEST_REQUIRE(slope<Dim>(pressure, r, 0) >= 0.079);
      BOOST_TEST_REQUIRE(slope<Dim>(pressure, r, 0) <= 0.921);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_repeat_along_every_axis_but_the_first, D, Dimensions) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, scale);
  for (Vector<Dim> const& r : points<Dim>(20)) {
    for (int axis = 0; axis < Dim; ++axis) {
      Vector<Dim> const p = moved<Dim>(r, axis, 1.0);
      bool const periodic = axis > 0;
      auto same = [&](auto const& f, double tolerance) {
        BOOST_TEST((std::abs(f(p) - f(r)) < tolerance) == periodic);
      };
      same([&](auto const& q) { return exact.density(q, 0.2); }, 1e-13);
      same([&](auto const& q) { return exact.velocity(q, 0.2)[Dim - 1]; }, 1e-13);
      same([&](auto const& q) { return exact.pressure(q, 0.2); }, 1e-13);
      same([&](auto const& q) { return exact.heating_source(q, 0.2); }, 1e-11);
      same([&](auto const& q) { return exact.acceleration_source(q, 0.2)[0]; }, 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(density_and_pressure_vary_across_and_the_flow_is_sheared, D, Transverse) {
  constexpr int Dim = D::value;
  GasManufactured<Dim> const exact(gamma, scale);
  Vector<Dim> const r = Vector<Dim>::Constant(0.3);
  for (int axis = 1; axis < Dim; ++axis) {
    Vector<Dim> const p = moved<Dim>(r, axis, 0.3);
    BOOST_TEST(std::abs(exact.density(r, 0.0) - exact.density(p, 0.0)) > 0.02);
    BOOST_TEST(std::abs(exact.pressure(r, 0.0) - exact.pressure(p, 0.0)) > 0.02);
    auto across = [&](Vector<Dim> const& q) { return exact.velocity(q, 0.0)[axis]; };
    BOOST_TEST(std::abs(slope<Dim>(across, r, 0)) > 0.02);
  }
}

BOOST_AUTO_TEST_CASE(gradients_at_the_walls_do_not_vanish_and_differ) {
  GasManufactured<1> const exact(gamma, scale);
  for (double const t : times) {
    double density_slopes[2];
    double fluxes[2];
    for (int const side : {0, 1}) {
      Vector<1> const r(exact.wall_position(side, t));
      density_slopes[side] = slope<1>([&](Vector<1> const& p) { return exact.density(p, t); }, r, 0);
      fluxes[side] = exact.flux(r, t)[0];
      BOOST_TEST(std::abs(density_slopes[side]) > 0.01);
      BOOST_TEST(std::abs(fluxes[side]) > 0.01);
      BOOST_TEST(std::abs(exact.heating_source(r, t)) > 0.01);
      BOOST_TEST(std::abs(exact.acceleration_source(r, t)[0]) > 0.01);
    }
    BOOST_TEST(std::abs(fluxes[0] - fluxes[1]) > 0.03);
  }
}

// The documented formulas in long double.
BOOST_AUTO_TEST_CASE_TEMPLATE(fields_are_the_documented_ones_to_the_promised_accuracy, D, Dimensions) {
  constexpr int Dim = D::value;
  using Real = long double;
  GasManufactured<Dim> const exact(gamma, scale);
  Real const pi = std::numbers::pi_v<Real>;
  for (Vector<Dim> const& r : points<Dim>(300)) {
    for (double const time : {0.0, 0.35, 1.7, 10.0}) {
      Real const t = time;
      Real const x = r[0];
      Real const left = 0.06L * (std::sin(2.7L * t + 0.4L) - std::sin(0.4L));
      Real const right = 1 - 0.05L * (std::sin(4.1L * t - 0.9L) + std::sin(0.9L));
      Real const left_rate = 0.06L * 2.7L * std::cos(2.7L * t + 0.4L);
      Real const right_rate = -0.05L * 4.1L * std::cos(4.1L * t - 0.9L);
      Real const length = right - left;
      Real const zeta = (x - left) / length;
      Real const a = 0.2L * std::sin(1.7L * t + 0.3L);
      Real const a_rate = 0.2L * 1.7L * std::cos(1.7L * t + 0.3L);
      Real const m = 1.2L * zeta + 0.25L / 1.9L * (std::sin(1.9L * zeta + 0.4L) - std::sin(0.4L)) +
                     a * std::sin(pi * zeta) / pi;
      Real const m_zeta = 1.2L + 0.25L * std::cos(1.9L * zeta + 0.4L) + a * std::cos(pi * zeta);
      Real const zeta_rate = -(left_rate + zeta * (right_rate - left_rate)) / length;
      Real const m_rate = m_zeta * zeta_rate + a_rate * std::sin(pi * zeta) / pi;
      Real const velocity[] = {-m_rate * length / m_zeta, 0.1L * 2.3L * std::cos(1.3L * m + 2.3L * t + 0.2L),
                               -0.08L * 1.6L * std::cos(0.9L * m - 1.6L * t + 2)};
      Real const shift[] = {0, 0.1L * std::sin(1.3L * m + 2.3L * t + 0.2L),
                            0.08L * std::sin(0.9L * m - 1.6L * t + 2)};
      Real phase = 0;
      for (int axis = 1; axis < Dim; ++axis) phase += r[axis] - shift[axis];
      Real const factor = Dim > 1 ? 1 + 0.15L * std::cos(2 * pi * phase) : 1;
      Real const volume = factor * length / m_zeta;
      Real wave = 0.5L + 2.1L * x - 1.9L * t;
      if (Dim > 1) wave += 2 * pi * r[Dim > 1 ? 1 : 0];
      if (Dim > 2) wave -= 2 * pi * r[Dim > 2 ? 2 : 0];
      Real const pressure = 2 + 0.5L * x + 0.2L * std::sin(wave);

      auto near = [&](Real found, Real expected) {
        BOOST_TEST(std::abs(static_cast<double>(found - expected)) <= exact.accuracy());
      };
      near(exact.wall_position(0, time), left);
      near(exact.wall_position(1, time), right);
      near(exact.density(r, time), 1 / volume);
      for (int axis = 0; axis < Dim; ++axis) near(exact.velocity(r, time)[axis], velocity[axis]);
      near(exact.pressure(r, time), pressure);
      near((gamma - 1.0) * exact.internal_energy(r, time), pressure * volume);
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { GasManufactured<1>(1.0, 0.0); }, "gamma must be above 1, found 1"));
  BOOST_TEST(
      refuses([] { GasManufactured<2>(1.4, -1.0); }, "conductivity must be zero or positive, found -1"));
  BOOST_CHECK_THROW((GasManufactured<3>{1.4, std::numeric_limits<double>::infinity()}),
                    std::invalid_argument);
  GasManufactured<1> const exact(1.4, 0.0);
  BOOST_TEST(refuses([&] { exact.wall_position(2, 0.0); }, "side must be 0 or 1, found 2"));
  BOOST_CHECK_THROW(exact.wall_velocity(-1, 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
