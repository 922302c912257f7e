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

template <int Dim>
void copy_into(VectorField<Dim>& field, double const* state) {
  for (int k = 0; k < Dim; ++k) {
    std::copy(state, state + field.size(), field.component(k).begin());
    state += field.size();
  }
}

}  // namespace

template <int Dim>
void MovingScene<Dim>::evaluate(double time, double const* state, double const* drift) {
  time_ = time;
  ++evaluations_;
  load(state);
  copy_into(drift_, drift ? drift : state + coordinates());
  place_walls(time, state + unknowns() - free_walls_.size());
  require_order(time);
  find_geometry(time);
  set_gas(time);
  evaluate_motion(time, drift != nullptr);
  evaluate_rates(time);
}

template <int Dim>
void MovingScene<Dim>::load(double const* state) {
  expects(!problem_.domain.is_turned());  // places are wrapped along the axes of space
  std::size_t const n = particles_.size();
  auto& x = particles_.positions();
  copy_into(x, state);
  for (int k = 0; k < Dim; ++k) {
    if (!problem_.domain.periodic[k]) continue;
    double const lower = problem_.domain.lower[k];
    double const period = problem_.domain.upper[k] - lower;
    for (double& place : x.component(k)) place -= period * std::floor((place - lower) / period);
  }
  auto& v = particles_.vector(Field::velocity);
  copy_into(v, state + Dim * n);
  auto& e = particles_.scalar(Field::internal_energy);
  std::copy(state + 2 * Dim * n, state + 2 * Dim * n + n, e.begin());
  if (evolves_total_energy()) {
    for (std::size_t i = 0; i < n; ++i) e[i] -= 0.5 * v[i].squaredNorm();
  }
  if (has_continuity()) {
    double const* const density = state + 2 * Dim * n + n;
    std::copy(density, density + n, particles_.scalar(Field::density).begin());
    for (std::size_t i = 0; i < n; ++i) {
      if (density[i] > 0.0) continue;
      throw BrokenRun(std::isnan(density[i]) ? "non-finite" : "positivity-lost",
                      fmt::format("density of particle {} is {:.3g} at t = {:.6g}", i, density[i], time_));
    }
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
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (!std::isfinite(e[i])) {
      throw BrokenRun("non-finite",
                      fmt::format("internal energy of particle {} is not finite at t = {:.6g}", i, time));
    }
    P[i] = (problem_.gamma - 1.0) * rho[i] * e[i];
    c[i] = std::sqrt(problem_.gamma * std::max(P[i], 0.0) / rho[i]);
  }
  ++passes_["equation-of-state"];
  if (particles_.has(Field::temperature)) particles_.scalar(Field::temperature) = e;
  if (!particles_.has(Field::conductivity)) return;
  auto& K = particles_.scalar(Field::conductivity);
  for_each_row(K.size(), threads_,
               [&](std::size_t i) { K[i] = problem_.conductivity(particles_.positions()[i], e[i]); });
  ++passes_["conductivity"];
}

