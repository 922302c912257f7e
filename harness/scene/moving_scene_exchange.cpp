// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_scene.hpp"

#include <cmath>
#include <numeric>

#include "harness/scene/wall_geometry.hpp"

// What the gas holds, and what crosses its walls.

namespace sphverify {

template <int Dim>
std::vector<WallExchange<Dim>> MovingScene<Dim>::wall_exchange() const {
  std::vector<WallExchange<Dim>> all(walls_.size());
  for (std::size_t w = 0; w < geometry().contacts.size(); ++w) {
    WallContacts<Dim> const& contacts = geometry().contacts[w];
    WallExchange<Dim>& exchange = all[w];
    exchange.force = momentum_operator_->wall_force()[w];
    exchange.power = work_operator_->wall_power()[w];
    if (!evolves_total_energy()) {
      auto const& acceleration = momentum_operator_->wall_acceleration()[w];
      exchange.power += sum_of_rows(contacts.size(), threads_, 0.0, [&](std::size_t k) {
        std::uint32_t const i = contacts.particle[k];
        return particles_.masses()[i] * acceleration[k].dot(drift_[i]);
      });
    }
    if (is_on(viscosity_)) {
      exchange.force += viscous_.wall_force[w];
      exchange.power += viscous_.wall_power[w];
    }
    double const whole = wall_area(problem_.domain, walls_[w]);
    double const pressure = face_mean(contacts, [&](std::size_t c) { return contacts.pressure[c]; });
    double const work = face_mean(contacts, [&](std::size_t c) {
      return contacts.pressure[c] * contacts.velocity[c].dot(contacts.outward_normal);
    });
    exchange.prescribed_force = -pressure * whole * contacts.outward_normal;
    exchange.prescribed_power = -work * whole;
    if (!conduction_operator_) continue;
    bool const has_flux = walls_[w].flux || contacts.flux.size() == contacts.size();
    double const prescribed = !has_flux ? 0.0 : -whole * face_mean(contacts, [&](std::size_t c) {
      Vector<Dim> const flux = walls_[w].flux ? walls_[w].flux(contacts.foot[c], time_) : contacts.flux[c];
      return flux.dot(contacts.outward_normal);
    });
    bool const by_terms = conduction_operator_->info().wall_terms_are_exchange;
    exchange.heat = by_terms ? conduction_wall_power_[w] : walls_[w].flux ? prescribed : 0.0;
    exchange.power += exchange.heat;
    // A flux that neither the wall nor the closure knows is taken as it is in the scheme.
    exchange.prescribed_power += has_flux ? prescribed : exchange.heat;
  }
  return all;
}

template <int Dim>
bool MovingScene<Dim>::heat_exchange_is_known() const {
  return !conduction_operator_ || sphverify::heat_exchange_is_known(conduction_operator_->info(), geometry());
}

template <int Dim>
template <class Value, class Term>
Value MovingScene<Dim>::mass_sum(Value const& zero, Term const& term) const {
  auto const& m = particles_.masses();
  return sum_of_rows(particles_.size(), threads_, zero, [&](std::size_t i) -> Value { return m[i] * term(i); });
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::source_force() const {
  Vector<Dim> const zero = Vector<Dim>::Zero();
  if (!problem_.body_force) return zero;
  return mass_sum(zero, [&](std::size_t i) { return problem_.body_force(particles_.positions()[i], time_); });
}

template <int Dim>
double MovingScene<Dim>::source_power() const {
  if (!problem_.source && !problem_.body_force) return 0.0;
  return mass_sum(0.0, [&](std::size_t i) {
    Vector<Dim> const x = particles_.positions()[i];
    double power = problem_.source ? problem_.source(x, time_) : 0.0;
    if (problem_.body_force)
      power += problem_.body_force(x, time_).dot(particles_.vector(Field::velocity)[i]);
    return power;
  });
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::force() const {
  Vector<Dim> const zero = Vector<Dim>::Zero();
  return mass_sum(zero, [&](std::size_t i) { return acceleration_[i]; });
}

template <int Dim>
double MovingScene<Dim>::power() const {
  auto const& pressure = particles_.vector(Field::acceleration);
  auto const& v = particles_.vector(Field::velocity);
  return mass_sum(0.0, [&](std::size_t i) {
    double rate = energy_rate_[i];
    if (!evolves_total_energy()) {
      Vector<Dim> const rest = acceleration_[i] - pressure[i];
      rate += pressure[i].dot(drift_[i]) + rest.dot(v[i]);
    }
    return rate;
  });
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::momentum() const {
  Vector<Dim> const zero = Vector<Dim>::Zero();
  auto const& v = particles_.vector(Field::velocity);
  return mass_sum(zero, [&](std::size_t i) { return v[i]; });
}

template <int Dim>
double MovingScene<Dim>::energy() const {
  auto const& e = particles_.scalar(Field::internal_energy);
  auto const& v = particles_.vector(Field::velocity);
  return mass_sum(0.0, [&](std::size_t i) { return e[i] + 0.5 * v[i].squaredNorm(); });
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::momentum(double const* state) const {
  Vector<Dim> const zero = Vector<Dim>::Zero();
  return mass_sum(zero, [&](std::size_t i) { return velocity_in(state, i); });
}

template <int Dim>
double MovingScene<Dim>::energy(double const* state) const {
  double const* const evolved = state + 2 * coordinates();
  return mass_sum(0.0, [&](std::size_t i) {
    return evolves_total_energy() ? evolved[i] : evolved[i] + 0.5 * velocity_in(state, i).squaredNorm();
  });
}

template <int Dim>
std::optional<double> MovingScene<Dim>::volume_defect() const {
  double volume = 1.0;
  for (int k = 0; k < Dim; ++k) {
    Vector<Dim> const axis = problem_.domain.axes.col(k);
    double length = 0.0;
    int sides = 0;
    for (Wall<Dim> const& wall : walls_) {
      double const facing = wall.outward_normal.dot(axis);
      if (std::abs(facing) < 0.5) continue;
      length += wall.point.dot(axis) * (facing > 0.0 ? 1.0 : -1.0);
      ++sides;
    }
    if (problem_.domain.periodic[static_cast<std::size_t>(k)]) {
      length = problem_.domain.extent()[k];
    } else if (sides != 2) {
      return std::nullopt;
    }
    volume *= length;
  }
  auto const& rho = particles_.scalar(Field::density);
  return volume - mass_sum(0.0, [&](std::size_t i) { return 1.0 / rho[i]; });
}

#define SPHVERIFY_INSTANTIATE(D)                                                \
  template std::vector<WallExchange<D>> MovingScene<D>::wall_exchange() const;  \
  template bool MovingScene<D>::heat_exchange_is_known() const;                 \
  template Vector<D> MovingScene<D>::source_force() const;                      \
  template double MovingScene<D>::source_power() const;                         \
  template Vector<D> MovingScene<D>::force() const;                             \
  template double MovingScene<D>::power() const;                                \
  template Vector<D> MovingScene<D>::momentum() const;                          \
  template double MovingScene<D>::energy() const;                               \
  template Vector<D> MovingScene<D>::momentum(double const* state) const;       \
  template double MovingScene<D>::energy(double const* state) const;            \
  template std::optional<double> MovingScene<D>::volume_defect() const;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
