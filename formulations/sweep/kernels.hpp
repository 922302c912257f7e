#pragma once

#include <tuple>
#include <utility>

#include "formulations/all.hpp"
#include "formulations/sweep/terms.hpp"

// The loops over pairs. Included by the files that are compiled once per instruction set, and by nothing
// else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// A term's sum over a row that has been copied.
template <class Term, int Dim>
void sum_row(Row const& row, void const* parameters, double* out) {
  View<Dim, Term::reads, ReadOwn> const i(row.slots, ReadOwn{row.own});
  Term term(parameters);
  for (std::size_t k = 0; k < row.count; k += Pack::size) {
    View<Dim, Term::reads, ReadColumns> const j(row.slots, ReadColumns{row.columns + k});
    term.add(i, j, KernelColumns<Dim>(row, k));
  }
  term.write(row.h, out);
}

template <class Scheme, int Dim>
void conductance_of_row(Row const& row, double* out) {
  constexpr FieldSet reads = RateTerm<Scheme, Dim>::reads;
  View<Dim, reads, ReadOwn> const i(row.slots, ReadOwn{row.own});
  for (std::size_t k = 0; k < row.count; k += Pack::size) {
    View<Dim, reads, ReadColumns> const j(row.slots, ReadColumns{row.columns + k});
    Scheme::conductance(i, j, KernelColumns<Dim>(row, k)).store(out + k);
  }
}

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

/// Whether the term divides by something of its own, which it names by `divisor`.
template <class Term>
inline constexpr bool divides = requires {
  Term::has_divisor;
};

/// Terms one after the other; what std::tuple would be, were its calls sure to be inlined. Each sees of the particles i and
/// j what it reads.
template <int Dim, class... Terms>
struct TermList {
  SPHVERIFY_INLINE explicit TermList(RowTerm const*) {}
  SPHVERIFY_INLINE void add(RecordSlots const&, ReadOwn, ReadRegisters, KernelRegisters<Dim> const&) {}
  SPHVERIFY_INLINE static Pack divisor(RecordSlots const&, ReadOwn, ReadRegisters, KernelRegisters<Dim> const&) {
    return 1.0;
  }
  SPHVERIFY_INLINE void write(RowTerm const*, double, std::size_t) const {}
};
template <int Dim, class First, class... Rest>
struct TermList<Dim, First, Rest...> {
  using Own = View<Dim, First::reads, ReadOwn>;
  using Other = View<Dim, First::reads, ReadRegisters>;
  First first;
  TermList<Dim, Rest...> rest;

  SPHVERIFY_INLINE explicit TermList(RowTerm const* terms) : first(terms->parameters), rest(terms + 1) {}
  SPHVERIFY_INLINE void add(RecordSlots const& slots, ReadOwn i, ReadRegisters j, KernelRegisters<Dim> const& W) {
    first.add(Own(slots, i), Other(slots, j), W);
    rest.add(slots, i, j, W);
  }
  /// Of the one term that has one.
  SPHVERIFY_INLINE static Pack divisor(RecordSlots const& slots, ReadOwn i, ReadRegisters j,
                                       KernelRegisters<Dim> const& W) {
    if constexpr (divides<First>) {
      return First::divisor(Own(slots, i), Other(slots, j), W);
    } else {
      return TermList<Dim, Rest...>::divisor(slots, i, j, W);
    }
  }
  SPHVERIFY_INLINE void write(RowTerm const* terms, double h, std::size_t i) const {
    double sums[most_components] = {};
    first.write(h, sums);
    for (std::size_t n = 0; n < static_cast<std::size_t>(First::components); ++n)
      terms->outputs[n][i] = sums[n];
    rest.write(terms + 1, h, i);
  }
};

/// Whether the term reads `u`.
template <class Term>
inline constexpr bool reads_state_velocity = requires {
  Term::reads_state_velocity;
};

