#include "harness/measure/spectrum.hpp"

#include <Spectra/GenEigsRealShiftSolver.h>
#include <Spectra/GenEigsSolver.h>
#include <Spectra/MatOp/SparseGenMatProd.h>
#include <Spectra/MatOp/SparseGenRealShiftSolve.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>

#include "formulations/support/expects.hpp"

namespace sphverify {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

SparseMatrix sparse_matrix(DependencyPattern const& pattern, std::vector<double> const& values) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(values.size());
  for (std::size_t row = 0; row < pattern.rows(); ++row) {
    for (auto k = static_cast<std::size_t>(pattern.first[row]);
         k < static_cast<std::size_t>(pattern.first[row + 1]); ++k) {
      entries.emplace_back(static_cast<int>(row), static_cast<int>(pattern.column[k]), values[k]);
    }
  }
  auto const n = static_cast<Eigen::Index>(pattern.rows());
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::size_t rightmost(std::vector<std::complex<double>> const& eigenvalues) {
  auto const less = [](auto const& a, auto const& b) { return a.real() < b.real(); };
  return static_cast<std::size_t>(std::max_element(eigenvalues.begin(), eigenvalues.end(), less) -
                                  eigenvalues.begin());
}

constexpr int wanted = 6;
constexpr int krylov_size = 60;
constexpr int most_restarts = 600;

template <class Solver>
void take(Solver& solver, Spectrum& found) {
  for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
    found.eigenvalues.push_back(solver.eigenvalues()[k]);
    found.modes.emplace_back(solver.eigenvectors().col(k));
  }
}

}  // namespace

Spectrum dense_spectrum(Eigen::MatrixXd const& matrix, bool all_modes) {
  Spectrum found;
  found.complete = true;
  Eigen::EigenSolver<Eigen::MatrixXd> const solver(matrix, true);
  found.eigenvalues.assign(solver.eigenvalues().begin(), solver.eigenvalues().end());
  found.worst = rightmost(found.eigenvalues);
  Eigen::MatrixXcd const vectors = solver.eigenvectors();
  if (all_modes) {
    for (Eigen::Index k = 0; k < vectors.cols(); ++k) found.modes.emplace_back(vectors.col(k));
  } else {
    found.modes.resize(found.eigenvalues.size());
    found.modes[found.worst] = vectors.col(static_cast<Eigen::Index>(found.worst));
  }
  auto const sizes = Eigen::BDCSVD<Eigen::MatrixXd>(matrix).singularValues();
  double const zero = 1e-12 * static_cast<double>(matrix.rows()) * sizes[0];
  found.unseen_modes = static_cast<std::uint64_t>(
      std::count_if(sizes.begin(), sizes.end(), [&](double s) { return s <= zero; }));
  return found;
}

Spectrum outer_spectrum(DependencyPattern const& pattern, std::vector<double> const& values) {
  expects(pattern.rows() > krylov_size);
  SparseMatrix const matrix = sparse_matrix(pattern, values);
  Spectrum found;
  Spectra::SparseGenMatProd<double> product(matrix);
  double radius = 0.0;
  for (auto const rule :
       {Spectra::SortRule::LargestMagn, Spectra::SortRule::LargestReal, Spectra::SortRule::LargestImag}) {
    Spectra::GenEigsSolver solver(product, wanted, krylov_size);
    solver.init();
    solver.compute(rule, most_restarts, 1e-9);
    bool const done = solver.info() == Spectra::CompInfo::Successful;
    // The slowest modes lie close together: that the rightmost do not converge is usual, and why the shifted
    // inverse looks for them as well.
    if (!done && rule == Spectra::SortRule::LargestMagn) {
      found.remark = "Arnoldi's method did not find the largest eigenvalues";
      return found;
    }
    take(solver, found);
    for (auto const& lambda : found.eigenvalues) radius = std::max(radius, std::abs(lambda));
  }
  Spectra::SparseGenRealShiftSolve<double> inverse(matrix);
  Spectra::GenEigsRealShiftSolver slowest(inverse, wanted, krylov_size, 1e-6 * radius);
  slowest.init();
  slowest.compute(Spectra::SortRule::LargestMagn, most_restarts, 1e-10);
  if (slowest.info() == Spectra::CompInfo::Successful) {
    take(slowest, found);
  } else {
    found.remark = "Arnoldi's method did not find the slowest eigenvalues";
  }
  found.worst = rightmost(found.eigenvalues);
  return found;
}

Spectrum spectrum(DependencyPattern const& pattern, std::vector<double> const& values) {
  if (pattern.rows() > largest_dense_spectrum) return outer_spectrum(pattern, values);
  return dense_spectrum(Eigen::MatrixXd(sparse_matrix(pattern, values)));
}

Stability stability_of(Spectrum const& spectrum) {
  Stability stability;
  stability.method = spectrum.complete ? "dense" : "arnoldi";
  stability.remark = spectrum.remark;
  if (spectrum.eigenvalues.empty()) return stability;
  double abscissa = -std::numeric_limits<double>::infinity();
  double radius = 0.0;
  double imaginary = 0.0;
  for (auto const& lambda : spectrum.eigenvalues) {
    abscissa = std::max(abscissa, lambda.real());
    radius = std::max(radius, std::abs(lambda));
    imaginary = std::max(imaginary, std::abs(lambda.imag()));
  }
  double const growth = (spectrum.complete ? 1e-10 : 1e-8) * radius;
  std::uint64_t growing = 0;
  double step = std::numeric_limits<double>::infinity();
  for (auto const& lambda : spectrum.eigenvalues) {
    if (lambda.real() > growth) ++growing;
    // A mode that only oscillates has no stable step, one that stands still (lambda = 0) any.
    if (std::abs(lambda) > growth)
      step = std::min(step, std::max(0.0, -2.0 * lambda.real() / std::norm(lambda)));
  }
  stability.spectral_abscissa = abscissa;
  stability.spectral_radius = radius;
  stability.largest_imaginary = imaginary;
  stability.unseen_modes = spectrum.unseen_modes;
  // The outermost eigenvalues do not tell how many others grow.
  if (spectrum.complete || growing == 0) stability.growing_modes = growing;
  if (!stability.remark.empty()) return stability;
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
