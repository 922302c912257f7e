#pragma once

#include <limits>

#include "formulations/sweep/gather.hpp"
#include "formulations/sweep/terms.hpp"

// Loops made for terms that are known when they are compiled.
// Included by the files that are compiled once per instruction set, and by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

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

/// Whether the term reads W_ij.
template <class Term>
inline constexpr bool wants_value = false;
template <class Scheme, std::size_t n, int Dim>
inline constexpr bool wants_value<PassTerm<Scheme, n, Dim>> =
    PassTerm<Scheme, n, Dim>::Pass::info.kernel.contains(KernelWeight::value);

/// Whether the term reads the offsets of faces.
template <class Term>
inline constexpr bool wants_offset = false;
template <class Scheme, std::size_t n, int Dim>
inline constexpr bool wants_offset<PassTerm<Scheme, n, Dim>> =
    PassTerm<Scheme, n, Dim>::Pass::info.kernel.contains(KernelWeight::face_offset);

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
  Pack scale = 1.0;
  if constexpr (!is_stored<Kernel>) scale = Pack(Kernel::sigma) * integer_power<Dim + 2>(Pack(per_h));
  double const* const records = plan.records;
  for (std::size_t i = begin; i < end; ++i) {
    TermList<Dim, Terms...> terms(plan.terms);
    double const* const own = records + i * stride;
    for_each_four(
        plan.neighbour + plan.first[i], plan.first[i + 1] - plan.first[i],
        [&](std::uint32_t const* four, [[maybe_unused]] std::size_t k, std::size_t idle) SPHVERIFY_FORCE_INLINE {
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
            if constexpr (is_stored<Kernel>) {
              W.slope = load_stored(plan.slope + plan.first[i] + k, idle);
            } else if constexpr (requires { Kernel::slope_shape(q, q); }) {
              W.slope = scale * Kernel::slope_shape(q, quotient * divisor);
            } else {
              W.slope = scale * Kernel::slope_shape(q);
            }
            W.inverse = quotient * q;
          }
          // Beside stored slopes there is no W: who reads it is refused (why_no_pair_weights).
          if constexpr (is_stored<Kernel>)
            W.weight = Pack(std::numeric_limits<double>::quiet_NaN());
          else if constexpr ((wants_value<Terms> || ...))
            W.weight = Pack(Kernel::sigma) * integer_power<Dim>(Pack(per_h)) * Kernel::shape(W.length * Pack(per_h));
          if constexpr (is_stored<Kernel> && (wants_offset<Terms> || ...)) {
            for (std::size_t n = 0; n < Dim; ++n) W.face.component[n] = load_stored(plan.offset[n] + plan.first[i] + k, idle);
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
  return {.terms = {row_sum<Terms, Dim>...},
          .reads = (Terms::reads | ...),
          .reads_state_velocity = (reads_state_velocity<Terms> || ...),
          .rows = fused_rows<Dim, Kernel, Terms...>};
}

template <int Dim, class Kernel, class Scheme>
constexpr auto fused_of_all_passes() {
  return []<std::size_t... n>(std::index_sequence<n...>) {
    return std::array{fused<Dim, Kernel, PassTerm<Scheme, n, Dim>>()...};
  }(std::make_index_sequence<std::tuple_size_v<AllPasses<Scheme>>>());
}

/// One for every pass of a scheme alone; none with a kernel for what reads the faces of cells.
template <int Dim, class Kernel, class Scheme>
constexpr auto fused_passes() {
  if constexpr (!is_stored<Kernel> && reads_face_offsets(Scheme::info)) {
    return std::array<FusedSweep, 0>{};
  } else {
    return fused_of_all_passes<Dim, Kernel, Scheme>();
  }
}

/// Several lists as one.
template <class Element, std::size_t... sizes>
constexpr auto joined(std::array<Element, sizes> const&... lists) {
  std::array<Element, (0 + ... + sizes)> all{};
  std::size_t count = 0;
  auto const put = [&](auto const& list) {
    for (Element const& one : list) all[count++] = one;
  };
  (put(lists), ...);
  return all;
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
