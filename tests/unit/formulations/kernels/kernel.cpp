// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/kernels/kernel.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/dense.hpp"
#include "tests/support/kernels.hpp"

// What holds for every kernel, against forms of them that are written down a second time and against
// quadrature.
BOOST_AUTO_TEST_SUITE(formulations_kernels_kernel)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

constexpr double lengths[] = {0.013, 1.0, 7.3};

/// Every kernel of a dimension.
template <int Dim>
std::vector<Kernel const*> all() {
  std::vector<Kernel const*> list;
  for (KernelInfo const& info : all_kernel_infos()) list.push_back(&kernel(info.id, Dim));
  return list;
}

/// Distances in h, to either side of each knot, and down to the edge of the support.
std::vector<double> distances(Kernel const& W) {
  std::vector<double> list{0.0, 1e-12, 1e-9, 1e-4};
  for (double q = 0.03; q < W.support_ratio(); q += 0.0731) list.push_back(q);
  for (double knot = 1.0; knot <= W.support_ratio(); knot += 1.0) {
    for (double const by : {1e-12, 1e-6, 1e-3, 1e-2}) {
      list.push_back(knot - by);
      if (knot < W.support_ratio()) list.push_back(knot + by);
    }
    if (knot < W.support_ratio()) list.push_back(knot);
  }
  return list;
}

