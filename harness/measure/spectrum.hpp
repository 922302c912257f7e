#pragma once

#include <complex>
#include <vector>

#include "harness/integrate/coloured_jacobian.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Largest operator whose eigenvalues are computed; beyond it the dense solver takes minutes.
inline constexpr std::size_t largest_dense_spectrum = 512;

/// Eigenvalues of a sparse operator by Eigen's dense solver. Expects at most `largest_dense_spectrum` rows.
std::vector<std::complex<double>> spectrum(DependencyPattern const& pattern,
                                           std::vector<double> const& values);

/// What the eigenvalues say: abscissa, radius, growing modes, and the largest stable step of explicit Euler,
/// min over moving modes of -2 Re(lambda)/|lambda|^2. A mode grows if its real part exceeds 1e-10 of the
/// radius.
Stability stability_of(std::vector<std::complex<double>> const& eigenvalues);

}  // namespace sphverify
