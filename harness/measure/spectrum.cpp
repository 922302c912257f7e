// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/spectrum.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>
#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/finite.hpp"

namespace sphverify {

namespace {

constexpr char const* not_finite = "the linearised rate is not finite";
/// Part of the spectral radius that an eigenvalue may be off by before "no mode grows" says nothing: a mode
/// that grows by so much would be seen within a few of the fastest periods.
constexpr double vague_part = 0.1;

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

bool grows(Spectrum const& s, std::size_t k) { return s.eigenvalues[k].real() > s.uncertainty[k]; }

void put_growing_first(Spectrum& found) {
  std::vector<std::size_t> order(found.eigenvalues.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (grows(found, a) != grows(found, b)) return grows(found, a);
    return found.eigenvalues[a].real() > found.eigenvalues[b].real();
  });
  Spectrum const before = found;
  for (std::size_t k = 0; k < order.size(); ++k) {
    found.eigenvalues[k] = before.eigenvalues[order[k]];
    found.uncertainty[k] = before.uncertainty[order[k]];
    found.modes[k] = before.modes[order[k]];
  }
}

/// Approximate eigenvalues from a space of few dimensions, with their vectors where they have converged.
struct RitzPairs {
  std::vector<std::complex<double>> values, converged;
  std::vector<Eigen::VectorXcd> vectors;  ///< of those that have converged, of length 1

  bool has_converged(std::complex<double> value) const {
    return std::find(converged.begin(), converged.end(), value) != converged.end();
  }
};

/// Arnoldi's method without restarts, every direction made orthogonal to all before twice: what it costs in
/// memory it gains in being sure. A pair has converged when its residual is below `accuracy` times the
/// largest value.
RitzPairs arnoldi(std::function<Eigen::VectorXd(Eigen::VectorXd const&)> const& apply, Eigen::Index n,
                  int most, double accuracy) {
  Eigen::Index const steps = std::min<Eigen::Index>(n, most);
  Eigen::MatrixXd basis(n, steps + 1);
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(steps + 1, steps);
  std::mt19937_64 random(1);
  for (Eigen::Index i = 0; i < n; ++i)
    basis(i, 0) = 2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0;
  basis.col(0).normalize();
  Eigen::Index size = 0;
  double beyond = 0.0;
  while (size < steps) {
    Eigen::VectorXd next = apply(basis.col(size));
    double const length = next.norm();
    auto const known = basis.leftCols(size + 1);
    for (int twice = 0; twice < 2; ++twice) {
      Eigen::VectorXd const part = known.transpose() * next;
      next -= known * part;
      projected.col(size).head(size + 1) += part;
    }
    beyond = next.norm();
    ++size;
    // The space is invariant: everything in it has converged.
    if (!(beyond > 1e-13 * length)) {
      beyond = 0.0;
      break;
    }
    projected(size, size - 1) = beyond;
    basis.col(size) = next / beyond;
  }
  Eigen::EigenSolver<Eigen::MatrixXd> const solver(projected.topLeftCorner(size, size));
  RitzPairs pairs;
  pairs.values.assign(solver.eigenvalues().begin(), solver.eigenvalues().end());
  double largest = 0.0;
  for (auto const& value : pairs.values) largest = std::max(largest, std::abs(value));
  Eigen::MatrixXcd const vectors = solver.eigenvectors();
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::VectorXcd const y = vectors.col(k).normalized();
    if (beyond * std::abs(y[size - 1]) > accuracy * largest) continue;
    pairs.converged.push_back(pairs.values[static_cast<std::size_t>(k)]);
    pairs.vectors.emplace_back(basis.leftCols(size) * y);
  }
  return pairs;
}

/// To round-off of the largest: the eigenvalues of [0 A^T; A 0] are they and their negatives. Eigen's decompositions into
/// singular values take a minute to compile.
Eigen::VectorXd singular_values(Eigen::MatrixXd const& matrix) {
  Eigen::Index const n = matrix.rows();
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  both.bottomLeftCorner(n, n) = matrix;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(both, Eigen::EigenvaluesOnly).eigenvalues().tail(n);
}

}  // namespace

