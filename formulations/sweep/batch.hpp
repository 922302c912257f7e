// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/simd/pack.hpp"
#include "formulations/sweep/sweep.hpp"

// How the pairs of some rows are laid side by side: their neighbours' records, separations and distances, and what the kernel
// makes of these. The only part of a sweep that knows boxes and smoothing lengths; none knows the kernel.
// Included by the file that is compiled once per instruction set, and by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Four records are four rows of a matrix; its columns are wanted.
struct Transposed {
  Pack column[Pack::size];

  SPHVERIFY_INLINE Transposed(double const* a, double const* b, double const* c, double const* d) {
    // Halves first: these are loaded straight into their places, so that shuffles are few.
    Pack::Lanes const ra = Pack::load(a).lanes;
    Pack::Lanes const rb = Pack::load(b).lanes;
    Pack::Lanes const rc = Pack::load(c).lanes;
    Pack::Lanes const rd = Pack::load(d).lanes;
    Pack::Lanes const ac = __builtin_shufflevector(ra, rc, 0, 1, 4, 5);
    Pack::Lanes const bd = __builtin_shufflevector(rb, rd, 0, 1, 4, 5);
    Pack::Lanes const ac_rest = __builtin_shufflevector(ra, rc, 2, 3, 6, 7);
    Pack::Lanes const bd_rest = __builtin_shufflevector(rb, rd, 2, 3, 6, 7);
    column[0] = __builtin_shufflevector(ac, bd, 0, 4, 2, 6);
    column[1] = __builtin_shufflevector(ac, bd, 1, 5, 3, 7);
    column[2] = __builtin_shufflevector(ac_rest, bd_rest, 0, 4, 2, 6);
    column[3] = __builtin_shufflevector(ac_rest, bd_rest, 1, 5, 3, 7);
  }
};

/// Brings separations to their nearest periodic image.
template <int Dim, Wrapping wrapping>
SPHVERIFY_INLINE void wrap(SweepPlan const& plan, PackVector<Dim>& separation) {
  if constexpr (wrapping == Wrapping::along_axes) {
    for (std::size_t n = 0; n < Dim; ++n) {
      Pack& along = separation.component[n];
      along -= Pack(plan.period[n]) * nearest_integer(along * Pack(plan.inverse_period[n]));
    }
  } else if constexpr (wrapping == Wrapping::turned) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      double const* const direction = plan.axes.data() + axis * Dim;
      Pack along = Pack(direction[0]) * separation.component[0];
      for (std::size_t n = 1; n < Dim; ++n) along += Pack(direction[n]) * separation.component[n];
      Pack const whole = Pack(plan.period[axis]) * nearest_integer(along * Pack(plan.inverse_period[axis]));
      for (std::size_t n = 0; n < Dim; ++n) separation.component[n] -= whole * Pack(direction[n]);
    }
  }
}

/// Puts the last `idle` lanes out of reach.
SPHVERIFY_INLINE Pack mask_idle(Pack squared, std::size_t idle, Pack beyond) {
  if (idle == 0) return squared;
  Pack const lane{Pack::Lanes{0.0, 1.0, 2.0, 3.0}};
  return select(lane < Pack(static_cast<double>(Pack::size - idle)), squared, beyond * beyond);
}

/// Calls block(indices of four neighbours, number of the first, idle lanes) along a list. Lanes that are left
/// over repeat the last neighbour, by an index and not by branches: how long a row is nobody predicts.
template <class Block>
SPHVERIFY_INLINE void for_each_four(std::uint32_t const* list, std::size_t count, Block const& block) {
  std::size_t const whole = count - count % Pack::size;
  for (std::size_t k = 0; k < whole; k += Pack::size) block(list + k, k, std::size_t{0});
  if (whole == count) return;
  std::uint32_t rest[Pack::size];
  for (std::size_t l = 0; l < Pack::size; ++l) {
    std::size_t const k = whole + l;
    rest[l] = list[k < count ? k : count - 1];
  }
  block(rest, whole, Pack::size - (count - whole));
}

/// Where the columns of a batch lie in the scratch memory.
struct Columns {
  std::size_t capacity;
  std::uint32_t* neighbour;
  double *separation, *distance, *radial, *value, *offset, *radial_i, *radial_j, *pair_h, *h_i, *h_j;
  double* out;  ///< for conductances

