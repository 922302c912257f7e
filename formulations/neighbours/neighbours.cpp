// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "formulations/basics/parallel.hpp"
#include "formulations/neighbours/candidates.hpp"
#include "formulations/neighbours/list_dispatch.hpp"

namespace sphverify {

namespace {

/// Particles side by side in the cells lie anywhere in memory: by how many the fetching of what is kept for
/// each goes ahead of its use.
constexpr std::size_t particles_ahead = 24;

/// A copy of what a search reads of every particle, in the order of the grid's cells, so that cells side by
/// side are read at a stretch.
template <int Dim>
class SortedParticles {
 public:
  SortedParticles(CellGrid<Dim> const& grid, std::vector<double> const& half_reach_of, PairSupport support, int threads)
      : number_(grid.particles()) {
    std::size_t const n = grid.particles().size();
    bool const turned = grid.domain().is_turned();
    number_.resize(n + candidates_at_a_time);
    for (auto& along : x_) along.resize(n + candidates_at_a_time);
    half_reach_.resize(half_reach_of.empty() ? 0 : n + candidates_at_a_time);
    for_each_row(n, threads, [&](std::size_t s) {
      std::uint32_t const i = number_[s];
      if (s + particles_ahead < n) {
        std::uint32_t const later = number_[s + particles_ahead];
        for (int k = 0; k < Dim; ++k) __builtin_prefetch(&grid.positions().component(k)[later]);
      }
      Vector<Dim> const place = turned ? grid.domain().to_box(grid.positions()[i]) : grid.positions()[i];
      for (int k = 0; k < Dim; ++k) x_[static_cast<std::size_t>(k)][s] = place[k];
      if (!half_reach_.empty()) half_reach_[s] = half_reach_of[i];
    });
    for (int k = 0; k < Dim; ++k) view_.x[k] = x_[static_cast<std::size_t>(k)].data();
    view_.half_reach = half_reach_.empty() ? nullptr : half_reach_.data();
    view_.number = number_.data();
    view_.support = support;
  }
  SortedParticles(SortedParticles const&) = delete;
  SortedParticles& operator=(SortedParticles const&) = delete;

  SortedPlaces const& view() const { return view_; }

 private:
  std::array<std::vector<double>, Dim> x_;
  std::vector<double> half_reach_;
  std::vector<std::uint32_t> number_;
  SortedPlaces view_{};
};

/// The particles of the cells around one that may be near to some particle of it.
template <int Dim>
class CandidateBuffer {
 public:
  using Run = typename CellGrid<Dim>::Run;

  CandidateBuffer(SortedPlaces const& sorted, double reach)
      : sorted_(sorted), kernels_(list_kernels<Dim>()), reach_(reach) {}

  /// @param begin, end the cell's own particles
  void fill(std::uint32_t begin, std::uint32_t end, std::vector<Run> const& runs) {
    enclose(begin, end);
    reserve(runs);
    runs_.clear();
    for (Run const& run : runs) {
      CandidateRun& next = runs_.emplace_back(CandidateRun{.first = all_.count, .shift = {}});
      for (int k = 0; k < Dim; ++k) next.shift[k] = run.shift[k];
      std::uint32_t from = run.begin;
      if (run.begin <= begin && begin < run.end && run.shift.isZero(0.0)) {
        add(run.begin, begin, next);
        own_ = all_.count;  // the home box holds the cell's own: none is left out
        from = begin;
      }
      add(from, run.end, next);
    }
    all_.runs = runs_.data();
    all_.run_count = runs_.size();
    for (std::size_t n = all_.count; n < whole(all_.count); ++n) {
      all_.x[0][n] = std::numeric_limits<float>::infinity();
      all_.number[n] = 0;
    }
  }

  std::size_t count() const { return all_.count; }
  std::uint32_t const* numbers() const { return all_.number; }

  /// The candidates near the cell's particle `n`.
  /// @param near receives them as a set, in set_words(count()) words
  /// @param same_place becomes true if one of them is at its very place
  /// @return how many they are
  std::size_t find_near(std::size_t n, std::uint32_t* near, bool& same_place) {
    return kernels_.find_near(sorted_, home_, all_, own_ + n, reach_, reinterpret_cast<std::uint8_t*>(near),
                              same_place);
  }