/// A sweep whose terms are known when it is compiled.
template <int Dim, class Kernel, Wrapping wrapping, bool drifts, class... Terms>
void fused_rows_in(SweepPlan const& plan, std::size_t begin, std::size_t end) {
  static_assert((0 + ... + static_cast<int>(divides<Terms>)) <= 1, "only one divisor is shared");
  constexpr RecordSlots slots = record_slots((Terms::reads | ...), Dim, false, drifts);
  constexpr std::size_t stride = slots.stride();
  double const h = plan.h;
  double const per_h = 1.0 / h;
  Pack const scale = Pack(Kernel::sigma) * integer_power<Dim + 2>(Pack(per_h));
  double const* const records = plan.records;
  for (std::size_t i = begin; i < end; ++i) {
    TermList<Dim, Terms...> terms(plan.terms);
    double const* const own = records + i * stride;
    for_each_four(
        plan.neighbour + plan.first[i], plan.first[i + 1] - plan.first[i],
        [&](std::uint32_t const* four, std::size_t, std::size_t idle) SPHVERIFY_FORCE_INLINE {
          double const* const a = records + four[0] * stride;
          double const* const b = records + four[1] * stride;
          double const* const c = records + four[2] * stride;
          double const* const d = records + four[3] * stride;
          Pack columns[stride];
          for (std::size_t slot = 0; slot < stride; slot += Pack::size) {
            Transposed const next(a + slot, b + slot, c + slot, d + slot);
            for (std::size_t n = 0; n < Pack::size; ++n) columns[slot + n] = next.column[n];
          }
          KernelRegisters<Dim> W;
          for (std::size_t n = 0; n < Dim; ++n) W.r.component[n] = Pack(own[n]) - columns[n];
          wrap<Dim, wrapping>(plan, W.r);
          W.common_h = h;
          W.squared = mask_idle<Kernel>(W.r.squaredNorm(), idle, h);
          W.length = sqrt(W.squared);
          if constexpr ((Terms::wants_radial || ...)) {
            // One division for the kernel's slope and for what a term divides by.
            Pack const q = W.length * Pack(per_h);
            Pack const divisor = TermList<Dim, Terms...>::divisor(slots, ReadOwn{own}, ReadRegisters{columns}, W);
            Pack const quotient = Pack(1.0) / (q * divisor);
            W.slope = scale * Kernel::slope_shape(q, quotient * divisor);
            W.inverse = quotient * q;
          }
          terms.add(slots, ReadOwn{own}, ReadRegisters{columns}, W);
        });
    terms.write(plan.terms, h, i);
  }
}

template <int Dim, class Kernel, bool drifts, class... Terms>
void fused_rows_where(SweepPlan const& plan, std::size_t begin, std::size_t end) {
  plan.wrapping == Wrapping::none
      ? fused_rows_in<Dim, Kernel, Wrapping::none, drifts, Terms...>(plan, begin, end)
      : fused_rows_in<Dim, Kernel, Wrapping::along_axes, drifts, Terms...>(plan, begin, end);
}

template <int Dim, class Kernel, class... Terms>
void fused_rows(SweepPlan const& plan, std::size_t begin, std::size_t end) {
  if constexpr ((reads_state_velocity<Terms> || ...)) {
    if (plan.slots.u != plan.slots.v) return fused_rows_where<Dim, Kernel, true, Terms...>(plan, begin, end);
  }
  fused_rows_where<Dim, Kernel, false, Terms...>(plan, begin, end);
}

template <int Dim, class Kernel, class... Terms>
constexpr FusedSweep fused() {
  return {.terms = {sum_row<Terms, Dim>...},
          .reads = (Terms::reads | ...),
          .reads_state_velocity = (reads_state_velocity<Terms> || ...),
          .rows = fused_rows<Dim, Kernel, Terms...>};
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
        h_(plan.h),
        per_h_(1.0 / plan.h),
        scale_((Pack(Kernel::sigma) * integer_power<Dim + 2>(Pack(1.0 / plan.h))).lanes[0]),
        wants_separation_(plan.wants_separation),
        wants_radial_(plan.wants_radial) {}

  /// @param list particle i's neighbours, or at most part_size of them
  SPHVERIFY_INLINE Row gather(std::size_t i, std::uint32_t const* list, std::size_t count) {
    double const* const own = plan_.records + i * stride();
    for_each_four(
        list, count,
        [&](std::uint32_t const* four, std::size_t k, std::size_t idle)
            SPHVERIFY_FORCE_INLINE { add(own, four, k, idle); });
    std::size_t const padded = (count + Pack::size - 1) / Pack::size * Pack::size;
    double const h = own_lengths ? own[plan_.slots.h] : h_;
    return {plan_.slots, own, columns_, distance_, radial_, padded, h};
  }

 private:
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
    if (!wants_radial_) return;
    Pack scale = scale_;
    if constexpr (own_lengths) scale = Pack(Kernel::sigma) * integer_power<Dim + 2>(per_h);
    (scale * Kernel::slope_shape(r * per_h)).store(radial_ + k);
  }

  SweepPlan const& plan_;
  double* columns_;
  double* distance_;
  double* radial_;
  double h_, per_h_, scale_;
  bool wants_separation_, wants_radial_;
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
  if constexpr (wrapping != Wrapping::turned) {
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
    double* const padded = scratch + (plan.stride + 2) * part_size;
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

/// The pairs of a scheme's passes, that of the rate last.
template <class Scheme, int Dim>
constexpr SchemeLoops loops_of() {
  SchemeLoops loops{};
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    ((loops.passes[n] = sum_row<PassTerm<Scheme, n, Dim>, Dim>), ...);
  }(std::make_index_sequence<std::tuple_size_v<AllPasses<Scheme>>>());
  if constexpr (Scheme::info.difference_form) loops.conductance = conductance_of_row<Scheme, Dim>;
  return loops;
}

