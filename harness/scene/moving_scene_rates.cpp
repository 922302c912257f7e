// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/walls/wall_out_of_reach.hpp"

// What drives the gas: a state put in, where that leaves walls and neighbours, and the rates there.

namespace sphverify {

namespace {

void copy(double const* from, std::size_t count, int threads, double* to) {
  for_each_block(count, threads, [&](std::size_t begin, std::size_t end) { std::copy(from + begin, from + end, to + begin); });
}

template <int Dim>
void copy_into(VectorField<Dim>& field, double const* state, int threads) {
  for (int k = 0; k < Dim; ++k) {
    copy(state, field.size(), threads, field.component(k).data());
    state += field.size();
  }
}

}  // namespace

template <int Dim>
void MovingScene<Dim>::evaluate(double time, double const* state, double const* drift) {
  time_ = time;
  ++evaluations_;
  load(state);
  copy_into(drift_, drift ? drift : state + coordinates(), threads_);
  place_walls(time, state + unknowns() - free_walls_.size());
  require_order(time);
  find_geometry(time);
  set_gas(time);
  evaluate_forces(time, drift != nullptr);
  add_other_heating(time);
  find_wall_speeds(time);
}

template <int Dim>
void MovingScene<Dim>::drift(double const* state, double const* velocities) {
  copy_into(drift_, velocities, threads_);
  std::swap(particles_.vector(Field::velocity), drift_);
  fill_walls(BoundaryValue::velocity, time_);
  std::vector<RateOperator<Dim>*> together{work_operator_.get()};
  if (continuity_operator_) together.push_back(continuity_operator_.get());
  may_break(time_, [&] {
    evaluate_together(together, false, false, time_);
    if (conduction_operator_) {
      // Conduction relaxes: with the temperatures that were predicted it would be stable in half as long steps.
      load_energy(state, particles_.scalar(Field::temperature));
      set_conductivity();
      conduct(time_);
    }
  });
  std::swap(particles_.vector(Field::velocity), drift_);
  add_other_heating(time_);
  find_wall_speeds(time_);
}

/// The internal energies of a state.
template <int Dim>
void MovingScene<Dim>::load_energy(double const* state, std::vector<double>& e) const {
  double const* const evolved = state + 2 * coordinates();
  if (!evolves_total_energy()) return copy(evolved, e.size(), threads_, e.data());
  for_each_row(e.size(), threads_, [&](std::size_t i) { e[i] = evolved[i] - 0.5 * velocity_in(state, i).squaredNorm(); });
}

template <int Dim>
void MovingScene<Dim>::load(double const* state) {
  expects(!problem_.domain.is_turned());  // places are wrapped along the axes of space
  std::size_t const n = particles_.size();
  auto& x = particles_.positions();
  copy_into(x, state, threads_);
  for (int k = 0; k < Dim; ++k) {
    if (!problem_.domain.periodic[k]) continue;
    double const lower = problem_.domain.lower[k];
    double const period = problem_.domain.upper[k] - lower;
    auto& along = x.component(k);
    for_each_row(n, threads_,
                 [&](std::size_t i) { along[i] -= period * std::floor((along[i] - lower) / period); });
  }
  copy_into(particles_.vector(Field::velocity), state + Dim * n, threads_);
  load_energy(state, particles_.scalar(Field::internal_energy));
  if (!has_continuity()) return;
  double const* const density = state + 2 * Dim * n + n;
  copy(density, n, threads_, particles_.scalar(Field::density).data());
  if (auto const lost = first_row(n, threads_, [&](std::size_t i) { return !(density[i] > 0.0); })) {
    throw BrokenRun(std::isnan(density[*lost]) ? "non-finite" : "positivity-lost",
                    fmt::format("density of particle {} is {:.3g} at t = {:.6g}", *lost, density[*lost], time_));
  }
}

template <int Dim>
void MovingScene<Dim>::place_walls(double time, double const* displacements) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (walls_[w].path) walls_[w].point = walls_[w].path(time);
  }
  for (std::size_t f = 0; f < free_walls_.size(); ++f) {
    Wall<Dim>& wall = walls_[free_walls_[f]];
    wall.point = wall_start_[free_walls_[f]] + displacements[f] * wall.outward_normal;
  }
  if constexpr (Dim == 1) {
    if (wall_motion_ != WallMotion::mass) return;
    // Half of the nearest particle's mass, by the density of the last evaluation or the start's.
    for (std::size_t const w : free_walls_) {
      Wall<Dim>& wall = walls_[w];
      std::size_t const i = wall.outward_normal[0] < 0.0 ? order_.front() : order_.back();
      double const stored = particles_.scalar(Field::density)[i];
      double const rho =
          stored > 0.0 ? stored : problem_.scalars.at(Field::density)(particles_.positions()[i], 0.0);
      wall.point = particles_.positions()[i] + 0.5 * particles_.masses()[i] / rho * wall.outward_normal;
    }
  }
}

