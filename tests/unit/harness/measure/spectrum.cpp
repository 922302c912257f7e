// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/spectrum.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

BOOST_AUTO_TEST_SUITE(harness_measure_spectrum)

using namespace sphverify;
using boost::test_tools::tolerance;
using Complex = std::complex<double>;

namespace {

Spectrum complete(std::vector<Complex> eigenvalues, double uncertainty = 0.0) {
  Spectrum all;
  all.eigenvalues = std::move(eigenvalues);
  all.uncertainty.assign(all.eigenvalues.size(), uncertainty);
  all.complete = true;
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(eigenvalues_of_a_sparse_operator_are_those_of_its_matrix) {
  // [[-1, 2, 0], [-2, -1, 0], [0, 5, -4]]: -1 +- 2i and -4.
  DependencyPattern const pattern{{0, 2, 4, 6}, {0, 1, 0, 1, 1, 2}};
  auto found = spectrum(pattern, {-1.0, 2.0, -2.0, -1.0, 5.0, -4.0}, 0.0);
  BOOST_TEST_REQUIRE(found.eigenvalues.size() == 3u);
  for (Complex const expected : {Complex(-1.0, 2.0), Complex(-1.0, -2.0), Complex(-4.0, 0.0)}) {
    BOOST_TEST(std::any_of(found.eigenvalues.begin(), found.eigenvalues.end(),
                           [&](Complex const& lambda) { return std::abs(lambda - expected) < 1e-12; }));
  }
}

BOOST_AUTO_TEST_CASE(eigenvalues_of_the_second_difference_are_known) {
  std::size_t const n = 40;
  DependencyPattern pattern{{0}, {}};
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i > 0 ? i - 1 : 0; j <= std::min(i + 1, n - 1); ++j) {
      pattern.column.push_back(static_cast<std::int64_t>(j));
      values.push_back(i == j ? -2.0 : 1.0);
    }
    pattern.first.push_back(static_cast<std::int64_t>(values.size()));
  }
  Stability const s = stability_of(spectrum(pattern, values, 0.0));
  double const angle = std::acos(-1.0) / (2.0 * (n + 1.0));
  BOOST_TEST(*s.spectral_radius == 4.0 * std::pow(std::cos(angle), 2), tolerance(1e-12));
  BOOST_TEST(*s.spectral_abscissa == -4.0 * std::pow(std::sin(angle), 2), tolerance(1e-10));
  BOOST_TEST(*s.largest_stable_step == 2.0 / *s.spectral_radius, tolerance(1e-12));
  BOOST_TEST(*s.growing_modes == 0u);
}

