// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <initializer_list>
#include <string_view>
#include <tuple>

#include "formulations/particles/field.hpp"
#include "formulations/basics/flag_set.hpp"
#include "formulations/neighbours/pair_support.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// What a scheme computes, and so what it is compared with.
enum class Rate {
  acceleration,        ///< dv/dt, a vector  [m/s^2]
  internal_work,       ///< de/dt of compression  [W/kg]
  total_work,          ///< d(e + v^2/2)/dt of pressure forces  [W/kg]
  conduction_heating,  ///< de/dt of heat conduction  [W/kg]
  density              ///< drho/dt  [kg/(m^Dim s)]; no formulation of its own, see ContinuityDensity
};

/// What a scheme reads of the kernel at a pair.
enum class KernelWeight {
  gradient,  ///< grad_i W_ij, a vector  [m^-(Dim+1)]
  radial,    ///< (r_ij . grad_i W_ij) / r_ij^2 = W'(r)/r  [m^-(Dim+2)]
  value,     ///< W_ij, a number  [m^-Dim]
  face_offset,  ///< from (r_i + r_j)/2 to the centroid of the face between i and j, a vector; of Voronoi pair weights alone  [m]
  own_gradients  ///< grad_i W(r_ij, h_i) and grad_i W(r_ij, h_j), not by the pair's mean h  [m^-(Dim+1)]
};
using KernelWeightSet = FlagSet<KernelWeight>;

/// The field that a rate is written to.
constexpr Field output_field(Rate rate) {
  return rate == Rate::acceleration ? Field::acceleration
         : rate == Rate::density    ? Field::density_rate
                                    : Field::heating;
}

/// A pass over all pairs and walls before that of the rate: what it computes for every particle, and from what.
struct PassInfo {
  std::string_view name;    ///< as records name what ran
  Field writes;             ///< a number, a vector or a symmetric tensor; `pass_...` where no field has its meaning
  FieldSet reads;           ///< besides position, mass and what passes before it have written
  KernelWeightSet kernel;   ///< what it reads of the kernel at a pair
  BoundaryValueSet boundary = {};  ///< what it reads at a wall, prescribed or closed
  bool normalised = false;         ///< it divides by i.Gamma(), which is the kernel's alone
};

/// The passes before that of the rate, in their order.
class FirstPasses {
 public:
  static constexpr std::size_t most = 3;

