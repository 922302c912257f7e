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

/// The particles of the cells around one, side by side and moved to the image that is near it.
template <int Dim>
class CandidateBuffer {
 public:
  CandidateBuffer(CellGrid<Dim> const& grid, std::vector<double> const& half_reach)
      : grid_(grid), half_reach_of_(half_reach), turned_(grid.domain().is_turned()) {}

  /// @param begin, end the cell's own particles
  void fill(std::uint32_t begin, std::vector<typename CellGrid<Dim>::Run> const& runs) {
    std::size_t total = 0;
    for (auto const& run : runs) total += run.end - run.begin;
    reserve((total + 3) / 4 * 4);
    count_ = 0;
    for (auto const& run : runs) {
      if (run.begin <= begin && begin < run.end && run.shift.isZero(0.0)) own_ = count_ + (begin - run.begin);
      for (std::uint32_t s = run.begin; s < run.end; ++s) {
        std::uint32_t const j = grid_.particles()[s];
        Vector<Dim> x = grid_.positions()[j];
        if (turned_) x = grid_.domain().to_box(x);
        for (int k = 0; k < Dim; ++k) component(k)[count_] = x[k] + run.shift[k];
        if (!half_reach_of_.empty()) half_reach()[count_] = half_reach_of_[j];
        particle_[count_++] = j;
      }
    }
    for (; count_ % 4 != 0; ++count_) component(0)[count_] = far_away;
  }

  /// Calls test(candidates, place, its part of the reach) for the cell's particle `n`, itself left out.
  template <class Test>
  void without(std::size_t n, double common_reach, Test const& test) {
    std::size_t const self = own_ + n;
    std::array<double, Dim> x;
    for (int k = 0; k < Dim; ++k) x[static_cast<std::size_t>(k)] = component(k)[self];
    component(0)[self] = far_away;
    Candidates all{.x = {}, .half_reach = nullptr, .particle = particle_.data(), .count = count_};
    for (int k = 0; k < Dim; ++k) all.x[static_cast<std::size_t>(k)] = component(k);
    if (!half_reach_of_.empty()) all.half_reach = half_reach();
    test(all, x.data(), all.half_reach ? all.half_reach[self] : common_reach);
    component(0)[self] = x[0];
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
  std::vector<double> const& half_reach_of_;
  bool turned_;
  std::vector<double> values_;
  std::vector<std::uint32_t> particle_;
  std::size_t capacity_ = 0, count_ = 0, own_ = 0;
};

/// Two looks at the candidates, one that counts and one that lists, cost less than a list that grows, and can
/// be shared between threads.
template <int Dim>
class ListBuilder {
 public:
  /// @param half_reach per particle, where pairs have a reach of their own; else empty
  ListBuilder(CellGrid<Dim> const& grid, std::vector<double> const& half_reach, int threads)
      : grid_(grid), half_reach_(half_reach), threads_(threads) {}

  NeighbourList build(NeighbourList list) {
    std::size_t const n = grid_.particles().size();
    SweepKernels const& kernels = sweep_kernels<Dim>();
    list.first.assign(n + 1, 0);
    for_each_particle([&](std::uint32_t i, Candidates const& all, double const* x, double reach, auto&) {
      std::size_t same_place = 0;
      kernels.count_near(all, x, reach, &list.first[i + 1], &same_place);
      if (same_place > 0) complain_of_same_place(i);
    });
    for (std::size_t i = 0; i < n; ++i) list.first[i + 1] += list.first[i];
    list.neighbour.resize(list.first[n]);
    for_each_particle([&](std::uint32_t i, Candidates const& all, double const* x, double reach, auto& row) {
      std::size_t const near = list.first[i + 1] - list.first[i];
      row.resize(std::max(row.size(), near + 4));
      // Both looks must see the same: the one's rounding is the other's.
      if (kernels.list_near(all, x, reach, row.data()) != near) {
        throw std::logic_error("a neighbour list found other neighbours than it counted");
      }
      std::copy_n(row.begin(), near, list.neighbour.begin() + static_cast<std::ptrdiff_t>(list.first[i]));
    });
    return list;
  }

 private:
  /// Calls visit(i, candidates, place, its part of the reach, scratch) for every particle.
  template <class Visit>
  void for_each_particle(Visit const& visit) const {
    for_each_block(grid_.cells(), threads_, [&](std::size_t first_cell, std::size_t last_cell) {
      CandidateBuffer<Dim> buffer(grid_, half_reach_);
      std::vector<std::uint32_t> scratch;
      grid_.for_each_cell(first_cell, last_cell,
                          [&](std::uint32_t begin, std::uint32_t end, auto const& runs) {
                            buffer.fill(begin, runs);
                            for (std::uint32_t s = begin; s < end; ++s) {
                              buffer.without(s - begin, grid_.reach(),
                                             [&](Candidates const& all, double const* x, double reach) {
                                               visit(grid_.particles()[s], all, x, reach, scratch);
                                             });
                            }
                          });
    });
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
  std::vector<double> const& half_reach_;
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