template <int Dim>
void MovingScene<Dim>::find_geometry(double time) {
  try {
    geometry_.follow(particles_, with_walls_ ? walls_ : std::vector<Wall<Dim>>{}, walls_);
  } catch (std::invalid_argument const& error) {
    // At the start it is the study that makes no sense; later it is what the run has come to.
    if (time == 0.0) throw;
    throw BrokenRun("unstable", fmt::format("{} at t = {:.6g}", error.what(), time));
  }
}

template <int Dim>
void MovingScene<Dim>::set_gas(double time) {
  auto const& rho = particles_.scalar(Field::density);
  auto const& e = particles_.scalar(Field::internal_energy);
  auto& P = particles_.scalar(Field::pressure);
  auto& c = particles_.scalar(Field::sound_speed);
  std::size_t const n = particles_.size();
  if (auto const lost = first_row(n, threads_, [&](std::size_t i) { return !std::isfinite(e[i]); })) {
    throw BrokenRun("non-finite",
                    fmt::format("internal energy of particle {} is not finite at t = {:.6g}", *lost, time));
  }
  for_each_row(n, threads_, [&](std::size_t i) {
    P[i] = (problem_.gamma - 1.0) * rho[i] * e[i];
    c[i] = std::sqrt(problem_.gamma * std::max(P[i], 0.0) / rho[i]);
  });
  ++passes_["equation-of-state"];
  if (particles_.has(Field::temperature)) copy(e.data(), n, threads_, particles_.scalar(Field::temperature).data());
  set_conductivity();
}

/// Of the temperatures that are there.
template <int Dim>
void MovingScene<Dim>::set_conductivity() {
  if (!particles_.has(Field::conductivity)) return;
  auto const& T = particles_.scalar(Field::temperature);
  auto& K = particles_.scalar(Field::conductivity);
  for_each_row(K.size(), threads_,
               [&](std::size_t i) { K[i] = problem_.conductivity(particles_.positions()[i], T[i]); });
  ++passes_["conductivity"];
}

template <int Dim>
void MovingScene<Dim>::fill_walls(BoundaryValue value, double time) {
  PairGeometry<Dim>& geometry = geometry_.geometry();
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w)
    fill_boundary_values(geometry.contacts[w], geometry.walls[w], particles_, {value}, closure_, time, threads_);
  geometry.held.insert(value);
}

/// What makes a rate undefined is what the run has come to.
template <int Dim>
template <class Body>
void MovingScene<Dim>::may_break(double time, Body const& body) const {
  try {
    body();
  } catch (TooFewPartners const& error) {
    // At the start it is the study that makes no sense.
    if (time == 0.0) throw;
    throw BrokenRun("unstable", fmt::format("at t = {:.6g} {}", time, error.what()));
  } catch (UndefinedRate const& error) {
    throw BrokenRun("positivity-lost", fmt::format("{} at t = {:.6g}", error.what(), time));
  }
}

