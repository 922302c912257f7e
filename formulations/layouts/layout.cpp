// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/layouts/layout.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/layouts/layout_common.hpp"

namespace sphverify {

namespace {

template <int Dim>
using Shape = std::array<std::size_t, Dim>;

/// Cells of the lattice along each axis.
template <int Dim>
Shape<Dim> lattice_shape(Domain<Dim> const& domain, int resolution) {
  expects(resolution > 0);
  Vector<Dim> const extent = domain.extent();
  Shape<Dim> count;
  count[0] = static_cast<std::size_t>(resolution);
  for (int k = 1; k < Dim; ++k) count[k] = layers(extent[k], extent[0] / resolution);
  return count;
}

/// Particles in a row, and rows: always an even number of them.
Shape<2> hexagonal_shape(Domain<2> const& domain, int resolution) {
  expects(resolution > 0);
  // A particle of the triangular lattice of spacing a has the volume a^2 sqrt(3)/2, and the rows are as far
  // apart as that leaves.
  Vector<2> const extent = domain.extent();
  double const dx = extent[0] / resolution;
  double const a = std::sqrt(2.0 / std::sqrt(3.0)) * dx;
  return {layers(extent[0], a), 2 * layers(extent[1], 2.0 * dx * dx / a)};
}

/// Cubic cells of the face-centred lattice along each axis.
Shape<3> close_packed_shape(Domain<3> const& domain, int resolution) {
  expects(resolution > 0);
  constexpr double cube_root_of_4 = 1.5874010519681994748;  // four particles share a cell
  Vector<3> const extent = domain.extent();
  double const edge = cube_root_of_4 * extent[0] / resolution;
  return {layers(extent[0], edge), layers(extent[1], edge), layers(extent[2], edge)};
}

/// Numbers of any size, so that one can say no before there is no memory.
template <std::size_t Dim>
double product(std::array<std::size_t, Dim> const& shape) {
  double total = 1.0;
  for (std::size_t const count : shape) total *= static_cast<double>(count);
  return total;
}

}  // namespace

template <int Dim>
double lattice_count(Domain<Dim> const& domain, int resolution) {
  return product(lattice_shape(domain, resolution));
}
double hexagonal_count(Domain<2> const& domain, int resolution) {
  return product(hexagonal_shape(domain, resolution));
}
double close_packed_count(Domain<3> const& domain, int resolution) {
  return 4.0 * product(close_packed_shape(domain, resolution));
}

template <int Dim>
Layout<Dim> lattice(Domain<Dim> const& domain, int resolution) {
  Shape<Dim> const count = lattice_shape(domain, resolution);
  Vector<Dim> const extent = domain.extent();
  Layout<Dim> layout;
  layout.spacing = extent[0] / resolution;
  Vector<Dim>& cell = layout.cell;
  std::size_t total = 1;
  double volume = 1.0;
  for (int k = 0; k < Dim; ++k) {
    cell[k] = extent[k] / static_cast<double>(count[k]);
    total *= count[k];
    volume *= cell[k];
  }
  layout.positions = VectorField<Dim>(total);
  layout.volumes.assign(total, volume);
  for (std::size_t i = 0; i < total; ++i) {
    std::size_t rest = i;
    Vector<Dim> x;
    for (int k = Dim - 1; k >= 0; --k) {
      x[k] = domain.lower[k] + (static_cast<double>(rest % count[k]) + 0.5) * cell[k];
      rest /= count[k];
    }
    layout.positions.set(i, domain.to_space(x));
  }
  if constexpr (Dim == 1) {
    for (std::size_t i = 0; i <= total; ++i)
      layout.edges.push_back(domain.lower[0] + static_cast<double>(i) * cell[0]);
  }
  return layout;
}

void set_voronoi_volumes(Layout<1>& layout, Domain<1> const& domain) {
  auto const& x = layout.positions.component(0);
  std::size_t const n = x.size();
  double const lower = domain.lower[0];
  double const upper = domain.upper[0];
  // Over a periodic end the last particle's image is the first one's neighbour.
  double const across = domain.periodic[0] ? 0.5 * (x.front() + x.back() - (upper - lower)) : lower;
  double left = across;
  layout.edges = {across};
  for (std::size_t i = 0; i < n; ++i) {
    double const right =
        i + 1 < n ? 0.5 * (x[i] + x[i + 1]) : (domain.periodic[0] ? across + (upper - lower) : upper);
    layout.volumes[i] = right - left;
    layout.edges.push_back(right);
    left = right;
  }
}

template <int Dim>
Layout<Dim> jittered(Domain<Dim> const& domain, int resolution, double amplitude, std::uint64_t seed) {
  expects(amplitude >= 0.0 && amplitude < 0.5);
  Layout<Dim> layout = lattice(domain, resolution);
  std::mt19937_64 generator(seed);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    Vector<Dim> displacement;
    for (int k = 0; k < Dim; ++k)
      displacement[k] = amplitude * layout.cell[k] * signed_unit_deviate(generator);
    layout.positions.add(i, domain.to_space(displacement));
  }
  if constexpr (Dim == 1) set_voronoi_volumes(layout, domain);
  return layout;
}

template <int Dim>
Layout<Dim> at_random(Domain<Dim> const& domain, int resolution, std::uint64_t seed) {
  Layout<Dim> layout = lattice(domain, resolution);
  Vector<Dim> const half = 0.5 * domain.extent();
  std::mt19937_64 generator(seed);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    Vector<Dim> x = domain.lower + half;
    for (int k = 0; k < Dim; ++k) x[k] += half[k] * signed_unit_deviate(generator);
    layout.positions.set(i, domain.to_space(x));
  }
  if constexpr (Dim == 1) {
    auto& x = layout.positions.component(0);
    std::sort(x.begin(), x.end());
    set_voronoi_volumes(layout, domain);
  }
  return layout;
}