BOOST_AUTO_TEST_CASE(the_stable_step_is_that_of_the_mode_that_allows_least) {
  // -2 Re/|lambda|^2: 2 for -1, 0.2 for -1 +- 3i.
  Stability const s = stability_of(complete({{-1.0, 0.0}, {-1.0, 3.0}, {-1.0, -3.0}}));
  BOOST_TEST(*s.largest_stable_step == 0.2, tolerance(1e-13));
  BOOST_TEST(*s.spectral_abscissa == -1.0);
  BOOST_TEST(*s.spectral_radius == std::sqrt(10.0), tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(a_fast_mode_that_is_hardly_known_leaves_no_stable_step) {
  Stability const s = stability_of(complete({{-0.05, 0.0}, {-1.0, 0.0}}, 0.08));
  BOOST_TEST(!s.largest_stable_step.has_value());
  BOOST_TEST(s.remark == "a fast mode is not known well enough");
  BOOST_TEST(*stability_of(complete({{-1e-5, 0.0}, {-1.0, 0.0}}, 0.05)).largest_stable_step == 2.0);
}

BOOST_AUTO_TEST_CASE(whether_modes_grow_that_may_be_off_by_as_much_as_they_are_is_not_known) {
  for (double const uncertainty : {0.2, 1.0, 300.0}) {
    Spectrum one = complete({{-0.01, 1.0}, {-0.01, -1.0}, {-0.5, 0.0}}, 1e-12);
    one.uncertainty[2] = uncertainty;
    Stability const s = stability_of(one);
    BOOST_TEST(!s.growing_modes.has_value());
    BOOST_TEST(!s.spectral_abscissa.has_value());
    BOOST_TEST(!s.abscissa_uncertainty.has_value());
    BOOST_TEST(s.remark.starts_with("whether a mode grows is not known"), s.remark);
    BOOST_TEST(*s.spectral_radius == std::hypot(0.01, 1.0));
    // That another grows for sure is known all the same.
    one.eigenvalues[0] = {0.5, 0.0};
    BOOST_TEST(*stability_of(one).growing_modes == 1u);
  }
  BOOST_TEST(*stability_of(complete({{-0.01, 1.0}, {-0.01, -1.0}}, 0.05)).growing_modes == 0u);
}

BOOST_AUTO_TEST_CASE(an_operator_that_is_no_number_has_no_spectrum_and_says_so) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(4, 4);
  matrix(2, 1) = std::numeric_limits<double>::quiet_NaN();
  DependencyPattern const pattern{{0, 1, 2}, {0, 1}};
  for (Spectrum const& found :
       {dense_spectrum(matrix, 0.0),
        outer_spectrum(pattern, {-1.0, std::numeric_limits<double>::infinity()}, 0.0)}) {
    Stability const s = stability_of(found);
    BOOST_TEST(s.remark == "the linearised rate is not finite");
    BOOST_TEST((!s.growing_modes && !s.spectral_abscissa && !s.spectral_radius && !s.largest_stable_step));
  }
}

BOOST_AUTO_TEST_CASE(a_mode_that_grows_leaves_no_stable_step) {
  Stability const s = stability_of(complete({{0.3, 1.0}, {0.3, -1.0}, {-5.0, 0.0}}));
  BOOST_TEST(*s.spectral_abscissa == 0.3);
  BOOST_TEST(*s.growing_modes == 2u);
  BOOST_TEST(!s.largest_stable_step.has_value());
}

BOOST_AUTO_TEST_CASE(a_zero_that_round_off_made_positive_does_not_grow) {
  Stability const s = stability_of(complete({{-100.0, 0.0}, {1e-10, 0.0}}, 1e-9));
  BOOST_TEST(*s.growing_modes == 0u);
  BOOST_TEST(*s.largest_stable_step == 0.02, tolerance(1e-12));
}

/// Advection and diffusion on a ring that is not even: complex eigenvalues, and a matrix that is not normal.
void ring(std::size_t n, DependencyPattern& pattern, std::vector<double>& values) {
  pattern = {{0}, {}};
  values.clear();
  for (std::size_t i = 0; i < n; ++i) {
    double const speed = 1.0 + 0.5 * std::sin(0.1 * static_cast<double>(i));
    std::vector<std::pair<std::size_t, double>> row{
        {(i + n - 1) % n, 1.0 + speed}, {i, -2.0 - 0.3 * speed}, {(i + 1) % n, 1.0 - speed}};
    std::sort(row.begin(), row.end());
    for (auto const& [column, value] : row) {
      pattern.column.push_back(static_cast<std::int64_t>(column));
      values.push_back(value);
    }
    pattern.first.push_back(static_cast<std::int64_t>(values.size()));
  }
}

BOOST_AUTO_TEST_CASE(arnoldi_finds_what_the_dense_solver_finds) {
  DependencyPattern pattern;
  std::vector<double> values;
  ring(200, pattern, values);
  Stability const all = stability_of(spectrum(pattern, values, 0.0));
  Stability const outer = stability_of(outer_spectrum(pattern, values, 0.0));
  BOOST_TEST(all.method == "dense");
  BOOST_TEST(outer.method == "arnoldi");
  BOOST_TEST(outer.remark == "");
  BOOST_TEST(*outer.spectral_radius == *all.spectral_radius, tolerance(1e-8));
  BOOST_TEST(*outer.spectral_abscissa == *all.spectral_abscissa, tolerance(1e-7));
  BOOST_TEST(*outer.largest_imaginary == *all.largest_imaginary, tolerance(1e-8));
  BOOST_TEST(*all.largest_imaginary > 1.0);
}

BOOST_AUTO_TEST_CASE(
    an_operator_too_large_to_factorise_keeps_its_outer_eigenvalues_and_says_what_is_missing) {
  DependencyPattern pattern;
  std::vector<double> values;
  ring(200, pattern, values);
  Stability const whole = stability_of(outer_spectrum(pattern, values, 0.0));
  Stability const outer = stability_of(outer_spectrum(pattern, values, 0.0, values.size() - 1));
  BOOST_TEST(*outer.spectral_radius == *whole.spectral_radius, tolerance(1e-12));
  BOOST_TEST(outer.remark ==
             "the slowest eigenvalues are not looked for in more than 599 nonzeros, found 600");
  // A wrong abscissa would be worse than none.
  BOOST_TEST(!outer.spectral_abscissa.has_value());
  BOOST_TEST(!outer.growing_modes.has_value());
  BOOST_TEST(!outer.largest_stable_step.has_value());
  BOOST_TEST(whole.spectral_abscissa.has_value());
  // One that grows fast is among the outermost, and known.
  for (std::size_t i = 0; i < 200; ++i) {
    for (auto k = pattern.first[i]; k < pattern.first[i + 1]; ++k) {
      if (i == 7 && pattern.column[static_cast<std::size_t>(k)] == 7)
        values[static_cast<std::size_t>(k)] = 9.0;
    }
  }
  Stability const growing = stability_of(outer_spectrum(pattern, values, 0.0, values.size() - 1));
  BOOST_TEST(*growing.spectral_abscissa > 8.0);
  BOOST_TEST(!growing.growing_modes.has_value());
}

BOOST_AUTO_TEST_CASE(the_worst_mode_is_an_eigenvector) {
  DependencyPattern pattern;
  std::vector<double> values;
  ring(100, pattern, values);
  for (Spectrum const& found : {spectrum(pattern, values, 0.0), outer_spectrum(pattern, values, 0.0)}) {
    Eigen::VectorXcd const& v = found.modes.front();
    Complex const lambda = found.eigenvalues.front();
    double defect = 0.0;
    for (std::size_t i = 0; i < pattern.rows(); ++i) {
      Complex image = 0.0;
      for (std::int64_t k = pattern.first[i]; k < pattern.first[i + 1]; ++k)
        image += values[static_cast<std::size_t>(k)] * v[pattern.column[static_cast<std::size_t>(k)]];
      defect = std::max(defect, std::abs(image - lambda * v[static_cast<Eigen::Index>(i)]));
    }
    BOOST_TEST(v.norm() == 1.0, tolerance(1e-9));
    BOOST_TEST(defect < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(states_that_an_operator_does_not_see_are_counted) {
  // The central first difference on an even ring sees neither a constant nor the odd-even mode.
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(12, 12);
  for (Eigen::Index i = 0; i < 12; ++i) {
    difference(i, (i + 1) % 12) = 0.5;
    difference(i, (i + 11) % 12) = -0.5;
  }
  BOOST_TEST(*dense_spectrum(difference * difference, 0.0).unseen_modes == 2u);
  BOOST_TEST(*dense_spectrum(Eigen::MatrixXd(-Eigen::MatrixXd::Identity(5, 5)), 0.0).unseen_modes == 0u);
  // A zero eigenvalue without a second eigenvector counts once.
  Eigen::MatrixXd defective = Eigen::MatrixXd::Zero(3, 3);
  defective(0, 1) = 1.0;
  defective(2, 2) = -1.0;
  BOOST_TEST(*dense_spectrum(defective, 0.0).unseen_modes == 1u);
}

/// Largest change of an eigenvalue, over its uncertainty, when entries are changed at random by a part of the
/// largest; pairs are those nearest to each other.
double largest_excess(Eigen::MatrixXd const& matrix, double part) {
  Spectrum const before = dense_spectrum(matrix, part);
  std::mt19937_64 random(7);
  double excess = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd change(matrix.rows(), matrix.cols());
    for (double& value : change.reshaped()) value = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    change *= part * matrix.norm() / change.norm();
    Spectrum const after = dense_spectrum(matrix + change, 0.0);
    for (Complex const& lambda : after.eigenvalues) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < before.eigenvalues.size(); ++k)
        nearest = std::min(nearest, std::abs(lambda - before.eigenvalues[k]) / before.uncertainty[k]);
      excess = std::max(excess, nearest);
    }
  }
  return excess;
}

BOOST_AUTO_TEST_CASE(eigenvalues_move_no_further_than_their_uncertainty) {
  // Symmetric, far from normal (uncertainties span decades), and all but defective.
  Eigen::MatrixXd symmetric = Eigen::MatrixXd::Zero(30, 30);
  for (Eigen::Index i = 0; i < 30; ++i) {
    symmetric(i, i) = -2.0;
    if (i > 0) symmetric(i, i - 1) = symmetric(i - 1, i) = 1.0;
  }
  Eigen::MatrixXd skewed = symmetric;
  for (Eigen::Index i = 1; i < 30; ++i) skewed(i, i - 1) = 0.4;
  for (Eigen::MatrixXd const& matrix : {symmetric, skewed}) {
    double const excess = largest_excess(matrix, 1e-13);
    BOOST_TEST(excess < 1.0);
    // Nor is it so careful that it says nothing.
    BOOST_TEST(excess > 1e-3);
  }
  // A defective pair goes by the root of the change: 1e-8 of the norm for rounding alone.
  Eigen::MatrixXd defective = Eigen::MatrixXd::Zero(3, 3);
  defective << -1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -5.0;
  BOOST_TEST(largest_excess(defective, 1e-13) < 1.0);
  Spectrum const found = dense_spectrum(defective + 1e-15 * Eigen::MatrixXd::Ones(3, 3), 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    bool const is_pair = std::abs(found.eigenvalues[k] + 1.0) < 0.1;
    BOOST_TEST((found.uncertainty[k] > 1e-9) == is_pair);
  }
}

BOOST_AUTO_TEST_CASE(what_nears_a_defective_zero_is_no_growth) {
  // A corner of d on a Jordan block of size m moves its zeros by d^(1/m): that much may be the block itself.
  for (Eigen::Index const m : {2, 3, 4}) {
    for (double const d : {1e-14, 1e-12, 1e-8}) {
      Eigen::MatrixXd block = Eigen::MatrixXd::Zero(m + 1, m + 1);
      for (Eigen::Index i = 0; i + 1 < m; ++i) block(i, i + 1) = 1.0;
      block(m - 1, 0) = d;
      block(m, m) = -3.0;
      Stability const s = stability_of(dense_spectrum(block, d));
      BOOST_TEST(*s.growing_modes == 0u);
      // Known to the last bit it grows.
      if (d > 1e-10) BOOST_TEST(*stability_of(dense_spectrum(block, 0.0)).growing_modes > 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(modes_that_grow_come_first) {
  // A defective pair that is off by 1e-6 stands further right than a mode that surely grows, by 1e-9.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(4, 4);
  matrix(0, 1) = 1.0;
  matrix(1, 0) = 1e-14;
  matrix(2, 2) = 1e-9;
  matrix(3, 3) = -1.0;
  Spectrum const found = dense_spectrum(matrix, 1e-14);
  BOOST_TEST(found.eigenvalues[0].real() == 1e-9, tolerance(1e-3));
  BOOST_TEST(found.eigenvalues[1].real() > 1e-8);
  BOOST_TEST(std::abs(found.modes[0][2]) == 1.0, tolerance(1e-6));
  Stability const s = stability_of(found);
  BOOST_TEST(*s.growing_modes == 1u);
  BOOST_TEST(*s.spectral_abscissa == 1e-9, tolerance(1e-3));
  BOOST_TEST(*s.abscissa_uncertainty < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_mode_that_the_matrix_cannot_tell_from_rest_does_not_grow) {
  // 1e-9 of growth beside a radius of 1: certain from exact entries, not from entries that are off by 1e-8.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2, 2);
  matrix(0, 0) = 1e-9;
  matrix(1, 1) = -1.0;
  Stability const certain = stability_of(dense_spectrum(matrix, 0.0));
  BOOST_TEST(*certain.growing_modes == 1u);
  BOOST_TEST(*certain.abscissa_uncertainty < 1e-13);
  Stability const uncertain = stability_of(dense_spectrum(matrix, 1e-8));
  BOOST_TEST(*uncertain.growing_modes == 0u);
  BOOST_TEST(*uncertain.abscissa_uncertainty == 4e-8, tolerance(1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
