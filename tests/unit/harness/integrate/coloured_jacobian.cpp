// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/integrate/coloured_jacobian.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(harness_integrate_coloured_jacobian)

using namespace sphverify;
using namespace sphverify::tests;
using Dense = Eigen::MatrixXd;

DependencyPattern pattern_where(std::size_t n,
                                std::function<bool(std::int64_t row, std::int64_t column)> const& depends) {
  DependencyPattern pattern;
  pattern.first.push_back(0);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(n); ++i) {
    for (std::int64_t j = 0; j < static_cast<std::int64_t>(n); ++j) {
      if (depends(i, j)) pattern.column.push_back(j);
    }
    pattern.first.push_back(static_cast<std::int64_t>(pattern.column.size()));
  }
  return pattern;
}

DependencyPattern band(std::size_t n, std::int64_t reach) {
  return pattern_where(n, [reach](std::int64_t i, std::int64_t j) { return std::abs(i - j) <= reach; });
}

Dense random_matrix(DependencyPattern const& pattern, std::uint64_t seed) {
  Random random(seed);
  auto const n = static_cast<Eigen::Index>(pattern.rows());
  Dense matrix = Dense::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (std::int64_t k = pattern.first[i]; k < pattern.first[i + 1]; ++k)
      matrix(i, pattern.column[k]) = random.uniform(-3.0, 3.0);
  }
  return matrix;
}

Dense dense(DependencyPattern const& pattern, std::vector<double> const& values) {
  auto const n = static_cast<Eigen::Index>(pattern.rows());
  Dense matrix = Dense::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (std::int64_t k = pattern.first[i]; k < pattern.first[i + 1]; ++k)
      matrix(i, pattern.column[k]) = values[k];
  }
  return matrix;
}

double worst_entry(DependencyPattern const& pattern, std::vector<double> const& values,
                   Dense const& expected) {
  return (dense(pattern, values) - expected).cwiseAbs().maxCoeff();
}

/// Affine rate A y + b with a count of its evaluations.
struct Affine {
  Dense matrix;
  std::size_t calls = 0;

  ColouredJacobian::Rate rate() {
    return [this](double t, double const* y, double* out) {
      ++calls;
      Eigen::Map<Eigen::VectorXd const> const state(y, matrix.rows());
      Eigen::Map<Eigen::VectorXd>(out, matrix.rows()) =
          matrix * state + Eigen::VectorXd::Constant(matrix.rows(), 5.0 + t);
    };
  }
};

BOOST_AUTO_TEST_CASE(an_affine_rate_gives_its_matrix_to_round_off_and_is_differenced_once) {
  DependencyPattern const pattern = band(40, 3);
  Affine affine{random_matrix(pattern, 1)};
  ColouredJacobian jacobian(pattern, affine.rate(), true, 2.0);
  std::vector<double> y(40, 1.5);
  BOOST_TEST(worst_entry(pattern, jacobian.evaluate(0.0, y.data()), affine.matrix) < 1e-13);
  std::size_t const calls = affine.calls;
  BOOST_TEST(calls == jacobian.colours() + 1u);
  y.assign(40, -7.0);
  BOOST_TEST(worst_entry(pattern, jacobian.evaluate(3.0, y.data()), affine.matrix) < 1e-13);
  BOOST_TEST(affine.calls == calls);
}

BOOST_AUTO_TEST_CASE(a_band_needs_as_many_colours_as_it_is_wide_however_many_rows_it_has) {
  for (std::int64_t const reach : {0, 1, 2, 5}) {
    for (std::size_t const n : {30u, 300u}) {
      ColouredJacobian const jacobian(
          band(n, reach), [](double, double const*, double*) {}, true, 1.0);
      BOOST_TEST(jacobian.colours() == static_cast<std::size_t>(2 * reach + 1));
    }
  }
}

BOOST_AUTO_TEST_CASE(irregular_and_unsymmetric_patterns_are_differenced_right) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    DependencyPattern const pattern = pattern_where(
        25, [&random](std::int64_t i, std::int64_t j) { return i == j || random.uniform(0.0, 1.0) < 0.12; });
    Affine affine{random_matrix(pattern, 100 + seed)};
    ColouredJacobian jacobian(pattern, affine.rate(), true, 1.0);
    std::vector<double> const y(25, 0.3);
    BOOST_TEST(worst_entry(pattern, jacobian.evaluate(0.0, y.data()), affine.matrix) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_row_that_depends_on_everything_forces_a_colour_per_unknown) {
  DependencyPattern const arrow =
      pattern_where(12, [](std::int64_t i, std::int64_t j) { return i == 0 || i == j; });
  Affine affine{random_matrix(arrow, 3)};
  ColouredJacobian jacobian(arrow, affine.rate(), true, 1.0);
  BOOST_TEST(jacobian.colours() == 12u);
  std::vector<double> const y(12, 0.0);
  BOOST_TEST(worst_entry(arrow, jacobian.evaluate(0.0, y.data()), affine.matrix) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_nonlinear_rate_is_differenced_anew_at_every_state_and_time) {
  std::size_t const n = 20;
  DependencyPattern const pattern = band(n, 1);
  auto const rate = [](double t, double const* y, double* out) {
    for (std::size_t i = 0; i < n; ++i) {
      double const left = i > 0 ? y[i - 1] : 0.0;
      double const right = i + 1 < n ? y[i + 1] : 0.0;
      out[i] = y[i] * y[i] * (right - 2.0 * left) + std::sin(y[i]) + t * right;
    }
  };
  ColouredJacobian jacobian(pattern, rate, false, 1.0);
  for (double const t : {0.0, 2.0}) {
    Random random(static_cast<std::uint64_t>(10.0 + t));
    std::vector<double> y(n);
    for (double& value : y) value = random.uniform(-2.0, 2.0);
    auto const size = static_cast<Eigen::Index>(n);
    Dense expected = Dense::Zero(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      double const left = i > 0 ? y[i - 1] : 0.0;
      double const right = i + 1 < size ? y[i + 1] : 0.0;
      expected(i, i) = 2.0 * y[i] * (right - 2.0 * left) + std::cos(y[i]);
      if (i > 0) expected(i, i - 1) = -2.0 * y[i] * y[i];
      if (i + 1 < size) expected(i, i + 1) = y[i] * y[i] + t;
    }
    BOOST_TEST(worst_entry(pattern, jacobian.evaluate(t, y.data()), expected) < 2e-6);
  }
}

BOOST_AUTO_TEST_CASE(an_unknown_that_is_zero_is_still_perturbed) {
  DependencyPattern const pattern = band(3, 0);
  ColouredJacobian jacobian(
      pattern,
      [](double, double const* y, double* out) {
        for (int i = 0; i < 3; ++i) out[i] = std::exp(y[i]);
      },
      false, 1.0);
  std::vector<double> const y{0.0, 0.0, 1.0};
  auto const& values = jacobian.evaluate(0.0, y.data());
  BOOST_TEST(std::abs(values[0] - 1.0) < 1e-6);
  BOOST_TEST(std::abs(values[2] - std::exp(1.0)) < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
