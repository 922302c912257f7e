#pragma once

#include <limits>

#include "formulations/sweep/stored_slope.hpp"
#include "formulations/sweep/views.hpp"

// How the general loop reads the particles of a row: it copies their records side by side.
// Included by the files that are compiled once per instruction set, and by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Whether this is the best instruction set of the architecture, whose loops are made for single schemes and plans too. Others
/// are for processors that are hardly found any more, and take the general loop.
inline constexpr bool specialises = SPHVERIFY_SPECIALISES;

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
template <class Kernel>
SPHVERIFY_INLINE Pack mask_idle(Pack squared, std::size_t idle, Pack h) {
  if (idle == 0) return squared;
  Pack const lane{Pack::Lanes{0.0, 1.0, 2.0, 3.0}};
  return select(lane < Pack(static_cast<double>(Pack::size - idle)), squared, Pack(4.0 * Kernel::support_ratio * Kernel::support_ratio) * h * h);
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

/// Stored numbers of up to four neighbours, wherever they lie, with 0 in lanes that hold none.
SPHVERIFY_INLINE Pack load_stored(double const* numbers, std::size_t idle) {
  Pack stored = 0.0;
  if (idle == 0) {
    __builtin_memcpy(&stored.lanes, numbers, sizeof stored.lanes);
  } else {
    for (std::size_t l = 0; l < Pack::size - idle; ++l) stored.lanes[l] = numbers[l];
  }
  return stored;
}

/// Copies the records of a row's neighbours side by side, with their distances and kernel slopes.
/// @tparam own_lengths whether every particle has its own smoothing length
/// @tparam groups doubles per record over four, or 0 to take the plan's
template <int Dim, class Kernel, Wrapping wrapping, bool own_lengths, std::size_t groups>
class Gatherer {
 public:
  Gatherer(SweepPlan const& plan, double* scratch)
      : plan_(plan),
        columns_(scratch),
        distance_(scratch + stride() * part_size),
        radial_(distance_ + part_size),
        value_(radial_ + part_size),
        offset_(value_ + part_size),
        radial_i_(own_lengths && plan.wants_own_radial ? offset_ + Dim * part_size : radial_),
        radial_j_(own_lengths && plan.wants_own_radial ? radial_i_ + part_size : radial_),
        h_(plan.h),
        per_h_(1.0 / plan.h),
        scale_(scale(plan.h)),
        wants_separation_(plan.wants_separation),
        wants_radial_(plan.wants_radial),
        wants_value_(plan.wants_value),
        wants_own_radial_(plan.wants_own_radial) {}

  /// @param list particle i's neighbours, or at most part_size of them
  SPHVERIFY_INLINE Row gather(std::size_t i, std::uint32_t const* list, std::size_t count) {
    double const* const own = plan_.records + i * stride();
    if constexpr (is_stored<Kernel>) first_ = list - plan_.neighbour;
    for_each_four(
        list, count,
        [&](std::uint32_t const* four, std::size_t k, std::size_t idle)
            SPHVERIFY_FORCE_INLINE { add(own, four, k, idle); });
    std::size_t const padded = (count + Pack::size - 1) / Pack::size * Pack::size;
    double const h = own_lengths ? own[plan_.slots.h] : h_;
    return {plan_.slots, own, columns_, distance_, radial_, value_, offset_, radial_i_, radial_j_, padded, h};
  }

 private:
  static double scale(double h) {
    if constexpr (is_stored<Kernel>) {
      return 1.0;
    } else {
      return (Pack(Kernel::sigma) * integer_power<Dim + 2>(Pack(1.0 / h))).lanes[0];
    }
  }
  SPHVERIFY_INLINE std::size_t stride() const { return groups > 0 ? groups * Pack::size : plan_.stride; }

  /// @param idle how many lanes at the end hold no neighbour
  SPHVERIFY_INLINE void add(double const* own, std::uint32_t const* four, std::size_t k, std::size_t idle) {
    double const* const a = plan_.records + four[0] * stride();
    double const* const b = plan_.records + four[1] * stride();
    double const* const c = plan_.records + four[2] * stride();
    double const* const d = plan_.records + four[3] * stride();
    double* const to = columns_ + k;
    // The first columns are the places.
    Transposed const head(a, b, c, d);
    PackVector<Dim> separation;
    for (std::size_t n = 0; n < Dim; ++n) separation.component[n] = Pack(own[n]) - head.column[n];
    wrap<Dim, wrapping>(plan_, separation);
    if (wants_separation_) {
      for (std::size_t n = 0; n < Dim; ++n) separation.component[n].store(to + n * part_size);
    }
    for (std::size_t n = Dim; n < Pack::size; ++n) head.column[n].store(to + n * part_size);
    for (std::size_t slot = Pack::size; slot < stride(); slot += Pack::size) {
      Transposed const next(a + slot, b + slot, c + slot, d + slot);
      for (std::size_t n = 0; n < Pack::size; ++n) next.column[n].store(to + (slot + n) * part_size);
    }
    Pack h = h_;
    Pack per_h = per_h_;
    if constexpr (own_lengths) {
      h = Pack(0.5) *
          (Pack(own[plan_.slots.h]) + Pack::load(to + static_cast<std::size_t>(plan_.slots.h) * part_size));
      per_h = Pack(1.0) / h;
    }
    Pack const r = sqrt(mask_idle<Kernel>(separation.squaredNorm(), idle, h));
    r.store(distance_ + k);
    if constexpr (is_stored<Kernel>) {
      if (wants_value_) Pack(std::numeric_limits<double>::quiet_NaN()).store(value_ + k);
      load_stored(plan_.slope + first_ + k, idle).store(radial_ + k);
      for (std::size_t n = 0; n < Dim && plan_.offset[n] != nullptr; ++n)
        load_stored(plan_.offset[n] + first_ + k, idle).store(offset_ + n * part_size + k);
      return;
    } else {
      if constexpr (own_lengths) {
        if (wants_own_radial_) {
          Pack const h_j = Pack::load(to + static_cast<std::size_t>(plan_.slots.h) * part_size);
          add_own_slopes(r, own[plan_.slots.h], h_j, k);
        }
      }
      add_kernel(r, per_h, k);
    }
  }

  SPHVERIFY_INLINE void add_own_slopes(Pack r, double h_i, Pack h_j, std::size_t k) {
    Pack const per_h_i = 1.0 / h_i;
    Pack const per_h_j = Pack(1.0) / h_j;
    (Pack(Kernel::sigma) * integer_power<Dim + 2>(per_h_i) * Kernel::slope_shape(r * per_h_i)).store(radial_i_ + k);
    (Pack(Kernel::sigma) * integer_power<Dim + 2>(per_h_j) * Kernel::slope_shape(r * per_h_j)).store(radial_j_ + k);
  }

  SPHVERIFY_INLINE void add_kernel(Pack r, Pack per_h, std::size_t k) {
    if (wants_value_)
      (Pack(Kernel::sigma) * integer_power<Dim>(per_h) * Kernel::shape(r * per_h)).store(value_ + k);
    if (!wants_radial_) return;
    Pack scale = scale_;
    if constexpr (own_lengths) scale = Pack(Kernel::sigma) * integer_power<Dim + 2>(per_h);
    (scale * Kernel::slope_shape(r * per_h)).store(radial_ + k);
  }

  SweepPlan const& plan_;
  double* columns_;
  double* distance_;
  double* radial_;
  double* value_;
  double* offset_;
  double *radial_i_, *radial_j_;
  std::ptrdiff_t first_ = 0;  ///< where in the list a row begins, whose weights are stored
  double h_, per_h_, scale_;
  bool wants_separation_, wants_radial_, wants_value_, wants_own_radial_;
};

/// The sums of all terms of rows begin to end.
template <int Dim>
struct SumTerms {
  template <class AGatherer>
  SPHVERIFY_INLINE static void run(SweepPlan const& plan, std::size_t begin, std::size_t end,
                                   double* scratch) {
    AGatherer gatherer(plan, scratch);
    for (std::size_t i = begin; i < end; ++i) {
      double sums[most_terms][most_components] = {};
      for (std::size_t from = plan.first[i]; from < plan.first[i + 1]; from += part_size) {
        std::size_t const left = plan.first[i + 1] - from;
        Row const row = gatherer.gather(i, plan.neighbour + from, left < part_size ? left : part_size);
        for (std::size_t t = 0; t < plan.term_count; ++t)
          plan.terms[t].sum(row, plan.terms[t].parameters, sums[t]);
      }
      for (std::size_t t = 0; t < plan.term_count; ++t) {
        RowTerm const& term = plan.terms[t];
        for (int k = 0; k < term.components; ++k) term.outputs[static_cast<std::size_t>(k)][i] = sums[t][k];
      }
    }
  }
};

/// Takes the gatherer that suits a plan; common plans have one of their own, in which all sizes are known.
template <int Dim, class Kernel, class Work, Wrapping wrapping, bool own_lengths, class... Rest>
SPHVERIFY_INLINE void with_gatherer(SweepPlan const& plan, Rest... rest) {
  if constexpr (specialises && wrapping != Wrapping::turned) {
    if (plan.stride == 4) return Work::template run<Gatherer<Dim, Kernel, wrapping, own_lengths, 1>>(plan, rest...);
    if (plan.stride == 8) return Work::template run<Gatherer<Dim, Kernel, wrapping, own_lengths, 2>>(plan, rest...);
    if (plan.stride == 12) return Work::template run<Gatherer<Dim, Kernel, wrapping, own_lengths, 3>>(plan, rest...);
    if (plan.stride == 16) return Work::template run<Gatherer<Dim, Kernel, wrapping, own_lengths, 4>>(plan, rest...);
  }
  Work::template run<Gatherer<Dim, Kernel, wrapping, own_lengths, 0>>(plan, rest...);
}
template <int Dim, class Kernel, class Work, Wrapping wrapping, class... Rest>
SPHVERIFY_INLINE void with_gatherer(SweepPlan const& plan, Rest... rest) {
  if (plan.slots.h >= 0) return with_gatherer<Dim, Kernel, Work, wrapping, true>(plan, rest...);
  with_gatherer<Dim, Kernel, Work, wrapping, false>(plan, rest...);
}
template <int Dim, class Kernel, class Work, class... Rest>
SPHVERIFY_INLINE void with_gatherer(SweepPlan const& plan, Rest... rest) {
  switch (plan.wrapping) {
    case Wrapping::none:
      return with_gatherer<Dim, Kernel, Work, Wrapping::none>(plan, rest...);
    case Wrapping::along_axes:
      return with_gatherer<Dim, Kernel, Work, Wrapping::along_axes>(plan, rest...);
    case Wrapping::turned:
      return with_gatherer<Dim, Kernel, Work, Wrapping::turned>(plan, rest...);
  }
}

template <int Dim, class Kernel>
void rows(SweepPlan const& plan, std::size_t begin, std::size_t end, double* scratch) {
  with_gatherer<Dim, Kernel, SumTerms<Dim>>(plan, begin, end, scratch);
}

/// The conductances of the pairs of rows begin to end. Made once a scene: one gatherer serves all plans.
template <int Dim, class Kernel>
void conductances(SweepPlan const& plan, void (*of_row)(Row const&, double*), std::size_t begin,
                  std::size_t end, double* scratch, double* out) {
  auto const run = [&](auto gatherer) {
    double* const padded = scratch + (plan.stride + 6) * part_size;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t from = plan.first[i]; from < plan.first[i + 1]; from += part_size) {
        std::size_t const left = plan.first[i + 1] - from;
        std::size_t const count = left < part_size ? left : part_size;
        of_row(gatherer.gather(i, plan.neighbour + from, count), padded);
        for (std::size_t k = 0; k < count; ++k) out[from + k] = padded[k];
      }
    }
  };
  switch (plan.wrapping) {
    case Wrapping::none:
      return run(Gatherer<Dim, Kernel, Wrapping::none, false, 0>(plan, scratch));
    case Wrapping::along_axes:
      return run(Gatherer<Dim, Kernel, Wrapping::along_axes, false, 0>(plan, scratch));
    case Wrapping::turned:
      return run(Gatherer<Dim, Kernel, Wrapping::turned, false, 0>(plan, scratch));
  }
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
