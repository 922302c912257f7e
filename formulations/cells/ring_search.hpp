// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "formulations/neighbours/cell_grid.hpp"

namespace sphverify {

/// Places along the box's own axes, in the order of a grid's cells.
template <int Dim>
struct PlacesByCell {
  CellGrid<Dim> const& grid;
  std::array<std::vector<double>, Dim> x;

  explicit PlacesByCell(CellGrid<Dim> const& of) : grid(of) {
    std::vector<std::uint32_t> const& order = grid.particles();
    for (auto& along : x) along.resize(order.size());
    for (std::size_t s = 0; s < order.size(); ++s) {
      Vector<Dim> const place = grid.domain().to_box(grid.positions()[order[s]]);
      for (int k = 0; k < Dim; ++k) x[static_cast<std::size_t>(k)][s] = place[k];
    }
  }
};

/// Looks for particles around a place from near to far, images included, until the caller has seen enough: ring after
/// ring of a grid's cells. All along the box's own axes.
template <int Dim>
class RingSearch {
 public:
  explicit RingSearch(PlacesByCell<Dim> const& places) : grid_(places.grid), x_(places.x) {}

  /// Calls visit(j, separation, squared distance) with separation = x_j - x for the particles and images of one ring that
  /// are nearer than a limit; of x itself too. Cells that are farther are passed over.
  /// @return how far from x all has been seen after this ring and those within it; infinite where nothing is beyond
  template <class Visit>
  double ring(Vector<Dim> const& x, int r, double limit, Visit const& visit) {
    double seen = std::numeric_limits<double>::infinity();
    for (int k = 0; k < Dim; ++k) seen = std::min(seen, lay_out(x[k], k, r));
    std::array<std::size_t, Dim> at{};
    walk(0, false, 0.0, at, r, limit * limit, x, visit);
    return seen;
  }

 private:
  /// One step along an axis: the cell there, how far its particles are moved, how far it is from x.
  struct Step {
    long cell;
    double shift, squared_distance;
    bool outermost;
  };

  double lay_out(double x, int k, int r) {
    auto const axis = static_cast<std::size_t>(k);
    long const count = grid_.cells_along(k);
    double const size = grid_.cell_size(k);
    double const origin = grid_.origin(k);
    bool const is_periodic = grid_.domain().periodic[axis];
    long const home = std::clamp(static_cast<long>(std::floor((x - origin) / size)), 0L, count - 1);
    double seen = std::numeric_limits<double>::infinity();
    std::vector<Step>& steps = steps_[axis];
    steps.clear();
    for (long step = -r; step <= r; ++step) {
      long cell = home + step;
      long const turns = cell >= 0 ? cell / count : -((count - 1 - cell) / count);
      if (turns != 0 && !is_periodic) continue;
      double const lower = origin + static_cast<double>(cell) * size;
      double const away = step < 0 ? x - (lower + size) : step > 0 ? lower - x : 0.0;
      steps.push_back({cell - turns * count, static_cast<double>(turns * count) * size, away > 0.0 ? away * away : 0.0,
                       step == -r || step == r});
    }
    if (is_periodic || home - r > 0) seen = std::min(seen, x - (origin + static_cast<double>(home - r) * size));
    if (is_periodic || home + r + 1 < count) seen = std::min(seen, origin + static_cast<double>(home + r + 1) * size - x);
    return seen;
  }

  template <class Visit>
  void walk(int k, bool on_ring, double squared_distance, std::array<std::size_t, Dim>& at, int r, double squared_limit,
            Vector<Dim> const& x, Visit const& visit) {
    if (squared_distance > squared_limit) return;
    if (k == Dim) {
      if (on_ring) look_at_cell(at, squared_limit, x, visit);
      return;
    }
    auto const axis = static_cast<std::size_t>(k);
    std::vector<Step> const& steps = steps_[axis];
    bool const last = k == Dim - 1;
    for (std::size_t n = 0; n < steps.size(); ++n) {
      if (last && !on_ring && !steps[n].outermost) continue;
      at[axis] = n;
      walk(k + 1, on_ring || steps[n].outermost, squared_distance + steps[n].squared_distance, at, r, squared_limit, x, visit);
    }
  }

  template <class Visit>
  void look_at_cell(std::array<std::size_t, Dim> const& at, double squared_limit, Vector<Dim> const& x, Visit const& visit) {
    std::size_t cell = 0;
    Vector<Dim> from = x;
    for (int k = 0; k < Dim; ++k) {
      auto const axis = static_cast<std::size_t>(k);
      Step const& step = steps_[axis][at[axis]];
      cell = cell * static_cast<std::size_t>(grid_.cells_along(k)) + static_cast<std::size_t>(step.cell);
      from[k] -= step.shift;
    }
    for (std::uint32_t s = grid_.first_in_cell(cell); s < grid_.first_in_cell(cell + 1); ++s) {
      Vector<Dim> separation;
      for (int k = 0; k < Dim; ++k) separation[k] = x_[static_cast<std::size_t>(k)][s] - from[k];
      double const squared = separation.squaredNorm();
      if (squared < squared_limit) visit(grid_.particles()[s], separation, squared);
    }
  }

  CellGrid<Dim> const& grid_;
  std::array<std::vector<double>, Dim> const& x_;
  std::array<std::vector<Step>, Dim> steps_;
};

}  // namespace sphverify
