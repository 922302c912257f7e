#include "formulations/support/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "formulations/support/cubic_spline.hpp"
#include "formulations/support/sweep.hpp"
#include "formulations/support/sweep/dispatch.hpp"

namespace sphverify {

namespace {

/// What a search reads of every particle, in the order of the grid's cells, so that cells side by side are
/// read at a stretch.
template <int Dim>
struct SortedParticles {
  std::array<std::vector<double>, Dim> x;  ///< along the box's axes
  std::vector<double> half_reach;          ///< where pairs have a reach of their own; else empty

  SortedParticles(CellGrid<Dim> const& grid, std::vector<double> const& half_reach_of, int threads) {
    std::size_t const n = grid.particles().size();
    bool const turned = grid.domain().is_turned();
    for (auto& along : x) along.resize(n);
    half_reach.resize(half_reach_of.empty() ? 0 : n);
    for_each_row(n, threads, [&](std::size_t s) {
      std::uint32_t const i = grid.particles()[s];
      Vector<Dim> const place = turned ? grid.domain().to_box(grid.positions()[i]) : grid.positions()[i];
      for (int k = 0; k < Dim; ++k) x[static_cast<std::size_t>(k)][s] = place[k];
      if (!half_reach.empty()) half_reach[s] = half_reach_of[i];
    });
  }
};

/// The particles of the cells around one, side by side and moved to the image that is near it.
template <int Dim>
class CandidateBuffer {
 public:
  CandidateBuffer(CellGrid<Dim> const& grid, SortedParticles<Dim> const& sorted)
      : grid_(grid), sorted_(sorted) {}

  /// @param begin where the cell's own particles begin
  void fill(std::uint32_t begin, std::vector<typename CellGrid<Dim>::Run> const& runs) {
    std::size_t total = 0;
    for (auto const& run : runs) total += run.end - run.begin;
    reserve((total + 3) / 4 * 4);
    count_ = 0;
    for (auto const& run : runs) {
      if (run.begin <= begin && begin < run.end && run.shift.isZero(0.0)) own_ = count_ + (begin - run.begin);
      std::size_t const length = run.end - run.begin;
      for (int k = 0; k < Dim; ++k) {
        double const* const from = sorted_.x[static_cast<std::size_t>(k)].data() + run.begin;
        double* const to = component(k) + count_;
        double const shift = run.shift[k];
        for (std::size_t n = 0; n < length; ++n) to[n] = from[n] + shift;
      }
      if (!sorted_.half_reach.empty()) {
        std::copy_n(sorted_.half_reach.data() + run.begin, length, half_reach() + count_);
      }
      std::copy_n(grid_.particles().data() + run.begin, length, particle_.data() + count_);
      count_ += length;
    }
    for (; count_ % 4 != 0; ++count_) component(0)[count_] = far_away;
  }

  std::size_t count() const { return count_; }

  /// Lists the candidates near the cell's particle `n`, itself left out.
  /// @param out has room for count() + 4
  /// @param same_place receives whether one of them is at its very place
  /// @return how many are near
  std::size_t list_near(std::size_t n, double common_reach, ListKernels const& kernels, std::uint32_t* out,
                        bool* same_place) {
    std::size_t const self = own_ + n;
    std::array<double, Dim> x;
    for (int k = 0; k < Dim; ++k) x[static_cast<std::size_t>(k)] = component(k)[self];
    component(0)[self] = far_away;
    bool const own_reach = !sorted_.half_reach.empty();
    Candidates all{.x = {},
                   .half_reach = own_reach ? half_reach() : nullptr,
                   .particle = particle_.data(),
                   .count = count_};
    for (int k = 0; k < Dim; ++k) all.x[static_cast<std::size_t>(k)] = component(k);
    std::size_t const near =
        kernels.list_near(all, x.data(), own_reach ? half_reach()[self] : common_reach, out, same_place);
    component(0)[self] = x[0];
    return near;
  }

 private:
  static constexpr double far_away = 1e150;  // its square is still a number

  double* component(int k) { return start() + static_cast<std::size_t>(k) * capacity_; }
  double* half_reach() { return component(Dim); }
  /// Aligned to 32 bytes within the buffer.
  double* start() {
    auto const address = reinterpret_cast<std::uintptr_t>(values_.data());
    return values_.data() + (32 - address % 32) % 32 / sizeof(double);
  }
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    capacity_ = 2 * count;
    values_.assign((Dim + 1) * capacity_ + 4, 0.0);
    particle_.resize(capacity_);
  }

  CellGrid<Dim> const& grid_;
  SortedParticles<Dim> const& sorted_;
  std::vector<double> values_;
  std::vector<std::uint32_t> particle_;
  std::size_t capacity_ = 0, count_ = 0, own_ = 0;
};

/// Finds the neighbours of the particles of some cells, with memory that is used again for others.
template <int Dim>
class Search {
 public:
  Search(CellGrid<Dim> const& grid, SortedParticles<Dim> const& sorted)
      : grid_(grid), kernels_(list_kernels<Dim>()), candidates_(grid, sorted) {}

