// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "formulations/kernels/columns.hpp"
#include "formulations/particles/field.hpp"

// The sweep over pairs as plain data: what the files that are compiled once per instruction set share with
// the rest. No functions here but those that the compiler evaluates, so that none is compiled twice with different instructions.
namespace sphverify {

/// Where in a particle's record its fields lie, in doubles; -1 for those that nothing reads. The place comes
/// first, what depends on more than the fields that are read last: a loop made for its fields finds them in every plan
/// that reads just these.
struct RecordSlots {
  int m = -1, rho = -1, P = -1, T = -1, K = -1, c = -1;
  int per_rho = -1;  ///< 1/rho
  int v = -1;        ///< velocity with which the particle drifts, `Dim` doubles
  int F = -1;        ///< heat flux, `Dim` doubles
  int omega = -1;
  int pass_number = -1, pass_number_2 = -1;
  int pass_vector = -1;  ///< `Dim` doubles
  int pass_tensor = -1;  ///< its Dim(Dim + 1)/2 different elements
  int u = -1;        ///< velocity of the state, which viscosity rubs with; most often the same as v
  int h = -1;
  int used = 0;      ///< doubles in all

  /// Doubles from one record to the next: whole packs.
  constexpr std::size_t stride() const { return static_cast<std::size_t>(used + 3) / 4 * 4; }
};

/// @param reads fields beside position
/// @param own_lengths whether every particle has its own smoothing length
/// @param drifts whether what moves does so with other velocities than the state's
constexpr RecordSlots record_slots(FieldSet reads, int dimension, bool own_lengths, bool drifts) {
  RecordSlots slots;
  auto const take = [&slots](int size) {
    slots.used += size;
    return slots.used - size;
  };
  take(dimension);
  if (reads.contains(Field::mass)) slots.m = take(1);
  if (reads.contains(Field::density)) {
    slots.rho = take(1);
    slots.per_rho = take(1);
  }
  if (reads.contains(Field::pressure)) slots.P = take(1);
  if (reads.contains(Field::temperature)) slots.T = take(1);
  if (reads.contains(Field::conductivity)) slots.K = take(1);
  if (reads.contains(Field::sound_speed)) slots.c = take(1);
  if (reads.contains(Field::velocity)) slots.v = take(dimension);
  if (reads.contains(Field::flux)) slots.F = take(dimension);
  if (reads.contains(Field::omega)) slots.omega = take(1);
  if (reads.contains(Field::pass_number)) slots.pass_number = take(1);
  if (reads.contains(Field::pass_number_2)) slots.pass_number_2 = take(1);
  if (reads.contains(Field::pass_vector)) slots.pass_vector = take(dimension);
  if (reads.contains(Field::pass_tensor)) slots.pass_tensor = take(info(Field::pass_tensor).components(dimension));
  if (slots.v >= 0) slots.u = drifts ? take(dimension) : slots.v;
  if (own_lengths) slots.h = take(1);
  return slots;
}

/// Pairs of one particle after the other, side by side: what every term of a sweep reads. A row is filled up to whole packs
/// with pairs out of reach, which add nothing.
struct Batch {
  RecordSlots slots;
  std::size_t begin;             ///< the first particle
  std::size_t rows;              ///< how many particles
  std::size_t const* first;      ///< rows + 1: where in the columns each particle's pairs begin
  double const* records;         ///< of all particles
  std::size_t stride;            ///< from one to the next
  std::uint32_t const* neighbour;  ///< whose records they are
  double const* separation;      ///< component n of pair k's r_i - r_j is separation[n * capacity + k]; only if some term reads it
  double const* distance;        ///< r_ij  [m]
  double const* radial;          ///< W'(r)/r; only if some term reads the gradient or this
  double const* value;           ///< W; only if some term reads it
  double const* offset;          ///< as separation; only if some term reads it
  double const* radial_i;        ///< W'(r)/r with the particle's own h; only if some term reads the gradients of both
  double const* radial_j;        ///< the same with the neighbour's h; where all have one h both are `radial`
  double const* pair_h;          ///< (h_i + h_j)/2; null where all have one
  std::size_t capacity;          ///< pairs that a column holds
  double h;                      ///< the common smoothing length [m]
  double support_ratio;          ///< SweepPlan::support_ratio
};

/// What one sweep can hold.
inline constexpr std::size_t most_terms = 6;
inline constexpr std::size_t most_components = 6;

struct RowTerm;
/// Writes the sums of one term, or of several that follow each other, for all rows of a batch.
using BatchFunction = void (*)(Batch const& batch, RowTerm const* terms);

/// A loop that was made for records in which what it reads lies in certain places, known when it was compiled.
struct LoopForSlots {
  RecordSlots slots;  ///< of what it reads
  BatchFunction sum = nullptr;
};

/// The loops of a term over its pairs.
struct TermLoops {
  BatchFunction sum = nullptr;            ///< serves records of any kind; by this the term is known
  int components = 0;                     ///< numbers per particle that it writes
  std::array<LoopForSlots, 2> made{};  ///< faster; without and with a velocity of drift, if it reads the state's
  bool wants_value = false;               ///< reads W of the particles' kernel, whatever stands in place of its slopes
};

/// Terms that are often wanted together have a loop of their own, in which a neighbour's record is read once for all.
struct LoopOfSeveral {
  std::array<BatchFunction, 4> terms;  ///< null after the last
  std::array<LoopForSlots, 2> made;
};

/// A term of a sweep and where its sums go: `outputs` arrays of one number per particle.
struct RowTerm {
  TermLoops const* loops;
  void const* parameters;
  std::array<double*, most_components> outputs;
};

/// How separations are brought to their nearest periodic image.
enum class Wrapping { none, along_axes, turned };

/// A sweep over the rows of a neighbour list.
struct SweepPlan {
  double const* records;  ///< aligned to 32 bytes
  std::size_t stride;     ///< doubles per record, a multiple of 4
  RecordSlots slots;
  std::size_t const* first;
  std::uint32_t const* neighbour;
  double const* slope;  ///< NeighbourList::slope; null where the kernel gives it
  std::array<double const*, 3> offset;  ///< NeighbourList::offset; null unless some term reads it
  KernelColumns kernel;
  double support_ratio;  ///< beyond it in h nothing rubs; where slopes are stored all pairs do
  double h;             ///< the common smoothing length, where slots.h < 0
  Wrapping wrapping;
  std::array<double, 3> period;          ///< 0 along axes that are not periodic
  std::array<double, 3> inverse_period;  ///< likewise
  std::array<double, 9> axes;            ///< the box's axes, one after the other
  bool wants_separation;
  bool wants_radial;
  bool wants_value;
  bool wants_own_radial;  ///< with the h of each, where slots.h >= 0
  RowTerm const* terms;
  BatchFunction const* loops;      ///< one after the other on each batch
  std::size_t const* loop_terms;   ///< at which term each begins
  std::size_t loop_count;
};

inline constexpr std::size_t most_passes = 4;

/// What a scheme has of its own.
struct SchemeLoops {
  std::array<TermLoops, most_passes> passes;  ///< that of the rate last, then empty ones
  /// Per pair of a batch its conductance, for conduction that is linear on particles at rest; null for other forms.
  void (*conductance)(Batch const& batch, double* conductance);
};

/// The loops over pairs in one dimension that belong to no scheme, compiled for one instruction set.
struct SweepLoops {
  char const* instruction_set;
  /// Rows begin to end of a plan. @param scratch scratch_size() doubles, aligned to 32 bytes
  void (*rows)(SweepPlan const& plan, std::size_t begin, std::size_t end, std::size_t capacity, double* scratch);
  std::span<LoopOfSeveral const> of_several;
  TermLoops density;    ///< sum_j m_j W_ij, the particle itself left out
  TermLoops viscosity;  ///< parameters: MonaghanViscosity; acceleration, heating, largest |mu|
  TermLoops riemann_viscosity;  ///< the same of a RiemannViscosity
  TermLoops approach;   ///< largest rate_of_approach()
  void (*conductances)(SweepPlan const& plan, void (*of_batch)(Batch const&, double*), std::size_t begin, std::size_t end,
                       std::size_t capacity, double* scratch, double* out);
  /// rate_i = sum_j c_ij (T_i - T_j) for rows begin to end.
  void (*conduct)(std::size_t const* first, std::uint32_t const* neighbour, double const* conductance,
                  double const* temperature, std::size_t begin, std::size_t end, double* rate);
};

/// Rows that a batch holds at most, and pairs that it holds at least.
inline constexpr std::size_t batch_rows = 64;
inline constexpr std::size_t batch_pairs = 264;  // no power of two: columns would share lines of a cache

/// Doubles of scratch memory for batches of so many pairs.
constexpr std::size_t scratch_size(std::size_t capacity) { return 16 * capacity; }

}  // namespace sphverify
