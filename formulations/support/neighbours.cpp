#include "formulations/support/neighbours.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "formulations/support/cubic_spline.hpp"

namespace sphverify {

namespace {

/// @param is_near whether a pair of the grid belongs into the list
template <int Dim, class IsNear>
NeighbourList collect(CellGrid<Dim> const& grid, IsNear const& is_near) {
  std::size_t const n = grid.positions().size();
  NeighbourList list;
  list.first.reserve(n + 1);
  list.first.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    grid.for_each_within_reach(grid.positions()[i], [&](std::uint32_t j, Vector<Dim> const&,
                                                        double distance) {
      if (j == i || !is_near(i, j, distance)) return;
      if (distance == 0.0) {
        throw std::invalid_argument("particles " + std::to_string(std::min<std::size_t>(i, j)) + " and " +
                                    std::to_string(std::max<std::size_t>(i, j)) + " are at the same place");
      }
      list.neighbour.push_back(j);
    });
    std::sort(list.neighbour.begin() + static_cast<std::ptrdiff_t>(list.first.back()), list.neighbour.end());
    list.first.push_back(list.neighbour.size());
  }
  list.neighbour.shrink_to_fit();
  return list;
}

}  // namespace

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid) {
  return collect(grid, [](std::size_t, std::uint32_t, double) { return true; });
}

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, SmoothingLength const& h) {
  if (h.is_uniform()) return find_neighbours(grid);
  return collect(grid, [&](std::size_t i, std::uint32_t j, double distance) {
    return distance < CubicSpline<Dim>::support_ratio * h(i, j);
  });
}

template NeighbourList find_neighbours(CellGrid<1> const&);
template NeighbourList find_neighbours(CellGrid<1> const&, SmoothingLength const&);
template NeighbourList find_neighbours(CellGrid<2> const&);
template NeighbourList find_neighbours(CellGrid<2> const&, SmoothingLength const&);
template NeighbourList find_neighbours(CellGrid<3> const&);
template NeighbourList find_neighbours(CellGrid<3> const&, SmoothingLength const&);

}  // namespace sphverify
