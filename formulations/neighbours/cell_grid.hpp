// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "formulations/particles/domain.hpp"
#include "formulations/particles/particles.hpp"

namespace sphverify {

/// Particles sorted into cells no smaller than a reach, so that all within that reach of a point are found in
/// the 3^Dim cells around it. Built in O(N); keeps a reference to the positions, which must outlive it. Where
/// these have moved on since by up to d, it still finds all within reach - d.
template <int Dim>
class CellGrid {
 public:
  /// Particles of cells that lie side by side, moved by the same periodic shift: places begin to end in
  /// `particles()`. A candidate is to be compared at its place plus `shift`, along the box's axes.
  struct Run {
    std::uint32_t begin, end;
    Vector<Dim> shift;
  };

  /// @param reach largest distance that will be asked for [m]
  /// Throws std::invalid_argument when a periodic axis is shorter than two reaches (a particle would meet two
  /// images of the same neighbour) or a coordinate is not finite.
  CellGrid(VectorField<Dim> const& positions, Domain<Dim> const& domain, double reach, int threads = 1);

  /// Calls visit(j, separation = x - x_j, distance) for every particle closer than the reach.
  template <class Visit>
  void for_each_within_reach(Vector<Dim> const& x, Visit&& visit) const;

  /// Calls visit(begin, end, runs) for every cell: its own particles, and those of the cells around it,
  /// itself included. Every image of a particle within reach is in one run.
  template <class Visit>
  void for_each_cell(std::size_t first_cell, std::size_t last_cell, Visit&& visit) const;
  std::size_t cells() const { return first_.size() - 1; }
  /// Where a cell's particles begin in `particles()`; one more than the last cell gives their end.
  std::uint32_t first_in_cell(std::size_t cell) const { return first_[cell]; }
  /// Along the box's axis k: how many cells, how long each, and where the first begins.
  long cells_along(int k) const { return cell_count_[static_cast<std::size_t>(k)]; }
  double cell_size(int k) const { return cell_size_[k]; }
  double origin(int k) const { return origin_[k]; }
  /// Particles sorted by cell.
  std::vector<std::uint32_t> const& particles() const { return particles_; }

  VectorField<Dim> const& positions() const { return *positions_; }
  Domain<Dim> const& domain() const { return domain_; }
  double reach() const { return reach_; }

 private:
  using Cell = std::array<long, Dim>;

  Cell cell_of(Vector<Dim> const& x) const;
  std::size_t index_of(Cell const& cell) const;
  void sort(int threads);
  void add_runs(Cell const& home, int axis, Cell at, Vector<Dim> const& shift, std::vector<Run>& runs) const;

  VectorField<Dim> const* positions_;
  Domain<Dim> domain_;
  bool turned_;
  double reach_;
  Vector<Dim> origin_;
  Vector<Dim> cell_size_;
  Cell cell_count_;
  std::vector<std::uint32_t> first_;      ///< per cell, where its particles start in `particles_`
  std::vector<std::uint32_t> particles_;  ///< particle indices sorted by cell
};

template <int Dim>
typename CellGrid<Dim>::Cell CellGrid<Dim>::cell_of(Vector<Dim> const& x) const {
  Vector<Dim> const at = turned_ ? domain_.to_box(x) : x;
  Cell cell;
  for (int k = 0; k < Dim; ++k) {
    long const c = static_cast<long>(std::floor((at[k] - origin_[k]) / cell_size_[k]));
    cell[k] = c < 0 ? 0 : (c >= cell_count_[k] ? cell_count_[k] - 1 : c);
  }
  return cell;
}

template <int Dim>
std::size_t CellGrid<Dim>::index_of(Cell const& cell) const {
  std::size_t index = 0;
  for (int k = 0; k < Dim; ++k) index = index * static_cast<std::size_t>(cell_count_[k]) + cell[k];
  return index;
}

template <int Dim>
template <class Visit>
void CellGrid<Dim>::for_each_within_reach(Vector<Dim> const& x, Visit&& visit) const {
  Cell const home = cell_of(x);

  // The distinct cells around home along each axis, wrapped where the axis is periodic.
  std::array<std::array<long, 3>, Dim> around{};
  std::array<int, Dim> count{};
  for (int k = 0; k < Dim; ++k) {
    count[k] = 0;
    for (long step = -1; step <= 1; ++step) {
      long c = home[k] + step;
      if (domain_.periodic[k]) {
        if (step != 0 && cell_count_[k] < (step < 0 ? 3 : 2)) continue;
        c = (c + cell_count_[k]) % cell_count_[k];
      } else if (c < 0 || c >= cell_count_[k]) {
        continue;
      }
      around[k][count[k]++] = c;
    }
  }

  std::array<int, Dim> at{};
  while (true) {
    Cell cell;
    for (int k = 0; k < Dim; ++k) cell[k] = around[k][at[k]];
    std::size_t const c = index_of(cell);
    for (std::uint32_t n = first_[c]; n < first_[c + 1]; ++n) {
      std::uint32_t const j = particles_[n];
      Vector<Dim> const separation = domain_.nearest_image(x - (*positions_)[j]);
      double const squared = separation.squaredNorm();
      if (squared < reach_ * reach_) visit(j, separation, std::sqrt(squared));
    }
    int k = Dim - 1;
    while (k >= 0 && ++at[k] == count[k]) at[k--] = 0;
    if (k < 0) break;
  }
}

template <int Dim>
template <class Visit>
void CellGrid<Dim>::for_each_cell(std::size_t first_cell, std::size_t last_cell, Visit&& visit) const {
  std::vector<Run> runs;
  for (std::size_t home = first_cell; home < last_cell; ++home) {
    if (first_[home] == first_[home + 1]) continue;
    Cell cell;
    std::size_t rest = home;
    for (int k = Dim - 1; k >= 0; --k) {
      cell[k] = static_cast<long>(rest % static_cast<std::size_t>(cell_count_[k]));
      rest /= static_cast<std::size_t>(cell_count_[k]);
    }
    runs.clear();
    add_runs(cell, 0, Cell{}, Vector<Dim>::Zero(), runs);
    visit(first_[home], first_[home + 1], runs);
  }
}

/// Steps through the cells around one, axis by axis.
template <int Dim>
void CellGrid<Dim>::add_runs(Cell const& home, int axis, Cell at, Vector<Dim> const& shift,
                             std::vector<Run>& runs) const {
  if (axis == Dim) {
    std::size_t const c = index_of(at);
    if (first_[c] == first_[c + 1]) return;
    bool const continues = !runs.empty() && runs.back().end == first_[c] && runs.back().shift == shift;
    if (continues) {
      runs.back().end = first_[c + 1];
    } else {
      runs.push_back({first_[c], first_[c + 1], shift});
    }
    return;
  }
  double const period = domain_.upper[axis] - domain_.lower[axis];
  for (long step = -1; step <= 1; ++step) {
    Vector<Dim> moved = shift;
    at[axis] = home[axis] + step;
    if (at[axis] < 0 || at[axis] >= cell_count_[axis]) {
      if (!domain_.periodic[axis]) continue;
      moved[axis] = at[axis] < 0 ? -period : period;
      at[axis] += at[axis] < 0 ? cell_count_[axis] : -cell_count_[axis];
    }
    add_runs(home, axis + 1, at, moved, runs);
  }
}

extern template class CellGrid<1>;
extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace sphverify
