// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "formulations/basics/undefined_rate.hpp"
#include "formulations/pair_geometry.hpp"
#include "formulations/scheme.hpp"
#include "formulations/sweep/pair_sweep.hpp"

namespace sphverify {

/// Counted work, beside the clock.
struct WorkCount {
  std::uint64_t evaluations = 0;        ///< of the whole rate, all its passes together
  std::uint64_t pair_interactions = 0;  ///< directed pairs visited, summed over passes
  std::uint64_t wall_interactions = 0;  ///< contacts visited, summed over passes
};

/// One scheme in one dimension behind a common face; the identifier is resolved once, the pair loop is
/// compiled for the scheme. Reads `info().reads`, writes the fields of its passes and of its rate.
template <int Dim>
class RateOperator {
 public:
  virtual ~RateOperator() = default;

  virtual SchemeInfo const& info() const = 0;

  /// Evaluates the rate of all particles at a time (which walls may depend on).
  /// Throws UndefinedRate.
  void evaluate(Particles<Dim>& particles, PairGeometry<Dim>& geometry, Closure closure, double time,
                int threads, WorkCount& work);

  /// The parts of `evaluate`, for sweeps that several operators share: for every pass, `begin_pass` of all of
  /// them, the sweep, `end_pass` of all of them.
  int passes() const { return pass_count(info()); }
  /// Two schemes of one type of first passes have the same code in them.
  virtual std::type_info const& first_passes() const { return typeid(PassList<>); }
  /// Fills the boundary values and adds the pass's term.
  /// Throws UndefinedRate.
  virtual void begin_pass(int pass, Particles<Dim>& particles, PairGeometry<Dim>& geometry, Closure closure,
                          double time, int threads, PairSweep<Dim>& sweep) = 0;
  /// Adds the wall terms.
  virtual void end_pass(int pass, Particles<Dim>& particles, PairGeometry<Dim> const& geometry,
                        WorkCount& work) = 0;

  /// Promises that from now on nothing changes but temperatures: where the form is linear in these its pairs
  /// and its first passes are computed once. Does nothing for forms that are not. Throws UndefinedRate.
  virtual void freeze(Particles<Dim>& particles, PairGeometry<Dim>& geometry, int threads) = 0;
  virtual std::size_t bytes() const = 0;

  /// Sum over particles of m_i times the wall's part of the rate in the last evaluation, per wall: the power
  /// [W] of heating and work, or the force [N] along x, y, z of an acceleration.
  virtual std::vector<Vector<Dim>> const& wall_force() const = 0;
  virtual std::vector<double> const& wall_power() const = 0;

  /// The wall's part of an acceleration in the last evaluation, per wall and contact.
  virtual std::vector<std::vector<Vector<Dim>>> const& wall_acceleration() const = 0;
};

/// A scheme as a program knows it. scheme_part<Scheme>() of scheme_operator.hpp makes it of a header.
struct SchemePart {
  SchemeInfo const* info;
  std::function<std::unique_ptr<RateOperator<1>>()> in_1d;
  std::function<std::unique_ptr<RateOperator<2>>()> in_2d;
  std::function<std::unique_ptr<RateOperator<3>>()> in_3d;

  template <int Dim>
  std::unique_ptr<RateOperator<Dim>> make() const {
    if constexpr (Dim == 1) return in_1d();
    if constexpr (Dim == 2) return in_2d();
    if constexpr (Dim == 3) return in_3d();
  }
};

/// Adds a scheme to those of AllSchemes, before anything else is asked of them. Throws std::invalid_argument if there is one
/// of that identifier.
void add_scheme(SchemePart const& part);

/// Those of AllSchemes in its order, then those that were added.
std::vector<SchemePart> const& all_scheme_parts();
std::vector<SchemeInfo const*> all_scheme_infos();

/// Null if there is none of that identifier.
SchemeInfo const* find_scheme(std::string_view id);

/// Throws std::invalid_argument for an unknown identifier.
template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_rate_operator(std::string_view id);

/// The continuity equation, which is none of the compared schemes.
template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_continuity_operator();

}  // namespace sphverify
