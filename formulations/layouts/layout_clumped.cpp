// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/expects.hpp"
#include "formulations/layouts/layout_common.hpp"

namespace sphverify {

namespace {

/// Rows along the first axis: `lattice` counts the last axis fastest, so that particle i is in row i % rows.
template <int Dim>
std::size_t rows_of(Layout<Dim> const& layout, int resolution) {
  return layout.volumes.size() / static_cast<std::size_t>(resolution);
}

}  // namespace

template <int Dim>
Layout<Dim> clumped(Domain<Dim> const& domain, int resolution, double separation) {
  expects(separation > 0.0 && separation <= 1.0);
  Layout<Dim> layout = lattice(domain, resolution);
  std::size_t const rows = rows_of(layout, resolution);
  std::size_t const paired = 2 * rows * static_cast<std::size_t>(resolution / 2);
  Vector<Dim> approach = Vector<Dim>::Zero();
  approach[0] = 0.5 * (1.0 - separation) * layout.cell[0];
  approach = domain.to_space(approach);
  for (std::size_t i = 0; i < paired; ++i) {
    bool const first = i / rows % 2 == 0;
    layout.positions.add(i, first ? approach : Vector<Dim>(-approach));
  }
  if constexpr (Dim == 1) set_voronoi_volumes(layout, domain);
  return layout;
}

template <int Dim>
Layout<Dim> touching(Domain<Dim> const& domain, int resolution, double gap) {
  expects(gap > 0.0 && gap <= 0.5);
  Layout<Dim> layout = lattice(domain, resolution);
  std::size_t const rows = rows_of(layout, resolution);
  for (std::size_t i = 0; i < rows; ++i) {
    // From the wall, not from the cell's centre, whose rounding may be more than the gap.
    Vector<Dim> x = domain.to_box(layout.positions[i]);
    x[0] = domain.lower[0] + gap * layout.cell[0];
    layout.positions.set(i, domain.to_space(x));
  }
  if constexpr (Dim == 1) set_voronoi_volumes(layout, domain);
  return layout;
}

template Layout<1> clumped(Domain<1> const&, int, double);
template Layout<2> clumped(Domain<2> const&, int, double);
template Layout<3> clumped(Domain<3> const&, int, double);
template Layout<1> touching(Domain<1> const&, int, double);
template Layout<2> touching(Domain<2> const&, int, double);
template Layout<3> touching(Domain<3> const&, int, double);

}  // namespace sphverify
