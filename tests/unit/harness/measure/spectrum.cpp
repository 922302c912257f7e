#include "harness/measure/spectrum.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

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

BOOST_AUTO_TEST_SUITE_END()
