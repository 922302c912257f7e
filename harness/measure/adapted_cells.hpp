// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace sphverify {

/// A part of an interval, with its part of an integral.
struct Cell {
  double centre, width;
  double log_mass;  ///< log(width * value at the centre)
};

/// Cells that fill an interval and follow a positive function, given by its logarithm: those that hold most
/// are halved until none holds more than a part of 0.015, or there are `most` of them. Peaks that
/// are many orders of magnitude narrower than the interval are found as long as the function rises towards
/// them.
template <class LogFunction>
std::vector<Cell> adapted_cells(double lower, double upper, LogFunction const& log_function,
                                std::size_t first = 32, std::size_t most = 200) {
  constexpr double enough = 0.015;
  auto const is_less = [](Cell const& a, Cell const& b) { return a.log_mass < b.log_mass; };
  std::vector<Cell> cells;  // a heap
  auto const add = [&](double centre, double width) {
    cells.push_back({centre, width, std::log(width) + log_function(centre)});
    std::push_heap(cells.begin(), cells.end(), is_less);
  };
  double const width = (upper - lower) / static_cast<double>(first);
  for (std::size_t k = 0; k < first; ++k) add(lower + (static_cast<double>(k) + 0.5) * width, width);
  // Where the function is 0 everywhere there is nothing to follow.
  while (cells.size() < most && std::isfinite(cells.front().log_mass)) {
    double total = 0.0;
    for (Cell const& cell : cells) total += std::exp(cell.log_mass - cells.front().log_mass);
    if (enough * total >= 1.0) break;
    // The largest few at once: it is the sum above that costs.
    std::size_t const at_once = 1 + cells.size() / 16;
    std::vector<Cell> split;
    double const least = cells.front().log_mass + std::log(enough);
    while (split.size() < at_once && cells.front().log_mass > least) {
      std::pop_heap(cells.begin(), cells.end(), is_less);
      split.push_back(cells.back());
      cells.pop_back();
    }
    for (Cell const& cell : split) {
      add(cell.centre - 0.25 * cell.width, 0.5 * cell.width);
      add(cell.centre + 0.25 * cell.width, 0.5 * cell.width);
    }
  }
  return cells;
}

}  // namespace sphverify
