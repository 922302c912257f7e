#include "formulations/neighbours/cell_grid.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "formulations/basics/readable.hpp"

namespace sphverify {

template <int Dim>
CellGrid<Dim>::CellGrid(VectorField<Dim> const& positions, Domain<Dim> const& domain, double reach)
    : positions_(&positions), domain_(domain), turned_(domain.is_turned()), reach_(reach) {
  std::size_t const n = positions.size();
  if (n >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("too many particles for 32-bit neighbour indices: found " +
                                std::to_string(n));
  }
  for (int k = 0; k < Dim; ++k) {
    auto const& x = positions.component(k);
    for (double const value : x) {
      if (!std::isfinite(value)) throw std::invalid_argument("a particle's position is not finite");
    }
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
      lowest = highest = along(0);
      for (std::size_t i = 1; i < n; ++i) {
        lowest = std::min(lowest, along(i));
        highest = std::max(highest, along(i));
      }
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

  // Counting sort by cell.
  std::vector<std::uint32_t> cell(n);
  first_.assign(static_cast<std::size_t>(total()) + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    cell[i] = static_cast<std::uint32_t>(index_of(cell_of(positions[i])));
    ++first_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  particles_.resize(n);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) particles_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace sphverify