  Columns(double* scratch, std::size_t pairs) : capacity(pairs) {
    auto const take = [&](std::size_t columns) {
      double* const from = scratch;
      scratch += columns * capacity;
      return from;
    };
    neighbour = reinterpret_cast<std::uint32_t*>(take(1));
    separation = take(3);
    distance = take(1);
    radial = take(1);
    value = take(1);
    offset = take(3);
    radial_i = take(1);
    radial_j = take(1);
    pair_h = take(1);
    h_i = take(1);
    h_j = take(1);
    out = take(1);
  }
};

/// Makes batches of a plan's rows.
/// @tparam own_lengths whether every particle has its own smoothing length
template <int Dim, Wrapping wrapping, bool own_lengths>
class Batches {
 public:
  Batches(SweepPlan const& plan, std::size_t capacity, double* scratch) : plan_(plan), to_(scratch, capacity) {}

  /// Rows from `begin` on, as many as have room.
  Batch next(std::size_t begin, std::size_t end) {
    // Copies, which the compiler knows that nothing written to a column changes.
    SweepPlan const plan = plan_;
    Columns const to = to_;
    std::size_t rows = 0, pairs = 0;
    first_[0] = 0;
    for (; begin + rows < end && rows < batch_rows; ++rows) {
      std::size_t const count = plan.first[begin + rows + 1] - plan.first[begin + rows];
      std::size_t const padded = (count + Pack::size - 1) / Pack::size * Pack::size;
      if (rows > 0 && pairs + padded > to.capacity) break;
      add_row(plan, to, begin + rows, count, pairs);
      first_[rows + 1] = pairs += padded;
    }
    add_kernel(pairs);
    bool const both = own_lengths && plan_.wants_own_radial;
    return {.slots = plan_.slots,
            .begin = begin,
            .rows = rows,
            .first = first_,
            .records = plan_.records,
            .stride = plan_.stride,
            .neighbour = to_.neighbour,
            .separation = to_.separation,
            .distance = to_.distance,
            .radial = to_.radial,
            .value = to_.value,
            .offset = to_.offset,
            .radial_i = both ? to_.radial_i : to_.radial,
            .radial_j = both ? to_.radial_j : to_.radial,
            .pair_h = own_lengths ? to_.pair_h : nullptr,
            .capacity = to_.capacity,
            .h = plan_.h,
            .support_ratio = plan_.support_ratio};
  }

  double* out() const { return to_.out; }

 private:
  SPHVERIFY_INLINE static void add_row(SweepPlan const& plan, Columns const& columns, std::size_t i, std::size_t count,
                                       std::size_t at) {
    std::size_t const stride = plan.stride;
    double const* const own = plan.records + i * stride;
    PackVector<Dim> place;
    for (std::size_t n = 0; n < Dim; ++n) place.component[n] = own[n];
    std::size_t const listed = plan.first[i];
    for_each_four(plan.neighbour + listed, count, [&](std::uint32_t const* four, std::size_t k, std::size_t idle)
                                                     SPHVERIFY_FORCE_INLINE {
      double const* const a = plan.records + four[0] * stride;
      double const* const b = plan.records + four[1] * stride;
      double const* const c = plan.records + four[2] * stride;
      double const* const d = plan.records + four[3] * stride;
      std::size_t const to = at + k;
      __builtin_memcpy(columns.neighbour + to, four, Pack::size * sizeof *four);
      Transposed const there(a, b, c, d);
      PackVector<Dim> separation;
      for (std::size_t n = 0; n < Dim; ++n) separation.component[n] = place.component[n] - there.column[n];
      wrap<Dim, wrapping>(plan, separation);
      if (plan.wants_separation) {
        for (std::size_t n = 0; n < Dim; ++n) separation.component[n].store(columns.separation + n * columns.capacity + to);
      }
      Pack h = plan.h;
      if constexpr (own_lengths) {
        auto const slot = static_cast<std::size_t>(plan.slots.h);
        Pack const h_i = own[slot];
        Pack const h_j = Pack::Lanes{a[slot], b[slot], c[slot], d[slot]};
        h = Pack(0.5) * (h_i + h_j);
        h.store(columns.pair_h + to);
        if (plan.wants_own_radial) {
          h_i.store(columns.h_i + to);
          h_j.store(columns.h_j + to);
        }
      }
      Pack const beyond = Pack(2.0 * plan.support_ratio) * h;
      sqrt(mask_idle(separation.squaredNorm(), idle, beyond)).store(columns.distance + to);
    });
    if (plan.slope != nullptr) add_stored(plan, columns, listed, count, at);
  }