Spectrum dense_spectrum(Eigen::MatrixXd const& matrix, double matrix_error) {
  // Backward error of the QR algorithm, in parts of the matrix's norm; above what was ever seen of it.
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  constexpr double coinciding = 4.0;
  Spectrum found;
  if (!matrix.allFinite()) {
    found.remark = not_finite;
    return found;
  }
  found.complete = true;
  Eigen::VectorXd const sizes = singular_values(matrix);
  double const largest = sizes.maxCoeff();
  double const zero = 1e-12 * static_cast<double>(matrix.rows()) * largest;
  found.unseen_modes = static_cast<std::uint64_t>(
      std::count_if(sizes.begin(), sizes.end(), [&](double s) { return s <= zero; }));
  Eigen::EigenSolver<Eigen::MatrixXd> const solver(matrix, true);
  if (solver.info() != Eigen::Success) {
    found.complete = false;
    found.unseen_modes.reset();
    found.remark = "the eigenvalues were not found: their iteration does not converge";
    return found;
  }
  found.eigenvalues.assign(solver.eigenvalues().begin(), solver.eigenvalues().end());
  Eigen::MatrixXcd const vectors = solver.eigenvectors();
  // Its rows are the left eigenvectors, of a length that makes their product with the right ones 1.
  Eigen::MatrixXcd const inverse = vectors.inverse();
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    double const change = coinciding * (rounding + matrix_error) * matrix.norm();
    double const moved = inverse.row(k).norm() * vectors.col(k).norm() * change;
    // A defective matrix may have no inverse at all; no eigenvalue is larger than the largest singular value.
    found.uncertainty.push_back(moved < largest ? moved : largest);
    found.modes.emplace_back(vectors.col(k));
  }
  put_growing_first(found);
  return found;
}

Spectrum outer_spectrum(DependencyPattern const& pattern, std::vector<double> const& values,
                        double matrix_error, std::size_t most_nonzeros) {
  constexpr int directions = 300;
  constexpr int slow_directions = 60;
  constexpr double accuracy = 1e-8;
  SparseMatrix const matrix = sparse_matrix(pattern, values);
  Spectrum found;
  if (first_not_finite(values)) {
    found.remark = not_finite;
    return found;
  }
  RitzPairs const outer = arnoldi([&](Eigen::VectorXd const& x) { return Eigen::VectorXd(matrix * x); },
                                  matrix.rows(), directions, accuracy);
  auto const by = [](auto const& measure) {
    return [measure](auto const& a, auto const& b) { return measure(a) < measure(b); };
  };
  auto const modulus = [](std::complex<double> z) { return std::abs(z); };
  auto const height = [](std::complex<double> z) { return z.imag(); };
  double const radius = modulus(*std::max_element(outer.values.begin(), outer.values.end(), by(modulus)));
  // The slow modes lie close together: that they do not converge here is usual, and why they are looked for
  // below.
  if (!outer.has_converged(*std::max_element(outer.values.begin(), outer.values.end(), by(modulus)))) {
    found.remark = "Arnoldi's method did not find the largest eigenvalues";
    return found;
  }
  auto const take = [&](std::complex<double> value, Eigen::VectorXcd vector, double residual) {
    found.eigenvalues.push_back(value);
    found.uncertainty.push_back(residual + matrix_error * radius);
    found.modes.push_back(std::move(vector));
  };
  for (std::size_t k = 0; k < outer.converged.size(); ++k)
    take(outer.converged[k], outer.vectors[k], accuracy * radius);
  auto const highest = *std::max_element(outer.values.begin(), outer.values.end(), by(height));
  if (highest.imag() > 1e-6 * radius && !outer.has_converged(highest))
    found.remark = "Arnoldi's method did not find the largest imaginary part";
  if (values.size() > most_nonzeros) {
    put_growing_first(found);
    found.knows_slowest = false;
    found.remark =
        fmt::format("the slowest eigenvalues are not looked for in more than {} nonzeros, found {}",
                    most_nonzeros, values.size());
    return found;
  }

  double const shift = 1e-6 * radius;
  SparseMatrix shifted = matrix;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) shifted.coeffRef(i, i) -= shift;
  shifted.makeCompressed();
  Eigen::SparseLU<SparseMatrix> factors(shifted);
  RitzPairs slow;
  if (factors.info() == Eigen::Success) {
    slow = arnoldi([&](Eigen::VectorXd const& x) { return Eigen::VectorXd(factors.solve(x)); }, matrix.rows(),
                   slow_directions, accuracy);
  }
  if (slow.converged.empty()) {
    found.knows_slowest = false;
    found.remark = "Arnoldi's method did not find the slowest eigenvalues";
  }
  for (std::size_t k = 0; k < slow.converged.size(); ++k) {
    std::complex<double> const value = shift + 1.0 / slow.converged[k];
    // Far from the shift the inverse knows little.
    Eigen::VectorXcd const& v = slow.vectors[k];
    double const residual = (matrix * v - value * v).norm();
    if (residual < 1e-6 * radius) take(value, v, std::max(residual, accuracy * radius));
  }
  put_growing_first(found);
  return found;
}