  /// A number of candidates filled up to whole bytes of a set.
  static std::size_t whole(std::size_t count) {
    return (count + candidates_at_a_time - 1) / candidates_at_a_time * candidates_at_a_time;
  }

 private:
  /// Measures the home box, and how far wrong squared distances can be that are found from it.
  ///
  /// In units of the reach, u = 2^-24 and b the largest half extent: a coordinate t is rounded by no more
  /// than 1.001 u |t|. Of a pair at the distance s, components differ by d_k, |t| <= b for the one and b +
  /// |d_k| for the other; with its own rounding the difference is wrong by 2.01 u (b + |d_k|), the sum of
  /// squares by less than 7 u b s + 8 u s^2 + 13 u^2 (b + s)^2, and, where pairs have a reach of their own,
  /// its square by 7 u. Where s is at most the reach, s <= 1, that is less than 16 u (1 + b)^2; where it is
  /// more, the excess grows faster with s than the error. Double precision's own rounding is far below.
  /// Numbers too large for single precision make the margin infinite or distances no numbers, and all is
  /// looked at again.
  void enclose(std::uint32_t begin, std::uint32_t end) {
    home_.per_reach = 1.0 / reach_;
    float farthest = 0.0f;
    for (int k = 0; k < Dim; ++k) {
      auto const [low, high] = std::minmax_element(sorted_.x[k] + begin, sorted_.x[k] + end);
      home_.centre[k] = 0.5 * (*low + *high);
      // From the centre as it is rounded, which far from the origin is not in the middle.
      double const half = std::max(*high - home_.centre[k], home_.centre[k] - *low);
      home_.half_extent[k] = static_cast<float>(half * home_.per_reach);
      farthest = std::max(farthest, home_.half_extent[k]);
    }
    home_.largest_half_reach = 0.5f;
    if (sorted_.half_reach) {
      double const largest = *std::max_element(sorted_.half_reach + begin, sorted_.half_reach + end);
      home_.largest_half_reach = static_cast<float>(largest * home_.per_reach);
    }
    home_.margin = 0x1p-20f * (1.0f + farthest) * (1.0f + farthest);
  }

  void add(std::uint32_t begin, std::uint32_t end, CandidateRun const& run) {
    kernels_.add(sorted_, home_, begin, end, run.shift, all_);
  }

  /// Room for all, and for what is written beyond the last.
  void reserve(std::vector<Run> const& runs) {
    std::size_t most = candidates_at_a_time;
    for (Run const& run : runs) most += run.end - run.begin;
    all_.count = 0;
    if (most <= capacity_) return;
    capacity_ = whole(2 * most);
    places_.resize((Dim + 1) * capacity_ + 8);
    numbers_.resize(2 * capacity_);
    // Aligned to what is read at a time.
    auto const address = reinterpret_cast<std::uintptr_t>(places_.data());
    float* const start = places_.data() + (32 - address % 32) % 32 / sizeof(float);
    for (std::size_t k = 0; k < Dim; ++k) all_.x[k] = start + k * capacity_;
    all_.half_reach = start + Dim * capacity_;
    all_.number = numbers_.data();
    all_.place = numbers_.data() + capacity_;
  }

  SortedPlaces const& sorted_;
  ListKernels const& kernels_;
  double reach_;
  HomeBox home_{};
  Candidates all_{};
  std::vector<CandidateRun> runs_;
  std::vector<float> places_;
  std::vector<std::uint32_t> numbers_;
  std::size_t capacity_ = 0, own_ = 0;
};

/// Words of 32 bits that a set of candidates takes: whole 64 bits.
std::size_t set_words(std::size_t candidates) { return (candidates + 63) / 64 * 2; }

/// Finds the neighbours of the particles of some cells, with memory that is used again for others.
///
/// What was found is kept until the lengths of all rows are known: per cell with particles how many
/// candidates it had, and their numbers, filled up to whole bytes of a set; then per particle its neighbours
/// as a set of the candidates. Where that takes more words than they are (a cell may be crowded and its
/// particles have few neighbours), their numbers instead.
template <int Dim>
class Search {
 public:
  Search(CellGrid<Dim> const& grid, SortedPlaces const& sorted)
      : grid_(grid), kernels_(list_kernels<Dim>()), candidates_(sorted, grid.reach()) {}

