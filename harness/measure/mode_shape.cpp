// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/mode_shape.hpp"

#include <cmath>
#include <numbers>

#include "formulations/basics/expects.hpp"
#include "formulations/neighbours/neighbours.hpp"

namespace sphverify {

template <int Dim>
Mode mode_shape(std::complex<double> eigenvalue, Eigen::Ref<Eigen::VectorXcd const> const& amplitude,
                Particles<Dim> const& particles, Domain<Dim> const& domain,
                std::vector<Wall<Dim>> const& walls, double spacing) {
  std::size_t const n = particles.size();
  expects(static_cast<std::size_t>(amplitude.size()) % n == 0);
  std::size_t const components = static_cast<std::size_t>(amplitude.size()) / n;
  auto const at = [&](std::size_t i, std::size_t c) {
    return amplitude[static_cast<Eigen::Index>(c * n + i)];
  };

  Mode mode{.growth = eigenvalue.real(),
            .frequency = eigenvalue.imag(),
            .wavelength = {},
            .wall_share = {},
            .centre = {}};
  Vector<Dim> centre = Vector<Dim>::Zero();
  double whole = 0.0;
  double near_wall = 0.0;
  double const reach = particles.kernel().support_ratio() * particles.smoothing_length();
  for (std::size_t i = 0; i < n; ++i) {
    double squared = 0.0;
    for (std::size_t c = 0; c < components; ++c) squared += std::norm(at(i, c));
    Vector<Dim> const x = particles.positions()[i];
    whole += squared;
    centre += squared * x;
    for (Wall<Dim> const& wall : walls) {
      if (wall.distance(x) > reach) continue;
      near_wall += squared;
      break;
    }
  }
  if (!(whole > 0.0)) return mode;
  centre /= whole;
  mode.centre.assign(centre.begin(), centre.end());
  if (!walls.empty()) mode.wall_share = near_wall / whole;

  NeighbourList const near = find_neighbours(CellGrid<Dim>(particles.positions(), domain, 1.3 * spacing));
  double differences = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t const j : near.row(i)) {
      for (std::size_t c = 0; c < components; ++c) {
        differences += std::norm(at(i, c) - at(j, c));
        squares += std::norm(at(i, c)) + std::norm(at(j, c));
      }
    }
  }
  double const drop = squares > 0.0 ? std::min(2.0, Dim * differences / squares) : 0.0;
  if (drop > 1e-9) mode.wavelength = 2.0 * std::numbers::pi / std::acos(1.0 - drop);
  return mode;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                   \
  template Mode mode_shape(std::complex<double>, Eigen::Ref<Eigen::VectorXcd const> const&,          \
                           Particles<Dim> const&, Domain<Dim> const&, std::vector<Wall<Dim>> const&, \
                           double);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