  constexpr FirstPasses() = default;
  constexpr FirstPasses(std::initializer_list<PassInfo> passes) {
    for (PassInfo const& pass : passes) passes_[size_++] = pass;
  }
  constexpr PassInfo const* begin() const { return passes_.data(); }
  constexpr PassInfo const* end() const { return passes_.data() + size_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr FieldSet writes() const {
    FieldSet written;
    for (PassInfo const& pass : *this) written.insert(pass.writes);
    return written;
  }

 private:
  std::array<PassInfo, most> passes_{};
  std::size_t size_ = 0;
};

enum class Invariant { momentum, energy };
using InvariantSet = FlagSet<Invariant>;

/// The mean of two particles' conductivities by which a pair conducts.
enum class ConductivityMean { unknown, arithmetic, harmonic, geometric };

/// What a scheme says of its behaviour beside what it conserves. `sphverify claims` and the contract tests hold it to this;
/// what is not claimed is no failure.
struct Claims {
  /// On a lattice, far from walls, fields that are linear give the derivative times so many powers of the lattice's own
  /// factor D = -sum_j V (x_i - x_j) dW_ij/dx_i; -1: one for each pass that reads the kernel's
  /// gradient; 0: it is exact.
  int lattice_factors = -1;
  bool steady_on_any_particles = false;  ///< a uniform state has rate zero wherever the particles are
  bool galilean_invariant = true;        ///< a common velocity changes no rate
  bool continuous_at_support = true;     ///< what a neighbour adds tends to zero as it leaves the support
  bool energy_with_partner = false;  ///< a momentum form and its `work_partner` conserve energy together, to round-off
  bool linear_on_lattice = true;         ///< the first of these is claimed at all
  ConductivityMean mean = ConductivityMean::unknown;  ///< of a form of heat conduction that has one
};

/// What a scheme says of itself; everything that the program lists, describes, allocates and checks comes
/// from here.
struct SchemeInfo {
  std::string_view id;
  std::string_view title;
  std::string_view source;    ///< citation with equation numbers
  std::string_view equation;  ///< in plain text, one line per pass
  std::string_view remarks;   ///< limits, and what is known of its behaviour
  Rate rate;
  FieldSet reads;             ///< besides position, mass and what its first passes write
  KernelWeightSet kernel;     ///< what it reads of the kernel at a pair
  BoundaryValueSet boundary;  ///< what it reads at a wall, prescribed or closed
  BoundaryValueSet boundary_if_prescribed =
      {};                              ///< what it reads instead at a wall that prescribes flux only
  InvariantSet conserves = {};         ///< to round-off between particles
  FieldSet non_negative = {};          ///< fields of which a negative value leaves the scheme undefined
  FirstPasses first_passes = {};       ///< what is summed before the rate; `passes` has their code
  bool difference_form = false;        ///< its pair is a conductance, without T, times (T_i - T_j)
  std::string_view work_partner = {};  ///< of a momentum form: its default energy equation
  Claims claims = {};
  int supports_seen = 0;  ///< how far it sees, in supports of the kernel; 0: as many as it has passes
  bool control = false;  ///< a yardstick beside the others: shown, never what a comparison recommends
  /// What its wall terms give is what crosses the wall. Where they are differences, or weights that are no flux, they are no
  /// more than a part of it: then what crosses a wall is known by the flux that it prescribes alone.
  bool wall_terms_are_exchange = true;
  /// Of a momentum form: how much of the stress that its wall term pushes with is P_B. The rest is the gas's own pressure, to which
  /// the gas's own viscous stress belongs.
  double wall_pressure_share = 0.5;
  bool least_squares = false;   ///< its `W.radial()` are not the kernel's but QuadraticWeights
  bool needs_partners = false;  ///< TooFewPartners where a particle sees too few others, or all of them in one direction
};

/// Its own pass and those before it.
constexpr int pass_count(SchemeInfo const& scheme) { return static_cast<int>(scheme.first_passes.size()) + 1; }

/// How far a scheme sees, in supports of the kernel: each pass adds one.
constexpr int supports_seen(SchemeInfo const& scheme) {
  return scheme.supports_seen > 0 ? scheme.supports_seen : pass_count(scheme);
}

/// All fields that a scheme reads and does not write itself.
constexpr FieldSet fields_read(SchemeInfo const& scheme) {
  FieldSet fields = scheme.reads;
  for (PassInfo const& pass : scheme.first_passes) fields = fields | pass.reads;
  return fields;
}

/// All that it reads at walls.
constexpr BoundaryValueSet wall_values_read(SchemeInfo const& scheme) {
  BoundaryValueSet values = scheme.boundary | scheme.boundary_if_prescribed;
  for (PassInfo const& pass : scheme.first_passes) values = values | pass.boundary;
  return values;
}

/// All fields that a scheme needs allocated.
constexpr FieldSet needed_fields(SchemeInfo const& scheme) {
  return fields_read(scheme) | scheme.first_passes.writes() | FieldSet{output_field(scheme.rate)};
}

/// The code of the passes before that of the rate. A pass is a struct with its `info`, what a neighbour adds, `pair(i, j, W)`,
/// what a wall adds, `wall(i, B)`, and, if its sum is not what it writes yet, `finish(i, sum)`.
template <class... Passes>
using PassList = std::tuple<Passes...>;

template <class Scheme>
struct PassesOf {
  using type = std::tuple<>;
};
template <class Scheme>
  requires requires { typename Scheme::passes; }
struct PassesOf<Scheme> {
  using type = typename Scheme::passes;
};

/// Whether it reads a field that only first passes write without naming it among what they write: it would find what another
/// scheme has left there.
constexpr bool reads_what_nobody_wrote(SchemeInfo const& scheme) {
  for (FieldInfo const& field : field_infos) {
    if (pass_fields.contains(field.field) && fields_read(scheme).contains(field.field)) return true;
  }
  return false;
}

/// All that it reads of the kernel.
constexpr KernelWeightSet kernel_read(SchemeInfo const& scheme) {
  KernelWeightSet kernel = scheme.kernel;
  for (PassInfo const& pass : scheme.first_passes) kernel = kernel | pass.kernel;
  return kernel;
}

/// Which pairs it sees where particles have smoothing lengths of their own.
constexpr PairSupport pair_support(SchemeInfo const& scheme) {
  return kernel_read(scheme).contains(KernelWeight::own_gradients) ? PairSupport::larger : PairSupport::mean;
}

/// How many of its passes differentiate, that of its rate among them.
constexpr int derivatives_taken(SchemeInfo const& scheme) {
  auto const of = [](KernelWeightSet kernel) {
    return kernel.contains(KernelWeight::gradient) || kernel.contains(KernelWeight::radial) ||
                   kernel.contains(KernelWeight::own_gradients)
               ? 1
               : 0;
  };
  int count = of(scheme.kernel);
  for (PassInfo const& pass : scheme.first_passes) count += of(pass.kernel);
  return count;
}

/// The fields of particles from which closures take the wall values that a wall does not prescribe (fill_boundary_values).
/// A gas has density, pressure and velocity anyway, which those closures read that take one of these from the others.
constexpr FieldSet closure_fields(BoundaryValueSet values) {
  FieldSet fields;
  if (values.contains(BoundaryValue::pressure)) fields.insert(Field::pressure);
  if (values.contains(BoundaryValue::velocity)) fields.insert(Field::velocity);
  if (values.contains(BoundaryValue::temperature) || values.contains(BoundaryValue::flux))
    fields = fields | FieldSet{Field::temperature, Field::conductivity};
  if (values.contains(BoundaryValue::conductivity)) fields.insert(Field::conductivity);
  return fields;
}

/// Whether closures find all that they need of particles among what it reads and writes.
constexpr bool feeds_its_closures(SchemeInfo const& scheme) {
  FieldSet const known = fields_read(scheme) | scheme.first_passes.writes();
  BoundaryValueSet closed = scheme.boundary;
  for (PassInfo const& pass : scheme.first_passes) closed = closed | pass.boundary;
  return known.contains(closure_fields(wall_values_read(scheme))) &&
         (!closed.contains(BoundaryValue::flux) || known.contains(Field::flux));
}

/// Why it cannot take pair weights that are given instead of the kernel's; empty if it can.
constexpr std::string_view why_no_pair_weights(SchemeInfo const& scheme) {
  if (scheme.least_squares) return "brings pair weights of its own along";
  for (PassInfo const& pass : scheme.first_passes) {
    if (pass.normalised) return "divides by the part of the kernel inside the fluid, which Voronoi pair weights do not have";
  }
  KernelWeightSet const kernel = kernel_read(scheme);
  if (kernel.contains(KernelWeight::own_gradients))
    return "reads the kernel by each particle's own smoothing length, which Voronoi pair weights do not have";
  return kernel.contains(KernelWeight::value) ? "reads the kernel's value, which Voronoi pair weights do not have" : "";
}

/// Whether a pass of it reads where the faces between particles have their centroids, which cells have and kernels have not.
constexpr bool reads_face_offsets(SchemeInfo const& scheme) {
  bool reads = scheme.kernel.contains(KernelWeight::face_offset);
  for (PassInfo const& pass : scheme.first_passes) reads = reads || pass.kernel.contains(KernelWeight::face_offset);
  return reads;
}

/// Why it cannot take the kernel's pair weights; empty if it can.
constexpr std::string_view why_no_kernel_weights(SchemeInfo const& scheme) {
  return reads_face_offsets(scheme) ? "pushes through faces of cells, which a kernel does not have: take pair weight voronoi" : "";
}

/// What can be listed and swept as a scheme: a struct with a constexpr `info`; with `pair(i, j, W)` and `wall(i, B)`; and, in
/// `passes`, the code of the first passes that its `info` names.
template <class Type>
concept HasSchemeInfo = requires {
  { Type::info } -> std::convertible_to<SchemeInfo const&>;
};
template <class Type>
concept HasItsFirstPasses = std::tuple_size_v<typename PassesOf<Type>::type> == Type::info.first_passes.size();
template <class Type>
concept ReadsWhatIsWritten = !reads_what_nobody_wrote(Type::info);
template <class Type>
concept FeedsItsClosures = feeds_its_closures(Type::info);
template <class Type>
concept IsScheme = HasSchemeInfo<Type> && HasItsFirstPasses<Type> && ReadsWhatIsWritten<Type> && FeedsItsClosures<Type>;

/// All passes of a scheme; its own, which makes the rate, is the last.
template <class Scheme>
using AllPasses =
    decltype(std::tuple_cat(std::declval<typename PassesOf<Scheme>::type>(), std::declval<std::tuple<Scheme>>()));

template <class Pass>
inline constexpr bool is_scheme = std::is_same_v<std::remove_cvref_t<decltype(Pass::info)>, SchemeInfo>;

/// The field that a pass writes.
template <class Pass>
constexpr Field output_of() {
  if constexpr (is_scheme<Pass>) {
    return output_field(Pass::info.rate);
  } else {
    return Pass::info.writes;
  }
}

/// What pass n of a scheme may read of a particle, besides its position.
template <class Scheme, std::size_t n>
constexpr FieldSet reads_of_pass() {
  using Pass = std::tuple_element_t<n, AllPasses<Scheme>>;
  FieldSet reads = Pass::info.reads | FieldSet{Field::mass};
  for (std::size_t k = 0; k < n; ++k) reads.insert(Scheme::info.first_passes.begin()[k].writes);
  return reads;
}

}  // namespace sphverify
