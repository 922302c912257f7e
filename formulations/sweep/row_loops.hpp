// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/sweep/batch.hpp"
#include "formulations/sweep/terms.hpp"

// Loops over the pairs of a batch for terms that are known when they are compiled.
// Included by the files that are compiled once per instruction set, and by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Whether this is the best instruction set of the architecture, which has loops for single records and companies too. Others
/// are for processors that are hardly found any more.
inline constexpr bool specialises = SPHVERIFY_SPECIALISES;

/// Terms one after the other; what std::tuple would be, were its calls sure to be inlined. Each sees of the particles i and
/// j what it reads.
template <int Dim, class... Terms>
struct TermList {
  SPHVERIFY_INLINE explicit TermList(RowTerm const*) {}
  SPHVERIFY_INLINE void add(RecordSlots const&, ReadOwn, auto, KernelOfPairs<Dim> const&) {}
  SPHVERIFY_INLINE void write(RowTerm const*, std::size_t) const {}
};
template <int Dim, class First, class... Rest>
struct TermList<Dim, First, Rest...> {
  First first;
  TermList<Dim, Rest...> rest;

  SPHVERIFY_INLINE explicit TermList(RowTerm const* terms) : first(terms->parameters), rest(terms + 1) {}
  template <class Read>
  SPHVERIFY_INLINE void add(RecordSlots const& slots, ReadOwn i, Read j, KernelOfPairs<Dim> const& W) {
    first.add(View<Dim, First::reads, ReadOwn>(slots, i), View<Dim, First::reads, Read>(slots, j), W);
    rest.add(slots, i, j, W);
  }
  SPHVERIFY_INLINE void write(RowTerm const* terms, std::size_t i) const {
    double sums[most_components] = {};
    first.write(sums);
    for (std::size_t n = 0; n < static_cast<std::size_t>(First::components); ++n) terms->outputs[n][i] = sums[n];
    rest.write(terms + 1, i);
  }
};

/// Whether the term reads `u`.
template <class Term>
inline constexpr bool reads_state_velocity = requires { Term::reads_state_velocity; };

/// Of a batch whose records may hold anything besides.
template <int Dim, class... Terms>
void sum_anywhere(Batch const& batch, RowTerm const* row_terms) {
  for (std::size_t row = 0; row < batch.rows; ++row) {
    TermList<Dim, Terms...> terms(row_terms);
    ReadOwn const own{batch.records + (batch.begin + row) * batch.stride};
    for (std::size_t k = batch.first[row]; k < batch.first[row + 1]; k += Pack::size)
      terms.add(batch.slots, own, ReadRecords{FourRecords(batch, k)}, KernelOfPairs<Dim>(batch, k));
    terms.write(row_terms, batch.begin + row);
  }
}

/// The records of four neighbours as columns: all loads and shuffles are whole packs.
template <std::size_t stride>
struct RecordsInRegisters {
  Pack columns[stride];
  SPHVERIFY_INLINE explicit RecordsInRegisters(FourRecords const& four) {
    double const* const* const record = four.record;
    for (std::size_t slot = 0; slot < stride; slot += Pack::size) {
      Transposed const next(record[0] + slot, record[1] + slot, record[2] + slot, record[3] + slot);
      for (std::size_t n = 0; n < Pack::size; ++n) columns[slot + n] = next.column[n];
    }
  }
};

/// Where the fields that the terms read lie, and no others.
template <int Dim, bool drifts, class... Terms>
inline constexpr RecordSlots slots_for = [] {
  RecordSlots slots = record_slots((Terms::reads | ...), Dim, false, drifts);
  if (!(reads_state_velocity<Terms> || ...)) slots.u = -1;
  return slots;
}();

/// Of a batch whose records begin with what the terms read.
template <int Dim, bool drifts, class... Terms>
void sum_in_place(Batch const& batch, RowTerm const* row_terms) {
  constexpr RecordSlots slots = slots_for<Dim, drifts, Terms...>;
  for (std::size_t row = 0; row < batch.rows; ++row) {
    TermList<Dim, Terms...> terms(row_terms);
    ReadOwn const own{batch.records + (batch.begin + row) * batch.stride};
    for (std::size_t k = batch.first[row]; k < batch.first[row + 1]; k += Pack::size) {
      RecordsInRegisters<slots.stride()> const records(FourRecords(batch, k));
      terms.add(slots, own, ReadRegisters{records.columns}, KernelOfPairs<Dim>(batch, k));
    }
    terms.write(row_terms, batch.begin + row);
  }
}

template <int Dim, class... Terms>
constexpr std::array<LoopForSlots, 2> loops_in_place() {
  std::array<LoopForSlots, 2> made{};
  if constexpr (specialises) {
    made[0] = {slots_for<Dim, false, Terms...>, sum_in_place<Dim, false, Terms...>};
    if constexpr ((reads_state_velocity<Terms> || ...)) made[1] = {slots_for<Dim, true, Terms...>, sum_in_place<Dim, true, Terms...>};
  }
  return made;
}

template <int Dim, class Term>
constexpr TermLoops loops_of_term() {
  return {.sum = sum_anywhere<Dim, Term>, .components = Term::components, .made = loops_in_place<Dim, Term>()};
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
