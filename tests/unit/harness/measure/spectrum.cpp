#include "harness/measure/spectrum.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

BOOST_AUTO_TEST_SUITE(harness_measure_spectrum)

using namespace sphverify;
using boost::test_tools::tolerance;
using Complex = std::complex<double>;

namespace {

Spectrum complete(std::vector<Complex> eigenvalues) {
  Spectrum all;
  all.eigenvalues = std::move(eigenvalues);
  all.complete = true;
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(eigenvalues_of_a_sparse_operator_are_those_of_its_matrix) {
  // [[-1, 2, 0], [-2, -1, 0], [0, 5, -4]]: -1 +- 2i and -4.
  DependencyPattern const pattern{{0, 2, 4, 6}, {0, 1, 0, 1, 1, 2}};
  auto found = spectrum(pattern, {-1.0, 2.0, -2.0, -1.0, 5.0, -4.0});
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
  Stability const s = stability_of(spectrum(pattern, values));
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

BOOST_AUTO_TEST_CASE(a_mode_that_grows_leaves_no_stable_step) {
  Stability const s = stability_of(complete({{-5.0, 0.0}, {0.3, 1.0}, {0.3, -1.0}}));
  BOOST_TEST(*s.spectral_abscissa == 0.3);
  BOOST_TEST(*s.growing_modes == 2u);
  BOOST_TEST(!s.largest_stable_step.has_value());
}

BOOST_AUTO_TEST_CASE(a_zero_that_round_off_made_positive_does_not_grow) {
  Stability const s = stability_of(complete({{-100.0, 0.0}, {1e-10, 0.0}}));
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
  Stability const all = stability_of(spectrum(pattern, values));
  Stability const outer = stability_of(outer_spectrum(pattern, values));
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
  Stability const whole = stability_of(outer_spectrum(pattern, values));
  Stability const outer = stability_of(outer_spectrum(pattern, values, values.size() - 1));
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
  Stability const growing = stability_of(outer_spectrum(pattern, values, values.size() - 1));
  BOOST_TEST(*growing.spectral_abscissa > 8.0);
  BOOST_TEST(!growing.growing_modes.has_value());
}

BOOST_AUTO_TEST_CASE(the_worst_mode_is_an_eigenvector) {
  DependencyPattern pattern;
  std::vector<double> values;
  ring(100, pattern, values);
  for (Spectrum const& found : {spectrum(pattern, values), outer_spectrum(pattern, values)}) {
    Eigen::VectorXcd const& v = found.modes[found.worst];
    Complex const lambda = found.eigenvalues[found.worst];
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
  BOOST_TEST(*dense_spectrum(difference * difference).unseen_modes == 2u);
  BOOST_TEST(*dense_spectrum(Eigen::MatrixXd(-Eigen::MatrixXd::Identity(5, 5))).unseen_modes == 0u);
  // A zero eigenvalue without a second eigenvector counts once.
  Eigen::MatrixXd defective = Eigen::MatrixXd::Zero(3, 3);
  defective(0, 1) = 1.0;
  defective(2, 2) = -1.0;
  BOOST_TEST(*dense_spectrum(defective).unseen_modes == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