/// Pressure, its work, conduction and the continuity equation, with the velocities of the drift; viscosity's
/// pairs, with those of the state. All in one sweep, but for conduction.
template <int Dim>
void MovingScene<Dim>::evaluate_motion(double time, bool drifts) {
  PairGeometry<Dim>& geometry = geometry_.geometry();
  std::vector<RateOperator<Dim>*> together{momentum_operator_.get(), work_operator_.get()};
  if (continuity_operator_) together.push_back(continuity_operator_.get());
  auto const undefined = [&](UndefinedRate const& error) {
    return BrokenRun("positivity-lost", fmt::format("{} at t = {:.6g}", error.what(), time));
  };
  std::swap(particles_.vector(Field::velocity), drift_);
  // What walls exchange and how they move is asked of them whatever the forms read there.
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    fill_boundary_values(geometry.contacts[w], geometry.walls[w], particles_,
                         {BoundaryValue::pressure, BoundaryValue::velocity}, closure_, time);
  }
  try {
    PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads_);
    // What has passes of its own before the rate keeps them to itself: two forms may write the same field there.
    for (RateOperator<Dim>* const one : together) {
      if (one->passes() == 1) one->begin_pass(0, particles_, geometry, closure_, time, threads_, sweep);
    }
    if (is_on(viscosity_)) add_viscosity(viscosity_, particles_, sweep, viscous_);
    if (!sweep.empty()) sweep.run(particles_, drifts && is_on(viscosity_) ? &drift_ : nullptr);
    for (RateOperator<Dim>* const one : together) {
      if (one->passes() == 1) {
        one->end_pass(0, particles_, geometry, work_);
      } else {
        one->evaluate(particles_, geometry, closure_, time, threads_, work_);
        for (PassInfo const& pass : one->info().first_passes) ++passes_[pass.name];
      }
      ++passes_[one->info().id];
    }
    acceleration_ = particles_.vector(Field::acceleration);
    energy_rate_ = particles_.scalar(Field::heating);
    if (conduction_operator_) {
      conduction_operator_->evaluate(particles_, geometry, closure_, time, threads_, work_);
      for (PassInfo const& pass : conduction_operator_->info().first_passes) ++passes_[pass.name];
      if (conduction_operator_->info().least_squares) ++passes_["quadratic-weights"];
      ++passes_[conduction_operator_->info().id];
      auto const& heating = particles_.scalar(Field::heating);
      for (std::size_t i = 0; i < particles_.size(); ++i) energy_rate_[i] += heating[i];
      conduction_wall_power_ = conduction_operator_->wall_power();
    }
  } catch (TooFewPartners const& error) {
    // At the start it is the study that makes no sense; later it is what the run has come to.
    if (time == 0.0) throw;
    throw BrokenRun("unstable", fmt::format("at t = {:.6g} {}", time, error.what()));
  } catch (UndefinedRate const& error) {
    throw undefined(error);
  }
  std::swap(particles_.vector(Field::velocity), drift_);
}

/// What viscosity and the case's sources add, with the velocities of the state.
template <int Dim>
void MovingScene<Dim>::evaluate_rates(double time) {
  std::size_t const n = particles_.size();
  auto const& v = particles_.vector(Field::velocity);
  if (is_on(viscosity_)) {
    add_viscous_walls(viscosity_, particles_, geometry_.geometry(), closure_, time, threads_, viscous_);
    ++passes_["viscosity"];
    work_.pair_interactions += geometry().neighbours.pairs();
    for (std::size_t i = 0; i < n; ++i) {
      acceleration_.add(i, viscous_.acceleration[i]);
      energy_rate_[i] += viscous_.heating[i];
      if (evolves_total_energy()) energy_rate_[i] += viscous_.acceleration[i].dot(v[i]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    Vector<Dim> const x = particles_.positions()[i];
    if (problem_.source) energy_rate_[i] += problem_.source(x, time);
    if (!problem_.body_force) continue;
    Vector<Dim> const g = problem_.body_force(x, time);
    acceleration_.add(i, g);
    if (evolves_total_energy()) energy_rate_[i] += g.dot(v[i]);
  }
  if (problem_.source || problem_.body_force) ++passes_["source"];

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
  auto const& v = particles_.vector(Field::velocity);
  auto const put = [&](std::vector<double> const& values) {
    out = std::copy(values.begin(), values.end(), out);
  };
  for (int k = 0; k < Dim; ++k) put(v.component(k));
  for (int k = 0; k < Dim; ++k) put(acceleration_.component(k));
  put(energy_rate_);
  if (has_continuity()) put(particles_.scalar(Field::density_rate));
  put(wall_speed_);
}

#define SPHVERIFY_INSTANTIATE(D)                                                                  \
  template void MovingScene<D>::evaluate(double time, double const* state, double const* drift);  \
  template void MovingScene<D>::load(double const* state);                                        \
  template void MovingScene<D>::place_walls(double time, double const* displacements);            \
  template void MovingScene<D>::find_geometry(double time);                                       \
  template void MovingScene<D>::set_gas(double time);                                             \
  template void MovingScene<D>::evaluate_motion(double time, bool drifts);                        \
  template void MovingScene<D>::evaluate_rates(double time);                                      \
  template void MovingScene<D>::rates(double* out) const;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
