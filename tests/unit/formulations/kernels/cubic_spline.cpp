// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/kernels/cubic_spline.hpp"

#include <boost/test/unit_test.hpp>
#include <vector>

#include "formulations/kernels/kernel.hpp"
#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_kernels_cubic_spline)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

constexpr double lengths[] = {0.013, 1.0, 7.3};

/// Distances to a plane, in h: its face, the spline's knot, and close to the edge of the support.
constexpr double distances[] = {0.0,    1e-9, 1e-4,   0.1, 0.25, 0.466, 0.5, 0.75,
                                0.9999, 1.0,  1.0001, 1.2, 1.5,  1.8,   1.9, 1.99};

BOOST_AUTO_TEST_CASE_TEMPLATE(integrates_to_one, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    auto const shell = [h](double r) {
      double const area = Dim == 1   ? 2.0
                          : Dim == 2 ? 2.0 * std::numbers::pi * r
                                     : 4.0 * std::numbers::pi * r * r;
      return area * CubicSpline<Dim>::value(r, h);
    };
    BOOST_TEST(quadrature(shell, 0.0, h) + quadrature(shell, h, 2.0 * h) == 1.0, tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(is_the_spline_of_equation_24, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    for (double q = 0.0; q < 2.5; q += 0.01) {
      double const expected = dense::kernel<Dim>(q * h, h);
      BOOST_TEST(std::abs(CubicSpline<Dim>::value(q * h, h) - expected) <=
                 1e-14 * dense::kernel<Dim>(0.0, h));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(radial_weight_is_the_derivative_over_r, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    double const step = 1e-4 * h;
    double const scale = CubicSpline<Dim>::value(0.0, h) / h;
    for (double const q : {0.05, 0.3, 0.6667, 0.95, 1.0, 1.05, 1.5, 1.9, 1.9995, 2.1}) {
      double const r = q * h;
      double const difference =
          (CubicSpline<Dim>::value(r + step, h) - CubicSpline<Dim>::value(r - step, h)) / (2.0 * step);
      BOOST_TEST(std::abs(r * CubicSpline<Dim>::radial(r, h) - difference) < 1e-7 * scale, "q = " << q);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(radial_weight_is_finite_where_particles_meet, D, Dimensions) {
  constexpr int Dim = D::value;
  double const h = 0.7;
  BOOST_TEST(CubicSpline<Dim>::radial(0.0, h) == -3.0 * CubicSpline<Dim>::value(0.0, h) / (h * h),
             tolerance(1e-14));
  BOOST_TEST(CubicSpline<Dim>::radial(1e-9, h) == CubicSpline<Dim>::radial(0.0, h), tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(value_and_slope_are_continuous_at_the_knot_and_at_the_edge, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const q : {1.0, 2.0}) {
    double const below = std::nextafter(q, 0.0);
    BOOST_TEST(std::abs(CubicSpline<Dim>::value(q, 1.0) - CubicSpline<Dim>::value(below, 1.0)) < 1e-15);
    BOOST_TEST(std::abs(CubicSpline<Dim>::radial(q, 1.0) - CubicSpline<Dim>::radial(below, 1.0)) < 2e-15);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(vanishes_from_two_smoothing_lengths_on_and_nowhere_before, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    double const edge = 2.0 * h;
    BOOST_TEST(CubicSpline<Dim>::value(edge, h) == 0.0);
    BOOST_TEST(CubicSpline<Dim>::radial(edge, h) == 0.0);
    BOOST_TEST(default_kernel(Dim).plane_integral(edge, h) == 0.0);
    BOOST_TEST(CubicSpline<Dim>::value(std::nextafter(edge, 0.0), h) > 0.0);
    BOOST_TEST(CubicSpline<Dim>::value(3.0 * h, h) == 0.0);
    BOOST_TEST(default_kernel(Dim).plane_integral(3.0 * h, h) == 0.0);
    BOOST_TEST(default_kernel(Dim).inner_fraction(3.0 * h, h) == 1.0);
  }
  BOOST_TEST(CubicSpline<Dim>::support_ratio == 2.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_is_the_integral_of_the_kernel_over_the_plane, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    for (double const q : distances) {
      double const expected = dense::plane_integral<Dim>(q * h, h);
      BOOST_TEST(default_kernel(Dim).plane_integral(q * h, h) == expected, tolerance(1e-10));
    }
  }
}

/// Distances from the edge of the support, in h, down to a few last places.
std::vector<double> gaps() {
  std::vector<double> list;
  for (double gap = 0.5; gap > 1e-15; gap *= 0.7) list.push_back(2.0 - (2.0 - gap));
  return list;
}

/// The same with 2 - r written as (4 - r^2)/(2 + r), which loses no digits where r is close to 2; d >= h = 1.
template <int Dim>
double plane_integral_near_edge(double d) {
  if (Dim == 1) return CubicSpline<1>::value(d, 1.0);
  double const squared_edge = (2.0 - d) * (2.0 + d);
  auto const integrand = [d, squared_edge](double t) {  // s = t edge along the plane
    double const p = squared_edge * (1.0 - t * t) / (2.0 + std::sqrt(d * d + squared_edge * t * t));
    return (Dim == 2 ? 2.0 : 2.0 * std::numbers::pi * t * std::sqrt(squared_edge)) * p * p * p;
  };
  return CubicSpline<Dim>::sigma / 4.0 * std::sqrt(squared_edge) * quadrature(integrand, 0.0, 1.0);
}

// Wall terms divide it by the density at the foot point, which for a particle alone is just as small there.
BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_keeps_its_digits_up_to_the_edge_of_the_support, D, Dimensions) {
  constexpr int Dim = D::value;
  double worst = 0.0;
  double at = 0.0;
  for (double const gap : gaps()) {
    double const expected = plane_integral_near_edge<Dim>(2.0 - gap);
    double const error = std::abs(default_kernel(Dim).plane_integral(2.0 - gap, 1.0) / expected - 1.0);
    if (error > worst) at = gap;
    worst = std::max(worst, error);
  }
  BOOST_TEST(worst < 1e-10, "relative error " << worst << " at 2h - d = " << at << " h");
}

BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_is_never_negative, D, Dimensions) {
  constexpr int Dim = D::value;
  double least = 0.0;
  for (double const gap : gaps()) least = std::min(least, default_kernel(Dim).plane_integral(2.0 - gap, 1.0));
  BOOST_TEST(least == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(inner_fraction_is_the_part_of_the_kernel_on_this_side, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const h : lengths) {
    for (double const q : distances) {
      double const expected = dense::inner_fraction<Dim>(q * h, h);
      BOOST_TEST(default_kernel(Dim).inner_fraction(q * h, h) == expected, tolerance(1e-10));
    }
    BOOST_TEST(default_kernel(Dim).inner_fraction(0.0, h) == 0.5, tolerance(1e-14));
    BOOST_TEST(default_kernel(Dim).inner_fraction(2.0 * h, h) == 1.0);
    BOOST_TEST(default_kernel(Dim).inner_fraction(std::nextafter(2.0 * h, 0.0), h) == 1.0, tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_is_the_derivative_of_the_inner_fraction, D, Dimensions) {
  constexpr int Dim = D::value;
  double const h = 0.4;
  double const step = 1e-4 * h;
  for (double const q : {0.001, 0.1, 0.5, 0.9, 1.0, 1.1, 1.5, 1.9}) {
    double const slope = (default_kernel(Dim).inner_fraction(q * h + step, h) -
                          default_kernel(Dim).inner_fraction(q * h - step, h)) /
                         (2.0 * step);
    BOOST_TEST(std::abs(slope - default_kernel(Dim).plane_integral(q * h, h)) < 1e-7 / h, "q = " << q);
  }
}

BOOST_AUTO_TEST_CASE(values_at_the_plane_are_the_numbers_of_the_theory_page) {
  double const h = 0.3;
  BOOST_TEST(default_kernel(1).plane_integral(0.0, h) == 2.0 / (3.0 * h), tolerance(1e-14));
  BOOST_TEST(default_kernel(2).plane_integral(0.0, h) == 15.0 / (7.0 * std::numbers::pi * h),
             tolerance(1e-14));
  BOOST_TEST(default_kernel(3).plane_integral(0.0, h) == 7.0 / (10.0 * h), tolerance(1e-14));
}

// Section 4 of the report puts W = 1/(2h) at 0.6 h. With its own Eq. 24 it falls at 0.4662 h
// (equations.md rounds this to 0.467).
BOOST_AUTO_TEST_CASE(section_4_says_half_over_h_at_0_6_h_but_it_falls_at_0_466_h) {
  double const h = 0.2;
  BOOST_TEST(CubicSpline<1>::value(0.6 * h, h) * h == 0.4147, tolerance(1e-4));
  double near = 0.0;
  double far = 1.0;
  while (far - near > 1e-15) {
    double const middle = 0.5 * (near + far);
    (CubicSpline<1>::value(middle * h, h) > 0.5 / h ? near : far) = middle;
  }
  BOOST_TEST(near == 0.46618, tolerance(1e-4));
}

BOOST_AUTO_TEST_SUITE_END()
