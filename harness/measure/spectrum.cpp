#include "harness/measure/spectrum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "formulations/support/expects.hpp"

namespace sphverify {

std::vector<std::complex<double>> spectrum(DependencyPattern const& pattern,
                                           std::vector<double> const& values) {
  auto const n = static_cast<Eigen::Index>(pattern.rows());
  expects(pattern.rows() <= largest_dense_spectrum);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index row = 0; row < n; ++row) {
    for (std::int64_t k = pattern.first[row]; k < pattern.first[row + 1]; ++k)
      dense(row, pattern.column[k]) = values[k];
  }
  Eigen::EigenSolver<Eigen::MatrixXd> const solver(dense, false);
  auto const& eigenvalues = solver.eigenvalues();
  return {eigenvalues.begin(), eigenvalues.end()};
}

Stability stability_of(std::vector<std::complex<double>> const& eigenvalues) {
  double abscissa = -std::numeric_limits<double>::infinity();
  double radius = 0.0;
  for (auto const& lambda : eigenvalues) {
    abscissa = std::max(abscissa, lambda.real());
    radius = std::max(radius, std::abs(lambda));
  }
  double const growth = 1e-10 * radius;
  std::uint64_t growing = 0;
  double step = std::numeric_limits<double>::infinity();
  for (auto const& lambda : eigenvalues) {
    if (lambda.real() > growth) ++growing;
    // A mode that only oscillates has no stable step, one that stands still (lambda = 0) any.
    if (std::abs(lambda) > growth)
      step = std::min(step, std::max(0.0, -2.0 * lambda.real() / std::norm(lambda)));
  }
  Stability stability;
  stability.spectral_abscissa = abscissa;
  stability.spectral_radius = radius;
  stability.growing_modes = growing;
  if (growing > 0) {
    stability.remark = "no step is stable: a mode grows";
  } else if (step * radius < 1e-9) {
    stability.remark = "no step is stable: a mode oscillates undamped";
  } else if (std::isfinite(step)) {
    stability.largest_stable_step = step;
  } else {
    stability.remark = "any step is stable: no mode decays";
  }
  return stability;
}

}  // namespace sphverify
