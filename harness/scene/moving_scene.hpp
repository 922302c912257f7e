// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/viscosity/viscosity.hpp"
#include "harness/integrate/ode.hpp"
#include "harness/scene/cut_cells.hpp"
#include "harness/scene/moving_geometry.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// The numbers of a run have left the realm in which it makes sense to go on.
class BrokenRun : public RateFailure {
 public:
  BrokenRun(std::string status, std::string const& reason)
      : RateFailure(reason), status_(std::move(status)) {}
  std::string const& status() const { return status_; }  ///< as in the results document

 private:
  std::string status_;
};

/// What limits an explicit step, and how long a step it allows [s].
struct StepLimit {
  std::string_view name;
  double step;
};

/// What crosses one wall per time: in the scheme, and by what the wall prescribes (or the closure in its
/// place).
template <int Dim>
struct WallExchange {
  Vector<Dim> force = Vector<Dim>::Zero();             ///< on the gas [N]
  Vector<Dim> prescribed_force = Vector<Dim>::Zero();  ///< -P_B n area
  double power = 0.0;                                  ///< work and heat [W]
  double prescribed_power = 0.0;                       ///< -P_B v_B.n area, and heat
  double heat = 0.0;                                   ///< of the power, by conduction
};

/// Particles of a gas that move between walls, set up for one formulation (momentum form, work, perhaps
/// conduction) on one problem, as an ordinary differential equation. Its unknowns: positions and velocities
/// component by component, internal (or internal plus kinetic) energies per mass, densities where they obey
/// the continuity equation, and the displacements of the walls that go with the gas.
///
/// The gas obeys P = (gamma - 1) rho e and T = e (specific heat 1).
template <int Dim>
class MovingScene {
 public:
  /// Throws std::invalid_argument when the particles or walls make no sense.
  MovingScene(Problem<Dim> problem, SceneChoice const& choice);

  std::size_t unknowns() const;
  std::size_t coordinates() const { return Dim * particles_.size(); }
  std::vector<double> initial_state();

  /// Sizes of typical unknowns, in their order.
  std::vector<double> scales() const;

  /// Brings everything to a state: fields, geometry, rates. Throws BrokenRun.
  /// @param drift velocities with which the gas and its walls move, component by component, if not the
  /// state's own
  void evaluate(double time, double const* state, double const* drift = nullptr);

  /// The rates of what follows the places once more, where `evaluate` was last, with other velocities of the drift: work,
  /// continuity, the speeds of walls, and heat conduction with the energies of a state. Forces, the pressures that do work,
  /// neighbours and contacts are as `evaluate` left them, and so is what viscosity and sources heat.
  void drift(double const* state, double const* velocities);

  /// What an unknown's rate is a rate of, in words: "acceleration of particle 7".
  std::string rate_name(std::size_t unknown) const;

  /// Of the last evaluated state.
  void rates(double* out) const;
  /// Those of them that follow the places: of energies, densities and walls.
  void drift_rates(double* out) const;
  std::vector<StepLimit> step_limits() const;
  /// Who runs into whom fastest, in words; empty if nothing approaches.
  std::string closest_approach() const;
  std::vector<WallExchange<Dim>> wall_exchange() const;
  /// Whether what crosses the walls as heat is known (SchemeInfo::wall_terms_are_exchange); where not, `heat` is 0.
  bool heat_exchange_is_known() const;
  bool wall_terms_are_exchange() const { return !conduction_operator_ || conduction_operator_->info().wall_terms_are_exchange; }
  Vector<Dim> source_force() const;
  double source_power() const;
  Vector<Dim> force() const;  ///< of everything together: d/dt sum m v
  double power() const;       ///< of everything together: d/dt sum m (e + v^2/2)

  Vector<Dim> momentum() const;
  double energy() const;  ///< internal and kinetic
  /// The same of any state, which is not evaluated.
  Vector<Dim> momentum(double const* state) const;
  double energy(double const* state) const;

  Problem<Dim> const& problem() const { return problem_; }
  Particles<Dim> const& particles() const { return particles_; }
  std::vector<Wall<Dim>> const& walls() const { return walls_; }  ///< where they stand now
  PairGeometry<Dim> const& geometry() const { return geometry_.geometry(); }
  double spacing() const { return spacing_; }
  int threads() const { return threads_; }

  /// Volume between the walls, less the sum of m/rho over it; empty where a side has neither wall nor image.
  std::optional<double> volume_defect() const;

