#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "formulations/particles/field.hpp"

// The sweep over pairs as plain data: what the files that are compiled once per instruction set share with
// the rest. No functions here, so that none is compiled twice with different instructions.
namespace sphverify {

/// Where in a particle's record its fields lie, in doubles; -1 for those that nothing reads. The place comes
/// first.
struct RecordSlots {
  int m = -1, rho = -1, P = -1, T = -1, K = -1, c = -1, h = -1;
  int per_rho = -1;  ///< 1/rho
  int v = -1;        ///< velocity with which the particle drifts, `Dim` doubles
  int u = -1;        ///< velocity of the state, which viscosity rubs with; most often the same
  int F = -1;        ///< heat flux, `Dim` doubles
  int omega = -1;
  int pass_number = -1, pass_number_2 = -1;
  int pass_vector = -1;  ///< `Dim` doubles
  int pass_tensor = -1;  ///< its Dim(Dim + 1)/2 different elements
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
  if (own_lengths) slots.h = take(1);
  if (reads.contains(Field::velocity)) {
    slots.v = take(dimension);
    slots.u = drifts ? take(dimension) : slots.v;
  }
  if (reads.contains(Field::flux)) slots.F = take(dimension);
  if (reads.contains(Field::omega)) slots.omega = take(1);
  if (reads.contains(Field::pass_number)) slots.pass_number = take(1);
  if (reads.contains(Field::pass_number_2)) slots.pass_number_2 = take(1);
  if (reads.contains(Field::pass_vector)) slots.pass_vector = take(dimension);
  if (reads.contains(Field::pass_tensor)) slots.pass_tensor = take(info(Field::pass_tensor).components(dimension));
  return slots;
}

/// How many neighbours are looked at together; longer rows come in parts.
inline constexpr std::size_t part_size = 128;

/// Neighbours of one particle, or a part of them, copied side by side: what the formulas of all terms of a
/// sweep read.
struct Row {
  RecordSlots slots;
  double const* own;      ///< the particle's record
  double const* columns;  ///< field s of neighbour k is columns[s * part_size + k]; in place of x: x_i - x_j,
                          ///< if some term wants it
  double const* distance;  ///< r_ij  [m]
  double const* radial;    ///< W'(r)/r; only if some term reads the gradient or this
  double const* value;     ///< W; only if some term reads it
  double const* offset;    ///< component n of neighbour k's is offset[n * part_size + k]; only if some term reads it
  double const* radial_i;  ///< W'(r)/r with the particle's own h; only if some term reads the gradients of both
  double const* radial_j;  ///< the same with the neighbour's h; where all have one h both are `radial`
  std::size_t count;       ///< neighbours, filled up to whole packs with ones out of reach
  double h;                ///< the particle's own smoothing length [m]
};

/// What one sweep can hold.
inline constexpr std::size_t most_terms = 6;
inline constexpr std::size_t most_components = 6;

/// Adds a term's sum over a row to as many numbers as the term has components.
using RowFunction = void (*)(Row const& row, void const* parameters, double* sums);

/// A term of a sweep and where its sums go: `outputs` arrays of one number per particle.
struct RowTerm {
  RowFunction sum;
  void const* parameters;
  int components;
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
  std::size_t term_count;
};

inline constexpr std::size_t most_passes = 4;

/// What a scheme has of its own, whatever the kernel.
struct SchemeLoops {
  std::array<RowFunction, most_passes> passes;  ///< that of the rate last, then null
  /// Per pair of a row its conductance, for conduction that is linear on particles at rest; null for other forms.
  void (*conductance)(Row const& row, double* conductance);
};

/// Sweeps of terms that are often wanted together have a loop of their own, in which a neighbour goes from
/// its record into all terms without being copied in between. Serves plans without own smoothing lengths and
/// turned boxes.
struct FusedSweep {
  std::array<RowFunction, 4> terms;  ///< null after the last
  FieldSet reads;                    ///< of all of them
  bool reads_state_velocity;         ///< serves plans with drift too
  void (*rows)(SweepPlan const& plan, std::size_t begin, std::size_t end);
};
/// One that lies elsewhere than with its kernel.
struct FusedWithKernel {
  std::string_view kernel;
  FusedSweep sweep;
};

/// The loops over pairs of a kernel in one dimension, compiled for one instruction set.
struct SweepKernels {
  char const* instruction_set;
  /// Rows begin to end of a plan. @param scratch scratch_size(stride) doubles, aligned to 32 bytes
  void (*rows)(SweepPlan const& plan, std::size_t begin, std::size_t end, double* scratch);
  std::span<FusedSweep const> fused;
  RowFunction density;    ///< sum_j m_j W(r_ij, h_i), the particle itself left out
  RowFunction viscosity;  ///< parameters: MonaghanViscosity; acceleration, heating, largest |mu|
  RowFunction riemann_viscosity;  ///< the same of a RiemannViscosity
  RowFunction approach;   ///< largest rate_of_approach()
  void (*conductances)(SweepPlan const& plan, void (*of_row)(Row const&, double*), std::size_t begin,
                       std::size_t end, double* scratch, double* out);
  /// rate_i = sum_j c_ij (T_i - T_j) for rows begin to end.
  void (*conduct)(std::size_t const* first, std::uint32_t const* neighbour, double const* conductance,
                  double const* temperature, std::size_t begin, std::size_t end, double* rate);
};

/// Doubles of scratch memory that a plan's rows need.
constexpr std::size_t scratch_size(std::size_t stride) { return (stride + 9) * part_size; }

}  // namespace sphverify