/// The passes before those of the rates. A momentum form and its partner have the same, which are run once.
/// @return whether what they wrote serves all; else two forms write the same field, and each has to be evaluated by itself
template <int Dim>
bool MovingScene<Dim>::run_first_passes(std::vector<RateOperator<Dim>*> const& together, double time) {
  RateOperator<Dim>* leader = nullptr;
  for (RateOperator<Dim>* const one : together) {
    if (one->passes() == 1) continue;
    if (leader && one->first_passes() != leader->first_passes()) return false;
    if (!leader) leader = one;
  }
  if (!leader) return true;
  PairGeometry<Dim>& geometry = geometry_.geometry();
  for (int pass = 0; pass + 1 < leader->passes(); ++pass) {
    PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads_);
    leader->begin_pass(pass, particles_, geometry, closure_, time, threads_, sweep);
    if (!sweep.empty()) sweep.run(particles_);
    leader->end_pass(pass, particles_, geometry, work_);
    ++passes_[leader->info().first_passes.begin()[pass].name];
  }
  return true;
}

/// All rates in one sweep, with viscosity's pairs, after the passes before them.
template <int Dim>
void MovingScene<Dim>::evaluate_together(std::vector<RateOperator<Dim>*> const& together, bool with_viscosity, bool drifts,
                                         double time) {
  PairGeometry<Dim>& geometry = geometry_.geometry();
  bool const all = run_first_passes(together, time);
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads_);
  for (RateOperator<Dim>* const one : together) {
    if (all || one->passes() == 1) one->begin_pass(one->passes() - 1, particles_, geometry, closure_, time, threads_, sweep);
  }
  if (with_viscosity) add_viscosity(viscosity_, particles_, sweep, viscous_);
  if (!sweep.empty()) sweep.run(particles_, drifts && with_viscosity ? &drift_ : nullptr);
  for (RateOperator<Dim>* const one : together) {
    if (all || one->passes() == 1) {
      one->end_pass(one->passes() - 1, particles_, geometry, work_);
    } else {
      one->evaluate(particles_, geometry, closure_, time, threads_, work_);
      for (PassInfo const& pass : one->info().first_passes) ++passes_[pass.name];
    }
    ++passes_[one->info().id];
  }
  copy(particles_.scalar(Field::heating).data(), particles_.size(), threads_, energy_rate_.data());
}

template <int Dim>
void MovingScene<Dim>::conduct(double time) {
  SchemeInfo const& form = conduction_operator_->info();
  conduction_operator_->evaluate(particles_, geometry_.geometry(), closure_, time, threads_, work_);
  for (PassInfo const& pass : form.first_passes) ++passes_[pass.name];
  if (form.least_squares) ++passes_["quadratic-weights"];
  ++passes_[form.id];
  auto const& heating = particles_.scalar(Field::heating);
  for_each_row(particles_.size(), threads_, [&](std::size_t i) { energy_rate_[i] += heating[i]; });
  conduction_wall_power_ = conduction_operator_->wall_power();
}

/// Pressure, its work, conduction and the continuity equation, with the velocities of the drift; viscosity and the pressure at
/// walls that depends on velocity, with those of the state. Pairs all in one sweep, but for conduction.
template <int Dim>
void MovingScene<Dim>::evaluate_forces(double time, bool drifts) {
  std::vector<RateOperator<Dim>*> together{momentum_operator_.get(), work_operator_.get()};
  if (continuity_operator_) together.push_back(continuity_operator_.get());
  // What walls exchange and how they move is asked of them whatever the forms read there.
  geometry_.geometry().held = {};
  fill_walls(BoundaryValue::pressure, time);
  std::swap(particles_.vector(Field::velocity), drift_);
  fill_walls(BoundaryValue::velocity, time);
  may_break(time, [&] {
    evaluate_together(together, is_on(viscosity_), drifts, time);
    if (conduction_operator_) conduct(time);
  });
  std::swap(particles_.vector(Field::velocity), drift_);
  auto const& pressure = particles_.vector(Field::acceleration);
  for (int k = 0; k < Dim; ++k)
    copy(pressure.component(k).data(), particles_.size(), threads_, acceleration_.component(k).data());
  if (is_on(viscosity_)) {
    add_viscous_walls(viscosity_, particles_, geometry_.geometry(), closure_, momentum_operator_->info().wall_pressure_share, time,
                      threads_, viscous_);
    ++passes_["viscosity"];
    work_.pair_interactions += geometry().neighbours.pairs();
    for_each_row(particles_.size(), threads_, [&](std::size_t i) { acceleration_.add(i, viscous_.acceleration[i]); });
  }
  if (!problem_.body_force) return;
  for_each_row(particles_.size(), threads_,
               [&](std::size_t i) { acceleration_.add(i, problem_.body_force(particles_.positions()[i], time)); });
}