  /// Evaluations of the whole rate, whatever its parts; of `drift` only pairs and contacts.
  WorkCount work() const;
  SceneRecord record() const;
  /// Of all that it keeps, and of the records that the sweep of its forces packs.
  /// @param drifts whether it is evaluated with velocities of the drift that are not the state's
  std::size_t bytes(bool drifts) const;

 private:
  bool has_continuity() const { return density_rule_ == DensityRule::continuity; }
  bool read_face_offsets() const {
    auto const reads = [](auto const& one) { return one && reads_face_offsets(one->info()); };
    return reads(momentum_operator_) || reads(work_operator_) || reads(conduction_operator_);
  }
  bool evolves_total_energy() const { return work_operator_->info().rate == Rate::total_work; }
  void place_particles(SceneChoice const& choice);
  void load(double const* state);
  void load_energy(double const* state, std::vector<double>& e) const;
  void place_walls(double time, double const* displacements);
  void require_order(double time) const;
  double conduction_step(std::size_t i) const;
  double cells_step() const;
  double largest_approach() const;
  double viscous_step_of_weights(std::size_t i, double largest_mu) const;
  void find_geometry(double time);
  void set_gas(double time);
  void set_conductivity();
  void fill_walls(BoundaryValue value, double time);
  template <class Body>
  void may_break(double time, Body const& body) const;
  bool run_first_passes(std::vector<RateOperator<Dim>*> const& together, double time);
  void evaluate_together(std::vector<RateOperator<Dim>*> const& together, bool with_viscosity, bool drifts, double time);
  void conduct(double time);
  void evaluate_forces(double time, bool drifts);
  void add_other_heating(double time);
  void find_wall_speeds(double time);

  Vector<Dim> velocity_in(double const* state, std::size_t i) const;

  /// zero + sum of m_i term(i) over all particles.
  template <class Value, class Term>
  Value mass_sum(Value const& zero, Term const& term) const;

  /// Mean of value(contact) weighted by the face that each contact stands for.
  template <class Value>
  double face_mean(WallContacts<Dim> const& contacts, Value const& value) const;

  Problem<Dim> problem_;
  std::unique_ptr<RateOperator<Dim>> momentum_operator_, work_operator_, conduction_operator_,
      continuity_operator_;
  Viscosity viscosity_;
  DensityRule density_rule_;
  Closure closure_;
  WallMotion wall_motion_;
  bool adaptive_;
  bool with_walls_;
  double spacing_ = 0.0;
  int threads_;

  Particles<Dim> particles_;
  std::vector<Wall<Dim>> walls_;
  std::vector<std::size_t> free_walls_;  ///< those that go with the gas
  std::vector<Vector<Dim>> wall_start_;
  std::vector<std::size_t> order_;  ///< particles along the axis, in 1D: they must not cross
  MovingGeometry<Dim> geometry_;

  VectorField<Dim> drift_;               ///< velocities of the last evaluation's motion
  VectorField<Dim> acceleration_;        ///< with viscosity and body force
  std::vector<double> energy_rate_;      ///< of what the run evolves
  std::vector<CutCell<Dim>> cut_cells_;  ///< by jumps of the initial state
  ViscousRates<Dim> viscous_;
  std::vector<double> conduction_wall_power_;
  std::vector<double> wall_speed_;  ///< along the outward normal, of the free walls
  double time_ = 0.0;
  std::uint64_t evaluations_ = 0;
  WorkCount work_;  ///< of the schemes, each evaluated by itself
  std::map<std::string_view, std::uint64_t> passes_;
};

template <int Dim>
Vector<Dim> MovingScene<Dim>::velocity_in(double const* state, std::size_t i) const {
  Vector<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = state[(Dim + k) * particles_.size() + i];
  return v;
}

template <int Dim>
template <class Value>
double MovingScene<Dim>::face_mean(WallContacts<Dim> const& contacts, Value const& value) const {
  Vector<2> const none = Vector<2>::Zero();
  Vector<2> const sum = sum_of_rows(contacts.size(), threads_, none, [&](std::size_t c) -> Vector<2> {
    std::uint32_t const i = contacts.particle[c];
    double const face =
        particles_.masses()[i] / particles_.scalar(Field::density)[i] * contacts.face_weight[c];
    return {face * value(c), face};
  });
  return sum[1] != 0.0 ? sum[0] / sum[1] : 0.0;
}

extern template class MovingScene<1>;
extern template class MovingScene<2>;
extern template class MovingScene<3>;

}  // namespace sphverify