/// Distances from the edge of the support, in h, down to a few last places.
std::vector<double> gaps(Kernel const& W) {
  std::vector<double> list;
  double const R = W.support_ratio();
  for (double gap = 0.5; gap > 1e-15; gap *= 0.7) list.push_back(R - (R - gap));
  return list;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(integrates_to_one, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    for (double const h : lengths) {
      auto const shell = [&](double q) {
        double const area = Dim == 1   ? 2.0
                            : Dim == 2 ? 2.0 * std::numbers::pi * q
                                       : 4.0 * std::numbers::pi * q * q;
        return area * std::pow(h, Dim) * W->value(q * h, h);
      };
      BOOST_TEST(written::between_knots(shell, 0.0, W->support_ratio()) == 1.0, tolerance(2e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(is_the_kernel_that_is_published, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    BOOST_TEST(W->support_ratio() == written::support(W->id()));
    double worst = 0.0;
    for (double const h : lengths) {
      double const whole = W->value(0.0, h);
      for (double q = 0.0; q < W->support_ratio() + 0.5; q += 0.01)
        worst =
            std::max(worst, std::abs(W->value(q * h, h) - written::kernel(W->id(), Dim, q * h, h)) / whole);
    }
    BOOST_TEST(worst < 1e-14, W->id() << " off by " << worst);
  }
}

// Five points in long double: no digit of the difference is lost to rounding that would be seen.
BOOST_AUTO_TEST_CASE_TEMPLATE(radial_weight_is_the_derivative_over_r, D, Dimensions) {
  constexpr int Dim = D::value;
  constexpr long double step = 1e-4L;
  for (Kernel const* W : all<Dim>()) {
    auto const w = [&](long double q) { return written::shape(W->id(), Dim, q); };
    double const h = 0.7;
    double const scale = written::sigma(W->id(), Dim) / std::pow(h, Dim + 1);
    double const largest = std::abs(W->radial(0.0, h)) * h;
    double worst = 0.0;
    for (double const q : distances(*W)) {
      double const off = std::abs(q - std::round(q));
      if (q < 1e-3 || (off > 0.0 && off < 3e-4) || off == 0.0) continue;  // where pieces meet: below
      long double const slope =
          (8.0L * (w(q + step) - w(q - step)) - (w(q + 2.0L * step) - w(q - 2.0L * step))) / (12.0L * step);
      worst = std::max(worst,
                       std::abs(q * h * W->radial(q * h, h) - scale * static_cast<double>(slope)) / largest);
    }
    BOOST_TEST(worst < 1e-12, W->id() << " off by " << worst);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(radial_weight_is_finite_where_particles_meet, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    double const h = 0.7;
    long double const q = 1e-4L;
    long double const slope_over_q =
        2.0L * (written::shape(W->id(), Dim, q) - written::shape(W->id(), Dim, 0.0L)) / (q * q);
    double const expected =
        written::sigma(W->id(), Dim) / std::pow(h, Dim + 2) * static_cast<double>(slope_over_q);
    BOOST_TEST(W->radial(0.0, h) == expected, tolerance(1e-3));
    BOOST_TEST(W->radial(1e-9, h) == W->radial(0.0, h), tolerance(1e-8));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(value_and_slope_are_continuous_where_pieces_meet_and_at_the_edge, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    std::vector<double> ends = W->knots();
    ends.push_back(W->support_ratio());
    for (double const q : ends) {
      double const below = std::nextafter(q, 0.0);
      BOOST_TEST(std::abs(W->value(q, 1.0) - W->value(below, 1.0)) < 2e-15 * W->value(0.0, 1.0), W->id()
                                                                                                     << q);
      BOOST_TEST(std::abs(W->radial(q, 1.0) - W->radial(below, 1.0)) < 2e-15 * std::abs(W->radial(0.0, 1.0)),
                 W->id() << q);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(vanishes_from_the_edge_of_the_support_on_and_nowhere_before, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    for (double const h : lengths) {
      double const edge = W->support_ratio() * h;
      BOOST_TEST(W->value(edge, h) == 0.0);
      BOOST_TEST(W->radial(edge, h) == 0.0);
      BOOST_TEST(W->plane_integral(edge, h) == 0.0);
      BOOST_TEST(W->value(0.9999 * edge, h) > 0.0);
      BOOST_TEST(W->radial(0.9999 * edge, h) < 0.0);
      BOOST_TEST(W->value(1.5 * edge, h) == 0.0);
      BOOST_TEST(W->radial(1.5 * edge, h) == 0.0);
      BOOST_TEST(W->plane_integral(1.5 * edge, h) == 0.0);
      BOOST_TEST(W->inner_fraction(1.5 * edge, h) == 1.0);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_is_the_integral_of_the_kernel_over_the_plane, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    double worst = 0.0, at = 0.0;
    for (double const q : distances(*W)) {
      double const expected = written::plane_integral(W->id(), Dim, q);
      for (double const h : lengths) {
        double const error =
            std::abs(h * W->plane_integral(q * h, h) - expected) / W->plane_integral(0.0, 1.0);
        if (error > worst) at = q;
        worst = std::max(worst, error);
      }
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: plane integral off by " << worst << " at " << at
                               << " h");
    BOOST_TEST(worst < 1e-14, W->id() << " off by " << worst << " at " << at << " h");
  }
}

// Wall terms divide it by the density at the foot point, which for a particle alone is just as small there.
BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_keeps_its_digits_up_to_the_edge_of_the_support, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    double worst = 0.0, at = 0.0;
    for (double const gap : gaps(*W)) {
      double const d = W->support_ratio() - gap;
      double const error =
          std::abs(W->plane_integral(d, 1.0) / written::plane_integral(W->id(), Dim, d) - 1.0);
      if (error > worst) at = gap;
      worst = std::max(worst, error);
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: relative error " << worst << " at " << at << " h");
    BOOST_TEST(worst < 1e-12, W->id() << ": relative error " << worst << ", " << at << " h from the edge");
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(inner_fraction_is_the_part_of_the_kernel_on_this_side, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    double worst = 0.0, at = 0.0;
    for (double const q : distances(*W)) {
      double const expected = written::inner_fraction(W->id(), Dim, q);
      for (double const h : lengths) {
        double const error = std::abs(W->inner_fraction(q * h, h) - expected);
        if (error > worst) at = q;
        worst = std::max(worst, error);
      }
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: inner fraction off by " << worst << " at " << at
                               << " h");
    BOOST_TEST(worst < 1e-14, W->id() << " off by " << worst << " at " << at << " h");
    BOOST_TEST(W->inner_fraction(0.0, 0.3) == 0.5, tolerance(1e-14));
    BOOST_TEST(W->inner_fraction(W->support_ratio() * 0.3, 0.3) == 1.0);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(plane_integral_is_the_derivative_of_the_inner_fraction, D, Dimensions) {
  constexpr int Dim = D::value;
  constexpr double step = 1e-3;
  for (Kernel const* W : all<Dim>()) {
    for (double q = 0.0503; q < W->support_ratio(); q += 0.0731) {
      if (std::abs(q - std::round(q)) < 3.0 * step) continue;
      auto const gamma = [&](double steps) { return W->inner_fraction(q + steps * step, 1.0); };
      double const slope = (8.0 * (gamma(1.0) - gamma(-1.0)) - (gamma(2.0) - gamma(-2.0))) / (12.0 * step);
      BOOST_TEST(std::abs(slope - W->plane_integral(q, 1.0)) < 1e-10, W->id() << " at " << q << " h");
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(moments_are_those_of_the_shape, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Kernel const* W : all<Dim>()) {
    double const R = W->support_ratio();
    double const scale = W->sigma() / written::sigma(W->id(), Dim);
    BOOST_TEST(scale == 1.0, tolerance(1e-14));
    auto const moment = [&](int n, double from, double to) {
      auto const f = [&](double q) {
        return std::pow(q, n) * static_cast<double>(written::shape(W->id(), Dim, q));
      };
      return written::between_knots(f, from, to);
    };
    double const first = moment(1, 0.0, R);
    BOOST_TEST(W->whole_second_moment() == moment(2, 0.0, R), tolerance(1e-14));
    for (double q = 0.02; q < R + 0.5; q += 0.11) {
      BOOST_TEST(std::abs(W->shape(q) - static_cast<double>(written::shape(W->id(), Dim, q))) <=
                 1e-14 * W->shape(0.0));
      BOOST_TEST(std::abs(W->first_moment_beyond(q) - (q < R ? moment(1, q, R) : 0.0)) < 1e-14 * first);
      double const potential = -moment(2, 0.0, std::min(q, R)) / q - (q < R ? moment(1, q, R) : 0.0);
      BOOST_TEST(std::abs(W->smooth_potential(q) - potential) < 1e-14 * first, W->id() << " at " << q);
    }
    BOOST_TEST(W->smooth_potential(0.0) == -first, tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(line_integrals_are_those_of_the_shape, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(3);
  for (Kernel const* W : all<Dim>()) {
    double const whole = 2.0 * W->line_integral(0.0, 0.0, W->support_ratio());
    double worst = 0.0;
    for (int n = 0; n < 200; ++n) {
      double const d = n % 10 == 0 ? 0.0 : random.uniform(0.0, W->support_ratio());
      double const a = written::half_chord(W->support_ratio(), d);
      double const one = random.uniform(-a, a), other = random.uniform(-a, a);
      std::vector<double> ends{std::min(one, other), 0.0, std::max(one, other)};
      for (double const knot : W->knots()) {
        ends.push_back(written::half_chord(knot, d));
        ends.push_back(-written::half_chord(knot, d));
      }
      std::sort(ends.begin(), ends.end());
      double expected = 0.0;
      for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        if (ends[k] < std::min(one, other) || ends[k + 1] > std::max(one, other)) continue;
        expected += quadrature(
            [&](double s) { return static_cast<double>(written::shape(W->id(), Dim, std::hypot(d, s))); },
            ends[k], ends[k + 1]);
      }
      worst = std::max(worst,
                       std::abs(W->line_integral(d, std::min(one, other), std::max(one, other)) - expected));
    }
    BOOST_TEST_MESSAGE(W->id() << " in " << Dim << "D: line integral off by " << worst / whole);
    BOOST_TEST(worst < 1e-14 * whole, W->id() << " off by " << worst / whole);
  }
}

BOOST_AUTO_TEST_CASE(every_kernel_is_found_by_its_id_in_every_dimension) {
  std::set<std::string_view> ids;
  for (KernelInfo const& info : all_kernel_infos()) {
    ids.insert(info.id);
    for (int dimension = 1; dimension <= 3; ++dimension) {
      Kernel const& found = kernel(info.id, dimension);
      BOOST_TEST(found.id() == info.id);
      BOOST_TEST(found.dimension() == dimension);
      BOOST_TEST(found.support_ratio() == info.support_ratio);
      BOOST_TEST(&found == &kernel(info.id, dimension));
    }
  }
  std::set<std::string_view> const expected{"cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4",
                                            "wendland-c6"};
  BOOST_TEST((ids == expected));
  BOOST_TEST(ids.size() == all_kernel_infos().size());
  BOOST_TEST(&default_kernel(2) == &kernel("cubic-spline", 2));
  BOOST_CHECK_THROW(kernel("gauss", 1), std::invalid_argument);
  BOOST_CHECK_THROW(kernel("cubic-spline", 4), std::invalid_argument);
}

// Morris, Fox & Zhu 1997; Dehnen & Aly 2012, Table 1, with their H = 2h.
BOOST_AUTO_TEST_CASE(normalisations_are_those_that_are_published) {
  using std::numbers::pi;
  double const H = 2.0;
  std::pair<std::string, std::vector<double>> const published[] = {
      {"cubic-spline", {2.0 / 3.0, 10.0 / (7.0 * pi), 1.0 / pi}},
      {"quintic-spline", {1.0 / 120.0, 7.0 / (478.0 * pi), 1.0 / (120.0 * pi)}},
      {"wendland-c2", {1.25 / H, 7.0 / pi / (H * H), 21.0 / (2.0 * pi) / (H * H * H)}},
      {"wendland-c4", {1.5 / H, 9.0 / pi / (H * H), 495.0 / (32.0 * pi) / (H * H * H)}},
      {"wendland-c6", {55.0 / 32.0 / H, 78.0 / (7.0 * pi) / (H * H), 1365.0 / (64.0 * pi) / (H * H * H)}}};
  for (auto const& [id, sigmas] : published) {
    for (int dimension = 1; dimension <= 3; ++dimension)
      BOOST_TEST(kernel(id, dimension).sigma() == sigmas[static_cast<std::size_t>(dimension - 1)],
                 tolerance(1e-15));
  }
}

BOOST_AUTO_TEST_SUITE_END()
