// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/cell_grid.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "formulations/basics/parallel.hpp"
#include "formulations/basics/readable.hpp"

namespace sphverify {

template <int Dim>
CellGrid<Dim>::CellGrid(VectorField<Dim> const& positions, Domain<Dim> const& domain, double reach, int threads)
    : positions_(&positions), domain_(domain), turned_(domain.is_turned()), reach_(reach) {
  std::size_t const n = positions.size();
  if (n >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("too many particles for 32-bit neighbour indices: found " +
                                std::to_string(n));
  }
  for (int k = 0; k < Dim; ++k) {
    auto const& x = positions.component(k);
    if (first_row(n, threads, [&](std::size_t i) { return !std::isfinite(x[i]); }))
      throw std::invalid_argument("a particle's position is not finite");
    double lowest = domain.lower[k];
    double highest = domain.upper[k];
    if (domain.periodic[k]) {
      double const period = highest - lowest;
      if (period < 2.0 * reach) {
        throw std::invalid_argument("periodic axis " + std::to_string(k) +
                                    " is shorter than two supports: found " + readable(period) +
                                    ", expected at least " + readable(2.0 * reach));
      }
    } else if (n > 0) {
      auto const along = [&](std::size_t i) { return turned_ ? domain.to_box(positions[i])[k] : x[i]; };
      struct Range {
        double lowest, highest;
      };
      auto const join = [](Range& all, Range const& part) {
        all.lowest = std::min(all.lowest, part.lowest);
        all.highest = std::max(all.highest, part.highest);
      };
      Range const range = joined_blocks(
          n, threads, Range{along(0), along(0)},
          [&](std::size_t begin, std::size_t end) {
            Range part{along(begin), along(begin)};
            for (std::size_t i = begin; i < end; ++i) join(part, {along(i), along(i)});
            return part;
          },
          join);
      lowest = range.lowest;
      highest = range.highest;
    }
    origin_[k] = lowest;
    double const extent = std::max(highest - lowest, reach);
    // No more cells than particles along an axis: empty cells cost memory and find nothing.
    double const cells =
        std::min(std::floor(extent / reach), static_cast<double>(std::max<std::size_t>(n, 1)));
    cell_count_[k] = std::max(1L, static_cast<long>(cells));
    cell_size_[k] = extent / static_cast<double>(cell_count_[k]);
  }
  // Nor many more cells than particles in all, however sparse the cloud.
  auto const total = [this] {
    double product = 1.0;
    for (long const c : cell_count_) product *= static_cast<double>(c);
    return product;
  };
  while (total() > 4.0 * static_cast<double>(n) + 64.0) {
    for (int k = 0; k < Dim; ++k) {
      double const extent = cell_size_[k] * static_cast<double>(cell_count_[k]);
      cell_count_[k] = std::max(1L, cell_count_[k] / 2);
      cell_size_[k] = extent / static_cast<double>(cell_count_[k]);
    }
  }

  first_.assign(static_cast<std::size_t>(total()) + 1, 0);
  sort(threads);
}

/// Counting sort by cell. Particles of a cell follow each other by their numbers, however many parts they are counted in.
template <int Dim>
void CellGrid<Dim>::sort(int threads) {
  std::size_t const n = positions_->size();
  std::size_t const cells = first_.size() - 1;
  std::size_t const parts = n < 2048 ? 1 : static_cast<std::size_t>(std::max(threads, 1));
  std::vector<std::uint32_t> cell(n);
  // Per part how many it has in each cell; then where it puts the first of them.
  std::vector<std::vector<std::uint32_t>> next(parts);
  auto const for_each_part = [&](auto const& visit) {
    for_each_block(
        parts, threads,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t part = begin; part < end; ++part) visit(part, part * n / parts, (part + 1) * n / parts);
        },
        1);
  };
  for_each_part([&](std::size_t part, std::size_t begin, std::size_t end) {
    next[part].assign(cells, 0);
    for (std::size_t i = begin; i < end; ++i) {
      cell[i] = static_cast<std::uint32_t>(index_of(cell_of((*positions_)[i])));
      ++next[part][cell[i]];
    }
  });
  std::uint32_t before = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    first_[c] = before;
    for (auto& counted : next) {
      std::uint32_t const count = counted[c];
      counted[c] = before;
      before += count;
    }
  }
  first_[cells] = before;
  particles_.resize(n);
  for_each_part([&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) particles_[next[part][cell[i]]++] = static_cast<std::uint32_t>(i);
  });
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace sphverify