Spectrum spectrum(DependencyPattern const& pattern, std::vector<double> const& values, double matrix_error) {
  if (pattern.rows() > largest_dense_spectrum) return outer_spectrum(pattern, values, matrix_error);
  return dense_spectrum(Eigen::MatrixXd(sparse_matrix(pattern, values)), matrix_error);
}

Stability stability_of(Spectrum const& spectrum) {
  Stability stability;
  stability.method = spectrum.complete ? "dense" : "arnoldi";
  stability.remark = spectrum.remark;
  if (spectrum.eigenvalues.empty()) return stability;
  double radius = 0.0;
  double imaginary = 0.0;
  for (auto const& lambda : spectrum.eigenvalues) {
    radius = std::max(radius, std::abs(lambda));
    imaginary = std::max(imaginary, std::abs(lambda.imag()));
  }
  std::uint64_t growing = 0;
  bool is_known = true;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < spectrum.eigenvalues.size(); ++k) {
    auto const& lambda = spectrum.eigenvalues[k];
    if (grows(spectrum, k)) ++growing;
    // A mode that only oscillates has no stable step, one that stands still (lambda = 0) any.
    if (std::abs(lambda) > spectrum.uncertainty[k]) {
      step = std::min(step, std::max(0.0, -2.0 * lambda.real() / std::norm(lambda)));
    } else if (std::abs(lambda) > slow_part * radius) {
      is_known = false;
    }
  }
  double const vaguest = *std::max_element(spectrum.uncertainty.begin(), spectrum.uncertainty.end());
  bool const is_vague = growing == 0 && !(vaguest <= vague_part * radius) && radius > 0.0;
  if (is_vague) {
    stability.remark = fmt::format(
        "whether a mode grows is not known: eigenvalues may be off by {:.2g}/s, and the largest is {:.2g}/s",
        vaguest, radius);
  } else if (spectrum.knows_slowest || growing > 0) {
    stability.spectral_abscissa = spectrum.eigenvalues.front().real();
    stability.abscissa_uncertainty = spectrum.uncertainty.front();
  }
  stability.spectral_radius = radius;
  stability.largest_imaginary = imaginary;
  stability.unseen_modes = spectrum.unseen_modes;
  // The outermost eigenvalues do not tell how many others grow.
  if (!is_vague && (spectrum.complete || (growing == 0 && spectrum.knows_slowest)))
    stability.growing_modes = growing;
  if (!stability.remark.empty()) return stability;
  if (growing > 0) {
    stability.remark = "no step is stable: a mode grows";
  } else if (!is_known) {
    stability.remark = "a fast mode is not known well enough";
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