/// What viscosity and the case's sources give, with the velocities of the state: the same for any drift.
template <int Dim>
void MovingScene<Dim>::add_other_heating(double time) {
  auto const& v = particles_.vector(Field::velocity);
  bool const is_total = evolves_total_energy();
  if (is_on(viscosity_)) {
    for_each_row(particles_.size(), threads_, [&](std::size_t i) {
      energy_rate_[i] += viscous_.heating[i];
      if (is_total) energy_rate_[i] += viscous_.acceleration[i].dot(v[i]);
    });
  }
  if (!problem_.source && !problem_.body_force) return;
  for_each_row(particles_.size(), threads_, [&](std::size_t i) {
    Vector<Dim> const x = particles_.positions()[i];
    if (problem_.source) energy_rate_[i] += problem_.source(x, time);
    if (problem_.body_force && is_total) energy_rate_[i] += problem_.body_force(x, time).dot(v[i]);
  });
  ++passes_["source"];
}

template <int Dim>
void MovingScene<Dim>::find_wall_speeds(double time) {
  for (std::size_t f = 0; f < free_walls_.size(); ++f) {
    WallContacts<Dim> const& contacts = geometry().contacts[free_walls_[f]];
    if (contacts.size() == 0) {
      // A wall may outrun its gas, into vacuum at once. It goes on as its closure says.
      Wall<Dim> const& wall = walls_[free_walls_[f]];
      wall_speed_[f] = velocity_out_of_reach(wall, particles_, closure_, time).dot(wall.outward_normal);
      continue;
    }
    wall_speed_[f] =
        face_mean(contacts, [&](std::size_t c) { return contacts.velocity[c].dot(contacts.outward_normal); });
  }
}

template <int Dim>
void MovingScene<Dim>::rates(double* out) const {
  for (VectorField<Dim> const* field : {&drift_, &acceleration_}) {
    for (int k = 0; k < Dim; ++k, out += particles_.size())
      copy(field->component(k).data(), particles_.size(), threads_, out);
  }
  drift_rates(out);
}

template <int Dim>
void MovingScene<Dim>::drift_rates(double* out) const {
  std::size_t const n = particles_.size();
  copy(energy_rate_.data(), n, threads_, out);
  out += n;
  if (has_continuity()) {
    copy(particles_.scalar(Field::density_rate).data(), n, threads_, out);
    out += n;
  }
  std::copy(wall_speed_.begin(), wall_speed_.end(), out);
}

#define SPHVERIFY_INSTANTIATE(D)                                                                                   \
  template void MovingScene<D>::evaluate(double time, double const* state, double const* drift);                   \
  template void MovingScene<D>::drift(double const* state, double const* velocities);                              \
  template void MovingScene<D>::load(double const* state);                                                         \
  template void MovingScene<D>::load_energy(double const* state, std::vector<double>& e) const;                    \
  template void MovingScene<D>::place_walls(double time, double const* displacements);                             \
  template void MovingScene<D>::find_geometry(double time);                                                        \
  template void MovingScene<D>::set_gas(double time);                                                              \
  template void MovingScene<D>::set_conductivity();                                                                \
  template void MovingScene<D>::fill_walls(BoundaryValue value, double time);                                      \
  template bool MovingScene<D>::run_first_passes(std::vector<RateOperator<D>*> const&, double time);               \
  template void MovingScene<D>::evaluate_together(std::vector<RateOperator<D>*> const&, bool, bool, double time);  \
  template void MovingScene<D>::conduct(double time);                                                              \
  template void MovingScene<D>::evaluate_forces(double time, bool drifts);                                         \
  template void MovingScene<D>::add_other_heating(double time);                                                    \
  template void MovingScene<D>::find_wall_speeds(double time);                                                     \
  template void MovingScene<D>::rates(double* out) const;                                                          \
  template void MovingScene<D>::drift_rates(double* out) const;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