  /// @param length receives how many neighbours each particle has, in the order of the cells
  /// @return the neighbours themselves, one particle's after the other's
  std::vector<std::uint32_t> operator()(std::size_t first_cell, std::size_t end_cell,
                                        std::vector<std::uint32_t>& length) {
    std::size_t used = 0;
    grid_.for_each_cell(first_cell, end_cell, [&](std::uint32_t begin, std::uint32_t end, auto const& runs) {
      candidates_.fill(begin, runs);
      for (std::uint32_t s = begin; s < end; ++s) {
        // Room for one particle's row at a time: a crowded cell's worth of candidates would be its square.
        std::size_t const most = used + candidates_.count() + 4;
        if (rows_.size() < most) rows_.resize(2 * most);
        bool same_place = false;
        std::size_t const near =
            candidates_.list_near(s - begin, grid_.reach(), kernels_, rows_.data() + used, &same_place);
        if (same_place) complain_of_same_place(grid_.particles()[s]);
        length[s] = static_cast<std::uint32_t>(near);
        used += near;
      }
    });
    return {rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(used)};
  }

 private:
  [[noreturn]] void complain_of_same_place(std::uint32_t i) const {
    std::uint32_t other = i;
    grid_.for_each_within_reach(grid_.positions()[i],
                                [&](std::uint32_t j, Vector<Dim> const&, double distance) {
                                  if (j != i && distance == 0.0) other = j;
                                });
    throw std::invalid_argument("particles " + std::to_string(std::min(i, other)) + " and " +
                                std::to_string(std::max(i, other)) + " are at the same place");
  }

  CellGrid<Dim> const& grid_;
  ListKernels const& kernels_;
  CandidateBuffer<Dim> candidates_;
  std::vector<std::uint32_t> rows_;
};

/// Looks once: each part of the grid lists its particles' neighbours for itself, and what it found is copied
/// to its rows when the lengths of all are known. That costs less than to count first and then to list.
template <int Dim>
class ListBuilder {
 public:
  /// @param half_reach per particle, where pairs have a reach of their own; else empty
  ListBuilder(CellGrid<Dim> const& grid, std::vector<double> const& half_reach, int threads)
      : grid_(grid), sorted_(grid, half_reach, threads), threads_(threads) {}

  NeighbourList build(NeighbourList list) {
    std::size_t const n = grid_.particles().size();
    std::size_t const parts = (grid_.cells() + cells_per_part - 1) / cells_per_part;
    std::vector<std::vector<std::uint32_t>> found(parts);
    std::vector<std::uint32_t> length(n);  // in the order of the cells, as what was found
    for_each_block(
        parts, threads_,
        [&](std::size_t begin, std::size_t end) {
          Search<Dim> search(grid_, sorted_);
          for (std::size_t part = begin; part < end; ++part) {
            found[part] = search(part * cells_per_part, end_of(part), length);
          }
        },
        parts_per_task);

    list.first.assign(n + 1, 0);
    for (std::size_t s = 0; s < n; ++s) list.first[grid_.particles()[s] + 1] = length[s];
    for (std::size_t i = 0; i < n; ++i) list.first[i + 1] += list.first[i];
    list.neighbour.resize(list.first[n]);
    for_each_block(
        parts, threads_,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t part = begin; part < end; ++part) {
            auto from = found[part].begin();
            for (std::uint32_t s = first_of(part); s < first_of(part + 1); ++s) {
              std::size_t const to = list.first[grid_.particles()[s]];
              std::copy_n(from, length[s], list.neighbour.begin() + static_cast<std::ptrdiff_t>(to));
              from += length[s];
            }
            found[part] = {};
          }
        },
        parts_per_task);
    return list;
  }

 private:
  static constexpr std::size_t cells_per_part = 64;
  static constexpr std::size_t parts_per_task = 8;

  std::size_t end_of(std::size_t part) const { return std::min((part + 1) * cells_per_part, grid_.cells()); }
  /// Where a part's particles begin in the order of the cells.
  std::uint32_t first_of(std::size_t part) const {
    return grid_.first_in_cell(std::min(part * cells_per_part, grid_.cells()));
  }

  CellGrid<Dim> const& grid_;
  SortedParticles<Dim> sorted_;
  int threads_;
};

}  // namespace

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, int threads, NeighbourList old) {
  std::vector<double> const common;
  return ListBuilder<Dim>(grid, common, threads).build(std::move(old));
}

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, SmoothingLength const& h, double skin, int threads,
                              NeighbourList old) {
  if (h.is_uniform()) return find_neighbours(grid, threads, std::move(old));
  std::vector<double> half_reach(grid.positions().size());
  for (std::size_t i = 0; i < half_reach.size(); ++i) {
    half_reach[i] = 0.5 * CubicSpline<Dim>::support_ratio * (1.0 + skin) * h(i);
  }
  return ListBuilder<Dim>(grid, half_reach, threads).build(std::move(old));
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                  \
  template NeighbourList find_neighbours(CellGrid<Dim> const&, int, NeighbourList);                 \
  template NeighbourList find_neighbours(CellGrid<Dim> const&, SmoothingLength const&, double, int, \
                                         NeighbourList);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
