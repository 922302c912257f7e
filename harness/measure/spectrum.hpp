// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "harness/integrate/coloured_jacobian.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Largest operator whose eigenvalues are all computed; beyond it the dense solver takes minutes.
inline constexpr std::size_t largest_dense_spectrum = 512;
/// Largest operator of which the outermost eigenvalues are.
inline constexpr std::size_t largest_sparse_spectrum = 50'000;
/// Most nonzeros of an operator that is factorised to find its slowest eigenvalues. At this size it takes 20
/// s and 400 MB at most, in 3D, and nothing can interrupt it; both grow about with the square of it.
inline constexpr std::size_t most_factorised_nonzeros = 1'000'000;

/// Part of the spectral radius below which an eigenvalue that may be zero is taken for one that stands still.
inline constexpr double slow_part = 1e-4;

/// Eigenvalues of a linear operator [1/s] and what else is known of it.
/// Those that grow (whose real part exceeds their uncertainty) come first, each part by falling real part.
struct Spectrum {
  std::vector<std::complex<double>> eigenvalues;  ///< all of them, or those found
  /// How far each may be off, by what the matrix is off and by rounding [1/s].
  std::vector<double> uncertainty;
  bool complete = false;
  std::vector<Eigen::VectorXcd> modes;        ///< one per eigenvalue
  std::optional<std::uint64_t> unseen_modes;  ///< dimension of the kernel; known when complete
  bool knows_slowest = true;  ///< else a mode that hardly grows or decays may have been missed
  std::string remark;         ///< why it is not what was asked for
};

/// All eigenvalues and modes by Eigen's dense solver; the kernel by its singular values, so that
/// what defective zero eigenvalues hide is counted too: singular values below 1e-12 of the largest times the
/// operator's size are zero. To first order an eigenvalue is off by at most what the matrix is off (its
/// Frobenius norm) times 1/|y* x|, of its left and right eigenvectors of length 1 (Wilkinson, The Algebraic
/// Eigenvalue Problem, 1965, chapter 2). Of m that all but coincide without as many eigenvectors this says
/// the m-th part of what they are off, the m-th root of the change: four times it is taken.
/// @param matrix_error what the matrix is off, as a part of it
Spectrum dense_spectrum(Eigen::MatrixXd const& matrix, double matrix_error);

/// The outermost eigenvalues of a sparse matrix by Arnoldi's method, and those nearest to a point just right
/// of zero by its shifted inverse, since slow modes hide from the former. Every one of them has a small
/// residual. The latter are left out, with a remark, where more than `most_nonzeros` would be factorised. Of
/// the uncertainty only what the residuals and the matrix are off is known, not by what eigenvectors that are
/// not orthogonal multiply it.
Spectrum outer_spectrum(DependencyPattern const& pattern, std::vector<double> const& values,
                        double matrix_error, std::size_t most_nonzeros = most_factorised_nonzeros);

/// The one of the two that suits the size.
Spectrum spectrum(DependencyPattern const& pattern, std::vector<double> const& values, double matrix_error);

/// What the eigenvalues say: abscissa, radius, growing modes, and the largest stable step of explicit Euler,
/// min over moving modes of -2 Re(lambda)/|lambda|^2. A mode grows if its real part exceeds its uncertainty.
/// The abscissa is left out where the slowest modes are not known and none of the others grows; with it the
/// number of growing modes, where none is seen to but an eigenvalue may be off by more than a tenth of the
/// radius.
Stability stability_of(Spectrum const& spectrum);

}  // namespace sphverify
