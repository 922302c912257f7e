// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/kernel_damping.hpp"

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <vector>

#include "formulations/kernels/kernel.hpp"

namespace sphverify {

namespace {

/// Piece by piece of the kernel's polynomials.
double integral(Kernel const& kernel) {
  int const dimension = kernel.dimension();
  double const sphere = std::array{2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi}[static_cast<std::size_t>(dimension - 1)];
  auto const shell = [&](double r) { return sphere * std::pow(r, dimension - 1) * std::abs(kernel.radial(r, 1.0)); };
  std::vector<double> ends = kernel.knots();
  ends.push_back(kernel.info().support_ratio);
  double sum = 0.0, from = 0.0;
  for (double const to : ends) {
    sum += boost::math::quadrature::gauss<double, 30>::integrate(shell, from, to);
    from = to;
  }
  return sum;
}

}  // namespace

double kernel_damping(Kernel const& kernel) {
  static std::mutex mutex;
  static std::map<Kernel const*, double> known;  // kernels live as long as the program
  std::scoped_lock const lock(mutex);
  auto const [place, is_new] = known.try_emplace(&kernel, 0.0);
  if (is_new) place->second = integral(kernel);
  return place->second;
}

}  // namespace sphverify