  /// @param length receives how many neighbours each particle has, in the order of the cells
  std::vector<std::uint32_t> find(std::size_t first_cell, std::size_t end_cell,
                                  std::vector<std::uint32_t>& length) {
    used_ = 0;
    grid_.for_each_cell(first_cell, end_cell, [&](std::uint32_t begin, std::uint32_t end, auto const& runs) {
      candidates_.fill(begin, end, runs);
      std::size_t const count = candidates_.count();
      std::size_t const numbers = CandidateBuffer<Dim>::whole(count);
      *room(1) = static_cast<std::uint32_t>(count);
      ++used_;
      std::copy_n(candidates_.numbers(), numbers, room(numbers));
      used_ += numbers;
      for (std::uint32_t s = begin; s < end; ++s) {
        bool same_place = false;
        std::size_t const words = set_words(count);
        std::uint32_t* const set = room(words);
        std::size_t const near = candidates_.find_near(s - begin, set, same_place);
        if (same_place) complain_of_same_place(grid_.particles()[s]);
        length[s] = static_cast<std::uint32_t>(near);
        if (near < words) {
          set_.assign(set, set + words);
          list(candidates_.numbers(), set_.data(), room(near), near);
        }
        used_ += std::min(near, words);
      }
    });
    return {found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(used_)};
  }

  /// Writes what was found to the rows of the list.
  void write(std::size_t first_cell, std::size_t end_cell, std::uint32_t const* found, NeighbourList& to) {
    for (std::size_t cell = first_cell; cell < end_cell; ++cell) {
      std::uint32_t const begin = grid_.first_in_cell(cell);
      std::uint32_t const end = grid_.first_in_cell(cell + 1);
      if (begin == end) continue;
      std::size_t const count = *found++;
      std::size_t const words = set_words(count);
      std::uint32_t const* const numbers = found;
      found += CandidateBuffer<Dim>::whole(count);
      for (std::uint32_t s = begin; s < end; ++s) {
        fetch_ahead(s, to);
        std::size_t const i = grid_.particles()[s];
        std::size_t const length = to.first[i + 1] - to.first[i];
        std::uint32_t* const row = to.neighbour.data() + to.first[i];
        if (length < words) {
          std::copy_n(found, length, row);
        } else {
          list(numbers, found, row, length);
        }
        found += std::min(length, words);
      }
    }
  }

 private:
  /// Room for so many words more.
  std::uint32_t* room(std::size_t words) {
    if (found_.size() < used_ + words) found_.resize(2 * (used_ + words));
    return found_.data() + used_;
  }
  void list(std::uint32_t const* numbers, std::uint32_t const* set, std::uint32_t* out,
            std::size_t length) const {
    kernels_.list(numbers, reinterpret_cast<std::uint8_t const*>(set), out, out + length);
  }

  /// Rows of one cell may lie anywhere in a long list. Has the memory fetched of those that are written soon
  /// after the place s, and where yet later ones begin. Inlined by force: GCC drops calls of functions that
  /// do nothing but fetch.
  [[gnu::always_inline]] inline void fetch_ahead(std::size_t s, NeighbourList const& to) const {
    constexpr std::size_t rows_ahead = 6, numbers_per_line = 16;
    std::vector<std::uint32_t> const& particles = grid_.particles();
    if (s + particles_ahead < particles.size()) __builtin_prefetch(&to.first[particles[s + particles_ahead]]);
    if (s + rows_ahead >= particles.size()) return;
    std::uint32_t const* const all = to.neighbour.data();
    std::size_t const i = particles[s + rows_ahead];
    for (std::size_t n = to.first[i]; n < to.first[i + 1]; n += numbers_per_line)
      __builtin_prefetch(all + n, 1);
  }

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
  std::vector<std::uint32_t> found_, set_;
  std::size_t used_ = 0;
};

/// Looks once: each part of the grid finds its particles' neighbours for itself, and what it found is written
/// to their rows when the lengths of all are known.
template <int Dim>
class ListBuilder {
 public:
  /// @param half_reach per particle, where pairs have a reach of their own; else empty
  ListBuilder(CellGrid<Dim> const& grid, std::vector<double> const& half_reach, PairSupport support, int threads)
      : grid_(grid), sorted_(grid, half_reach, support, threads), threads_(threads) {}