  /// What stands in place of the kernel's slopes, with zeros beyond the row.
  static void add_stored(SweepPlan const& plan, Columns const& columns, std::size_t listed, std::size_t count, std::size_t at) {
    auto const copy = [&](double const* from, double* to) {
      for (std::size_t k = 0; k < count; ++k) to[at + k] = from[listed + k];
      for (std::size_t k = count; k % Pack::size != 0; ++k) to[at + k] = 0.0;
    };
    copy(plan.slope, columns.radial);
    for (std::size_t n = 0; n < Dim && plan.offset[n] != nullptr; ++n)
      copy(plan.offset[n], columns.offset + n * columns.capacity);
  }

  void add_kernel(std::size_t pairs) {
    double const* const r = to_.distance;
    KernelColumns const& kernel = plan_.kernel;
    bool const computes_radial = plan_.wants_radial && plan_.slope == nullptr;
    if constexpr (own_lengths) {
      if (computes_radial) kernel.radial_of(r, pairs, to_.pair_h, to_.radial);
      if (plan_.wants_value) kernel.value_of(r, pairs, to_.pair_h, to_.value);
      if (plan_.wants_own_radial) {
        kernel.radial_of(r, pairs, to_.h_i, to_.radial_i);
        kernel.radial_of(r, pairs, to_.h_j, to_.radial_j);
      }
    } else {
      if (computes_radial) kernel.radial(r, pairs, plan_.h, to_.radial);
      if (plan_.wants_value) kernel.value(r, pairs, plan_.h, to_.value);
    }
  }

  SweepPlan const& plan_;
  Columns to_;
  std::size_t first_[batch_rows + 1];
};

/// Calls work(batches) with those that suit a plan.
template <int Dim, bool own_lengths>
void with_batches(SweepPlan const& plan, std::size_t capacity, double* scratch, auto const& work) {
  switch (plan.wrapping) {
    case Wrapping::none:
      return work(Batches<Dim, Wrapping::none, own_lengths>(plan, capacity, scratch));
    case Wrapping::along_axes:
      return work(Batches<Dim, Wrapping::along_axes, own_lengths>(plan, capacity, scratch));
    case Wrapping::turned:
      return work(Batches<Dim, Wrapping::turned, own_lengths>(plan, capacity, scratch));
  }
}
template <int Dim>
void with_batches(SweepPlan const& plan, std::size_t capacity, double* scratch, auto const& work) {
  if (plan.slots.h >= 0) return with_batches<Dim, true>(plan, capacity, scratch, work);
  with_batches<Dim, false>(plan, capacity, scratch, work);
}

/// The sums of all terms of rows begin to end.
template <int Dim>
void rows(SweepPlan const& plan, std::size_t begin, std::size_t end, std::size_t capacity, double* scratch) {
  with_batches<Dim>(plan, capacity, scratch, [&](auto batches) {
    for (std::size_t i = begin; i < end;) {
      Batch const batch = batches.next(i, end);
      for (std::size_t n = 0; n < plan.loop_count; ++n) plan.loops[n](batch, plan.terms + plan.loop_terms[n]);
      i += batch.rows;
    }
  });
}

/// The conductances of the pairs of rows begin to end, in the order of the list.
template <int Dim>
void conductances(SweepPlan const& plan, void (*of_batch)(Batch const&, double*), std::size_t begin, std::size_t end,
                  std::size_t capacity, double* scratch, double* out) {
  with_batches<Dim>(plan, capacity, scratch, [&](auto batches) {
    for (std::size_t i = begin; i < end;) {
      Batch const batch = batches.next(i, end);
      of_batch(batch, batches.out());
      for (std::size_t row = 0; row < batch.rows; ++row, ++i) {
        double const* const padded = batches.out() + batch.first[row];
        std::size_t const count = plan.first[i + 1] - plan.first[i];
        for (std::size_t k = 0; k < count; ++k) out[plan.first[i] + k] = padded[k];
      }
    }
  });
}

inline void conduct(std::size_t const* first, std::uint32_t const* neighbour, double const* conductance,
                    double const* temperature, std::size_t begin, std::size_t end, double* rate) {
  for (std::size_t i = begin; i < end; ++i) {
    double const own = temperature[i];
    // Four sums hide the latency of the additions.
    double sum[Pack::size] = {0.0, 0.0, 0.0, 0.0};
    std::size_t k = first[i];
    for (; k + Pack::size <= first[i + 1]; k += Pack::size) {
      for (std::size_t l = 0; l < Pack::size; ++l) {
        sum[l] += conductance[k + l] * (own - temperature[neighbour[k + l]]);
      }
    }
    for (; k < first[i + 1]; ++k) sum[0] += conductance[k] * (own - temperature[neighbour[k]]);
    rate[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