Layout<2> hexagonal(Domain<2> const& domain, int resolution) {
  auto const [row, rows] = hexagonal_shape(domain, resolution);
  Layout<2> layout;
  layout.cell = {domain.extent()[0] / static_cast<double>(row),
                 domain.extent()[1] / static_cast<double>(rows)};
  layout.positions = VectorField<2>(row * rows);
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    std::size_t const r = i % rows;
    Vector<2> const at(static_cast<double>(i / rows) + (r % 2 == 0 ? 0.25 : 0.75),
                       static_cast<double>(r) + 0.5);
    layout.positions.set(i, domain.to_space(domain.lower + layout.cell.cwiseProduct(at)));
  }
  share_volume_equally(layout, domain);
  return layout;
}

Layout<3> close_packed(Domain<3> const& domain, int resolution) {
  // Corner and centres of three faces of a cubic cell, a quarter of the cell inwards.
  static constexpr double offset[4][3] = {
      {0.25, 0.25, 0.25}, {0.25, 0.75, 0.75}, {0.75, 0.25, 0.75}, {0.75, 0.75, 0.25}};
  Shape<3> const count = close_packed_shape(domain, resolution);
  Layout<3> layout;
  for (int k = 0; k < 3; ++k) layout.cell[k] = domain.extent()[k] / static_cast<double>(count[k]);
  layout.positions = VectorField<3>(4 * count[0] * count[1] * count[2]);
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    std::size_t rest = i / 4;
    Vector<3> x;
    for (int k = 2; k >= 0; --k) {
      x[k] = domain.lower[k] + (static_cast<double>(rest % count[k]) + offset[i % 4][k]) * layout.cell[k];
      rest /= count[k];
    }
    layout.positions.set(i, domain.to_space(x));
  }
  share_volume_equally(layout, domain);
  return layout;
}

Layout<1> equal_mass(Domain<1> const& domain, int resolution, std::function<double(double x)> const& density,
                     std::vector<double> const& jumps) {
  expects(resolution > 0);
  // Mass from the lower end at the edges of cells much finer than the particles, and at the jumps, by the
  // midpoint rule, which takes a jump between two cells as it is.
  constexpr int cells_per_particle = 256;
  std::size_t const cells = static_cast<std::size_t>(resolution) * cells_per_particle;
  double const width = domain.extent()[0] / static_cast<double>(cells);
  double const lower = domain.lower[0];
  std::vector<double> edge{lower};
  std::vector<double> mass{0.0};
  auto const add_up_to = [&](double x) {
    double const from = edge.back();
    mass.push_back(mass.back() + (x - from) * density(0.5 * (from + x)));
    edge.push_back(x);
  };
  auto jump = jumps.begin();
  for (std::size_t c = 1; c <= cells; ++c) {
    double const next = c < cells ? lower + static_cast<double>(c) * width : domain.upper[0];
    for (; jump != jumps.end() && *jump < next; ++jump) {
      if (*jump > edge.back()) add_up_to(*jump);
    }
    add_up_to(next);
  }
  double const share = mass.back() / resolution;
  Layout<1> layout;
  layout.spacing = domain.extent()[0] / resolution;
  layout.cell = Vector<1>(layout.spacing);
  layout.positions = VectorField<1>(static_cast<std::size_t>(resolution));
  std::size_t c = 0;
  auto const place_of = [&](double wanted) {  // to be called with rising masses
    while (c + 2 < mass.size() && mass[c + 1] < wanted) ++c;
    double const part = (wanted - mass[c]) / (mass[c + 1] - mass[c]);
    return edge[c] + part * (edge[c + 1] - edge[c]);
  };
  layout.edges = {lower};
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    double const x = place_of((static_cast<double>(i) + 0.5) * share);
    layout.positions.set(i, Vector<1>(x));
    layout.volumes.push_back(share / density(x));
    layout.edges.push_back(place_of(static_cast<double>(i + 1) * share));
  }
  layout.edges.back() = domain.upper[0];
  return layout;
}

template <int Dim>
void reorder(Layout<Dim>& layout, std::vector<std::uint32_t> const& order) {
  expects(order.size() == layout.volumes.size());
  auto const sort = [&order](std::vector<double>& values) {
    std::vector<double> sorted(order.size());
    for (std::size_t n = 0; n < order.size(); ++n) sorted[n] = values[order[n]];
    values = std::move(sorted);
  };
  for (int k = 0; k < Dim; ++k) sort(layout.positions.component(k));
  sort(layout.volumes);
}

template double lattice_count(Domain<1> const&, int);
template double lattice_count(Domain<2> const&, int);
template double lattice_count(Domain<3> const&, int);
template Layout<1> lattice(Domain<1> const&, int);
template Layout<2> lattice(Domain<2> const&, int);
template Layout<3> lattice(Domain<3> const&, int);
template Layout<1> jittered(Domain<1> const&, int, double, std::uint64_t);
template Layout<2> jittered(Domain<2> const&, int, double, std::uint64_t);
template Layout<3> jittered(Domain<3> const&, int, double, std::uint64_t);
template Layout<1> at_random(Domain<1> const&, int, std::uint64_t);
template Layout<2> at_random(Domain<2> const&, int, std::uint64_t);
template Layout<3> at_random(Domain<3> const&, int, std::uint64_t);
template void reorder(Layout<1>&, std::vector<std::uint32_t> const&);
template void reorder(Layout<2>&, std::vector<std::uint32_t> const&);
template void reorder(Layout<3>&, std::vector<std::uint32_t> const&);

}  // namespace sphverify