/// What a moving gas sweeps together: pressure and its usual work, with and without viscosity and continuity.
template <int Dim, class Kernel, class Momentum, class Work>
constexpr std::array<FusedSweep, 4> fused_gas() {
  using A = RateTerm<Momentum, Dim>;
  using E = RateTerm<Work, Dim>;
  using D = RateTerm<ContinuityDensity, Dim>;
  using V = ViscosityTerm<Dim, Kernel>;
  return {fused<Dim, Kernel, A, E>(), fused<Dim, Kernel, A, E, D>(), fused<Dim, Kernel, A, E, V>(),
          fused<Dim, Kernel, A, E, D, V>()};
}

template <int Dim, class Kernel, class... Schemes>
constexpr std::array<FusedSweep, most_fused> all_fused(std::tuple<Schemes...> const*) {
  std::array<FusedSweep, most_fused> all{};
  std::size_t count = 0;
  auto const put = [&](FusedSweep const& one) { all[count++] = one; };
  auto const put_passes = [&]<class Scheme>(Scheme const*) {
    [&]<std::size_t... n>(std::index_sequence<n...>) {
      (put(fused<Dim, Kernel, PassTerm<Scheme, n, Dim>>()), ...);
    }(std::make_index_sequence<std::tuple_size_v<AllPasses<Scheme>>>());
  };
  (put_passes(static_cast<Schemes const*>(nullptr)), ...);
  put(fused<Dim, Kernel, DensityTerm<Dim, Kernel>>());
  put(fused<Dim, Kernel, ApproachTerm<Dim, Kernel>>());
  for (FusedSweep const& one : fused_gas<Dim, Kernel, PressureOverDensitySquared, InternalEnergyWork>()) put(one);
  for (FusedSweep const& one : fused_gas<Dim, Kernel, SquareRootOfPressure, SquareRootOfPressureWork>()) put(one);
  return all;
}

template <int Dim, class Kernel, class... Schemes>
constexpr std::array<FusedSweep, most_fused> fused_if_wanted(std::tuple<Schemes...> const* list) {
  if constexpr (SPHVERIFY_WITH_FUSED_LOOPS) {
    return all_fused<Dim, Kernel>(list);
  } else {
    return {};
  }
}

template <int Dim, class Kernel, class... Schemes>
constexpr SweepKernels make_kernels(std::tuple<Schemes...> const* list, char const* name) {
  static_assert((IsScheme<Schemes> && ...), "a scheme has an `info`, and in `passes` the code of its first passes");
  static_assert(sizeof...(Schemes) <= most_schemes && 2 * sizeof...(Schemes) + 10 <= most_fused);
  return {.instruction_set = name,
          .rows = rows<Dim, Kernel>,
          .schemes = {loops_of<Schemes, Dim>()...},
          .fused = fused_if_wanted<Dim, Kernel>(list),
          .continuity = sum_row<RateTerm<ContinuityDensity, Dim>, Dim>,
          .density = sum_row<DensityTerm<Dim, Kernel>, Dim>,
          .viscosity = sum_row<ViscosityTerm<Dim, Kernel>, Dim>,
          .approach = sum_row<ApproachTerm<Dim, Kernel>, Dim>,
          .conductances = conductances<Dim, Kernel>,
          .conduct = conduct};
}

#define SPHVERIFY_TEXT_OF(name) #name
#define SPHVERIFY_NAME_OF(name) SPHVERIFY_TEXT_OF(name)

/// All loops of a kernel; dispatch.cpp knows of them by this name alone.
template <template <int> class Kernel, int Dim>
SweepKernels const& loops() {
  static constexpr SweepKernels all = make_kernels<Dim, Kernel<Dim>>(static_cast<AllSchemes const*>(nullptr),
                                                                     SPHVERIFY_NAME_OF(SPHVERIFY_INSTRUCTION_SET));
  return all;
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
