#pragma once

#include <string_view>

#include "formulations/particles/field.hpp"
#include "formulations/basics/flag_set.hpp"
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
  radial     ///< (r_ij . grad_i W_ij) / r_ij^2 = W'(r)/r  [m^-(Dim+2)]
};
using KernelWeightSet = FlagSet<KernelWeight>;

enum class Invariant { momentum, energy };
using InvariantSet = FlagSet<Invariant>;

/// What a scheme says of itself; everything that the program lists, describes, allocates and checks comes
/// from here.
struct SchemeInfo {
  std::string_view id;
  std::string_view title;
  std::string_view source;    ///< citation with equation numbers
  std::string_view equation;  ///< in plain text, one line per pass
  std::string_view remarks;   ///< limits, and what is known of its behaviour
  Rate rate;
  FieldSet reads;             ///< besides position and mass
  KernelWeightSet kernel;     ///< what it reads of the kernel at a pair
  BoundaryValueSet boundary;  ///< what it reads at a wall, prescribed or closed
  BoundaryValueSet boundary_if_prescribed =
      {};                              ///< what it reads instead at a wall that prescribes flux only
  InvariantSet conserves = {};         ///< to round-off between particles
  FieldSet non_negative = {};          ///< fields of which a negative value leaves the scheme undefined
  bool two_pass = false;               ///< has a first pass, which computes the flux
  bool difference_form = false;        ///< its pair is a conductance, without T, times (T_i - T_j)
  std::string_view work_partner = {};  ///< of a momentum form: its default energy equation
  bool control = false;  ///< a yardstick beside the others: shown, never what a comparison recommends
};

}  // namespace sphverify