  NeighbourList build(NeighbourList list) {
    std::size_t const n = grid_.particles().size();
    std::size_t const parts = (grid_.cells() + cells_per_part - 1) / cells_per_part;
    std::vector<std::vector<std::uint32_t>> found(parts);
    std::vector<std::uint32_t> length(n);
    for_each_part(parts, [&](Search<Dim>& search, std::size_t part) {
      found[part] = search.find(first_cell(part), first_cell(part + 1), length);
    });
    set_rows(length, list.first);
    list.neighbour.clear();  // or what it holds would be copied to where there is more room
    list.neighbour.resize(list.first[n]);
    for_each_part(parts, [&](Search<Dim>& search, std::size_t part) {
      search.write(first_cell(part), first_cell(part + 1), found[part].data(), list);
      found[part] = {};
    });
    return list;
  }

 private:
  /// Where rows begin, given their lengths in the order of the cells: the sums of each block, then from where on it counts.
  void set_rows(std::vector<std::uint32_t> const& length, std::vector<std::size_t>& first) const {
    std::size_t const n = length.size();
    first.resize(n + 1);
    first[0] = 0;
    for_each_row(n, threads_, [&](std::size_t s) {
      if (s + particles_ahead < n) __builtin_prefetch(&first[grid_.particles()[s + particles_ahead] + 1], 1);
      first[grid_.particles()[s] + 1] = length[s];
    });
    constexpr std::size_t block_size = 4096;
    std::size_t const blocks = (n + block_size - 1) / block_size;
    std::vector<std::size_t> before(blocks + 1, 0);
    auto const for_each_of = [&](auto const& visit) {
      for_each_block(
          blocks, threads_,
          [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) visit(b, b * block_size, std::min(n, (b + 1) * block_size));
          },
          1);
    };
    for_each_of([&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) before[b + 1] += first[i + 1];
    });
    for (std::size_t b = 0; b < blocks; ++b) before[b + 1] += before[b];
    for_each_of([&](std::size_t b, std::size_t begin, std::size_t end) {
      std::size_t sum = before[b];
      for (std::size_t i = begin; i < end; ++i) first[i + 1] = sum += first[i + 1];
    });
  }

  static constexpr std::size_t cells_per_part = 64;
  static constexpr std::size_t parts_per_task = 8;

  std::size_t first_cell(std::size_t part) const { return std::min(part * cells_per_part, grid_.cells()); }

  /// Calls visit(search, part) for every part of the grid.
  template <class Visit>
  void for_each_part(std::size_t parts, Visit const& visit) const {
    for_each_block(
        parts, threads_,
        [&](std::size_t begin, std::size_t end) {
          Search<Dim> search(grid_, sorted_.view());
          for (std::size_t part = begin; part < end; ++part) visit(search, part);
        },
        parts_per_task);
  }

  CellGrid<Dim> const& grid_;
  SortedParticles<Dim> sorted_;
  int threads_;
};

}  // namespace

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, int threads, NeighbourList old) {
  std::vector<double> const common;
  return ListBuilder<Dim>(grid, common, PairSupport::mean, threads).build(std::move(old));
}

template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, SmoothingLength const& h, double skin, int threads,
                              NeighbourList old, PairSupport support) {
  if (h.is_uniform()) return find_neighbours(grid, threads, std::move(old));
  std::vector<double> half_reach(grid.positions().size());
  for_each_row(half_reach.size(), threads, [&](std::size_t i) { half_reach[i] = 0.5 * (1.0 + skin) * h.support(i); });
  return ListBuilder<Dim>(grid, half_reach, support, threads).build(std::move(old));
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                  \
  template NeighbourList find_neighbours(CellGrid<Dim> const&, int, NeighbourList);                 \
  template NeighbourList find_neighbours(CellGrid<Dim> const&, SmoothingLength const&, double, int, \
                                         NeighbourList, PairSupport);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
