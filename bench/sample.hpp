// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sphverify::bench {

/// Gas on a jittered cubic lattice in the unit box, as plain arrays of one entry per particle, SI units.
struct Sample {
  double spacing = 0.0;  ///< of the lattice [m]
  double h = 0.0;        ///< smoothing length, 1.2 spacings; the support is 2 h [m]
  std::vector<double> x{}, y{}, z{}, vx{}, vy{}, vz{};
  std::vector<double> m{}, rho{}, P{}, c{}, T{},
      K{};  ///< mass, density, pressure, sound speed, temperature, conductivity

  std::size_t size() const { return x.size(); }
  double reach() const { return 2.0 * h; }
};

/// per_side^3 particles, each displaced by up to 0.1 spacings along every axis, numbered in random order. The
/// fields are smooth plus a little noise, so that no two particles are alike. The same on every machine.
Sample make_sample(std::size_t per_side);

/// The particle order[k] becomes number k.
Sample reordered(Sample const& sample, std::span<std::uint32_t const> order);

}  // namespace sphverify::bench
