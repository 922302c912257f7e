#include "harness/scene/moving_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/sweep/approach.hpp"
#include "formulations/walls/wall_out_of_reach.hpp"
#include "harness/scene/choices.hpp"
#include "harness/scene/place.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

/// Part of the time in which sound, or what else limits a step, crosses a smoothing length (Monaghan, Annu.
/// Rev. Astron. Astrophys. 30 (1992) 543, section 10).
constexpr double courant_number = 0.3;

template <int Dim>
std::unique_ptr<RateOperator<Dim>> operator_if_named(std::string const& id) {
  return id.empty() ? nullptr : make_rate_operator<Dim>(id);
}

/// A field of the exact initial state at places.
template <int Dim>
std::vector<double> sample(ScalarFunction<Dim> const& f, VectorField<Dim> const& places) {
  std::vector<double> values(places.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(places[i], 0.0);
  return values;
}

template <int Dim>
void copy_into(VectorField<Dim>& field, double const* state) {
  for (int k = 0; k < Dim; ++k) {
    std::copy(state, state + field.size(), field.component(k).begin());
    state += field.size();
  }
}

}  // namespace

template <int Dim>
MovingScene<Dim>::MovingScene(Problem<Dim> problem, SceneChoice const& choice)
    : problem_(std::move(problem)),
      momentum_operator_(make_rate_operator<Dim>(choice.formulation)),
      work_operator_(make_rate_operator<Dim>(choice.work)),
      conduction_operator_(operator_if_named<Dim>(choice.conduction)),
      viscosity_{choice.discretisation.viscosity.alpha, choice.discretisation.viscosity.beta},
      density_rule_(density_words.value(choice.discretisation.density)),
      closure_(closure_words.value(choice.discretisation.closure)),
      wall_motion_(wall_motion_words.value(choice.discretisation.wall_motion)),
      adaptive_(choice.discretisation.smoothing == "adaptive"),
      with_walls_(choice.walls && !problem_.walls.empty()),
      threads_(choice.threads),
      particles_(0, 1.0),
      walls_(problem_.walls),
      geometry_(problem_.domain, {.density = density_rule_,
                                  .face_weight = face_weight_words.value(choice.discretisation.face_weight),
                                  .adaptive = adaptive_,
                                  .smoothing_ratio = choice.smoothing_ratio,
                                  .threads = choice.threads}) {
  if (has_continuity()) continuity_operator_ = make_continuity_operator<Dim>();
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    Wall<Dim>& wall = walls_[w];
    wall.gamma = problem_.gamma;
    if (wall.path) wall.point = wall.path(0.0);
    wall_start_.push_back(wall.point);
    bool const goes_with_the_gas = with_walls_ && !wall.path && wall.pressure && !wall.velocity;
    if (goes_with_the_gas) free_walls_.push_back(w);
  }
  wall_speed_.assign(free_walls_.size(), 0.0);
  place_particles(choice);
}

template <int Dim>
void MovingScene<Dim>::place_particles(SceneChoice const& choice) {
  Layout<Dim> layout = place(problem_, choice.discretisation.layout, choice.resolution);
  ++passes_["layout"];
  spacing_ = layout.spacing;
  std::size_t const n = layout.volumes.size();
  particles_ = Particles<Dim>(n, choice.smoothing_ratio * spacing_);
  particles_.set_kernel(kernel(choice.discretisation.kernel, Dim));
  for (std::size_t i = 0; i < n; ++i) {
    particles_.masses()[i] =
        problem_.scalars.at(Field::density)(layout.positions[i], 0.0) * layout.volumes[i];
  }
  cut_cells_ = cut_cells(problem_, layout, choice.discretisation.layout);
  for (CutCell<Dim> const& cell : cut_cells_)
    particles_.masses()[cell.particle] = held(cell, problem_).density * cell.volume;
  particles_.positions() = std::move(layout.positions);
  particles_.allocate(
      {Field::density, Field::velocity, Field::pressure, Field::internal_energy, Field::sound_speed});
  particles_.allocate(needed_fields(momentum_operator_->info()));
  particles_.allocate(needed_fields(work_operator_->info()));
  if (conduction_operator_) particles_.allocate(needed_fields(conduction_operator_->info()));
  if (has_continuity()) particles_.allocate(Field::density_rate);
  if (adaptive_) particles_.vary_smoothing_length();
  energy_rate_.assign(n, 0.0);
  acceleration_ = drift_ = VectorField<Dim>(n);
  if constexpr (Dim == 1) {
    auto const& x = particles_.positions().component(0);
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) { return x[i] < x[j]; });
  }
}

template <int Dim>
std::size_t MovingScene<Dim>::unknowns() const {
  std::size_t const n = particles_.size();
  return 2 * Dim * n + n + (has_continuity() ? n : 0) + free_walls_.size();
}

/// Per mass, of the energy that the problem releases at a point: as the kernel about the point says, so that
/// all of it is there and it shrinks to the point as h does.
template <int Dim>
std::vector<double> MovingScene<Dim>::released_energy() const {
  std::size_t const n = particles_.size();
  std::vector<double> energy(n, 0.0);
  if (!problem_.point_energy) return energy;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    Vector<Dim> const r =
        problem_.domain.nearest_image(particles_.positions()[i] - problem_.point_energy->place);
    energy[i] = particles_.kernel().value(r.norm(), particles_.smoothing_length());
    sum += particles_.masses()[i] * energy[i];
  }
  if (!(sum > 0.0)) throw std::invalid_argument("no particle is near the point at which energy is released");
  for (double& e : energy) e *= problem_.point_energy->energy / sum;
  return energy;
}

template <int Dim>
std::vector<double> MovingScene<Dim>::initial_state() {
  std::size_t const n = particles_.size();
  std::vector<double> state;
  state.reserve(unknowns());
  VectorField<Dim> const x = particles_.positions();
  VectorField<Dim> v(n);
  std::vector<double> e = sample(problem_.scalars.at(Field::internal_energy), x);
  std::vector<double> rho;
  if (has_continuity()) rho = sample(problem_.scalars.at(Field::density), x);
  for (std::size_t i = 0; i < n; ++i) v.set(i, problem_.vectors.at(Field::velocity)(x[i], 0.0));
  for (CutCell<Dim> const& cell : cut_cells_) {
    CellState<Dim> const inside = held(cell, problem_);
    v.set(cell.particle, inside.velocity);
    e[cell.particle] = inside.internal_energy;
    if (has_continuity()) rho[cell.particle] = inside.density;
  }
  for (VectorField<Dim> const* field : {&x, static_cast<VectorField<Dim> const*>(&v)}) {
    for (int k = 0; k < Dim; ++k) {
      state.insert(state.end(), field->component(k).begin(), field->component(k).end());
    }
  }
  std::vector<double> const released = released_energy();
  for (std::size_t i = 0; i < n; ++i) {
    double const internal = e[i] + released[i];
    state.push_back(evolves_total_energy() ? internal + 0.5 * v[i].squaredNorm() : internal);
  }
  state.insert(state.end(), rho.begin(), rho.end());
  state.insert(state.end(), free_walls_.size(), 0.0);
  return state;
}

template <int Dim>
std::vector<double> MovingScene<Dim>::scales() const {
  double speed = 0.0;
  double energy = 0.0;
  double density = 0.0;
  for (double const t : {0.0, problem_.final_time}) {
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      Vector<Dim> const x = particles_.positions()[i];
      double const e = problem_.scalars.at(Field::internal_energy)(x, t);
      double const c = std::sqrt(problem_.gamma * (problem_.gamma - 1.0) * std::max(e, 0.0));
      speed = std::max(speed, problem_.vectors.at(Field::velocity)(x, t).norm() + c);
      energy = std::max(energy, e);
      density = std::max(density, problem_.scalars.at(Field::density)(x, t));
    }
  }
  std::size_t const n = particles_.size();
  double const extent = problem_.domain.extent().maxCoeff();
  std::vector<double> all(Dim * n, extent);
  all.insert(all.end(), Dim * n, speed);
  all.insert(all.end(), n, std::max(energy, 0.5 * speed * speed));
  if (has_continuity()) all.insert(all.end(), n, density);
  all.insert(all.end(), free_walls_.size(), extent);
  return all;
}

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
void MovingScene<Dim>::require_order(double time) const {
  auto const& x = particles_.positions();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!x[i].allFinite()) {
      throw BrokenRun("non-finite",
                      fmt::format("position of particle {} is not finite at t = {:.6g}", i, time));
    }
  }
  if constexpr (Dim == 1) {
    bool const periodic = problem_.domain.periodic[0];
    double const period = problem_.domain.extent()[0];
    for (std::size_t k = 0; k + 1 < order_.size() + (periodic && order_.size() > 1 ? 1 : 0); ++k) {
      std::size_t const i = order_[k];
      std::size_t const j = order_[(k + 1) % order_.size()];
      double gap = x[j][0] - x[i][0];
      // Neighbours along a periodic axis are less than half of it apart.
      if (periodic) gap -= period * std::round(gap / period);
      if (gap > 0.0) continue;
      throw BrokenRun("unstable", fmt::format("particles {} and {} crossed at t = {:.6g}", i, j, time));
    }
  }
  if (!with_walls_) return;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (walls_[w].distance(x[i]) > 0.0) continue;
      throw BrokenRun("unstable", fmt::format("particle {} overtook wall {} at t = {:.6g}", i, w, time));
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
  try {
    PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads_);
    for (RateOperator<Dim>* const one : together) {
      one->begin_pass(0, particles_, geometry, closure_, time, threads_, sweep);
    }
    if (viscosity_.is_on()) add_viscosity(viscosity_, particles_, sweep, viscous_);
    sweep.run(particles_, drifts && viscosity_.is_on() ? &drift_ : nullptr);
    for (RateOperator<Dim>* const one : together) {
      one->end_pass(0, particles_, geometry, work_);
      ++passes_[one->info().id];
    }
    acceleration_ = particles_.vector(Field::acceleration);
    energy_rate_ = particles_.scalar(Field::heating);
    if (conduction_operator_) {
      conduction_operator_->evaluate(particles_, geometry, closure_, time, threads_, work_);
      for (PassInfo const& pass : conduction_operator_->info().first_passes) ++passes_[pass.name];
      ++passes_[conduction_operator_->info().id];
      auto const& heating = particles_.scalar(Field::heating);
      for (std::size_t i = 0; i < particles_.size(); ++i) energy_rate_[i] += heating[i];
      conduction_wall_power_ = conduction_operator_->wall_power();
    }
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
  if (viscosity_.is_on()) {
    add_viscous_walls(viscosity_, particles_, geometry_.geometry(), closure_, viscous_);
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
template <class Value>
double MovingScene<Dim>::face_mean(WallContacts<Dim> const& contacts, Value const& value) const {
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    std::uint32_t const i = contacts.particle[c];
    double const face =
        particles_.masses()[i] / particles_.scalar(Field::density)[i] * contacts.face_weight[c];
    sum += face * value(c);
    weight += face;
  }
  return weight != 0.0 ? sum / weight : 0.0;
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

template <int Dim>
std::string MovingScene<Dim>::rate_name(std::size_t unknown) const {
  std::size_t const n = particles_.size();
  std::vector<char const*> blocks(Dim, "velocity");
  blocks.insert(blocks.end(), Dim, "acceleration");
  blocks.push_back("heating");
  if (has_continuity()) blocks.push_back("density rate");
  if (unknown < blocks.size() * n) return fmt::format("{} of particle {}", blocks[unknown / n], unknown % n);
  std::size_t const wall = unknown - blocks.size() * n;
  if (wall < free_walls_.size()) return fmt::format("speed of wall {}", free_walls_[wall]);
  return "what walls and sources exchange";
}

template <int Dim>
std::vector<StepLimit> MovingScene<Dim>::step_limits() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SmoothingLength const h(particles_);
  auto const& c = particles_.scalar(Field::sound_speed);
  auto const& v = particles_.vector(Field::velocity);
  std::vector<double> rates_of_approach(particles_.size());
  PairSweep<Dim> sweep(geometry().neighbours, geometry().domain, threads_);
  sweep.add(sweep_kernels<Dim>(particles_.kernel().id()).approach, {Field::velocity}, {}, rates_of_approach);
  sweep.run(particles_);
  double courant = infinity, force = infinity, viscosity = infinity, conduction = infinity, approach = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    courant = std::min(courant, h(i) / c[i]);
    force = std::min(force, std::sqrt(h(i) / acceleration_[i].norm()));
    if (viscosity_.is_on()) {
      double const mu = viscous_.largest_mu[i];
      viscosity = std::min(viscosity, h(i) / (c[i] + 0.6 * (viscosity_.alpha * c[i] + viscosity_.beta * mu)));
    }
    if (conduction_operator_) {
      double const K = particles_.scalar(Field::conductivity)[i];
      conduction = std::min(conduction, 0.5 * h(i) * h(i) * particles_.scalar(Field::density)[i] / K);
    }
    approach = std::max(approach, rates_of_approach[i]);
  }
  for (auto const& contacts : geometry().contacts) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      std::uint32_t const i = contacts.particle[k];
      double const closing = (v[i] - contacts.velocity[k]).dot(contacts.outward_normal);
      approach = std::max(approach, closing / contacts.distance[k]);
      if (!conduction_operator_) continue;
      double const K = particles_.scalar(Field::conductivity)[i];
      conduction = std::min(conduction, contacts.distance[k] * particles_.scalar(Field::density)[i] /
                                            (4.0 * K * contacts.face_weight[k]));
    }
  }
  std::vector<StepLimit> limits{{"courant", courant}, {"force", force}, {"approach", 1.0 / approach}};
  if (viscosity_.is_on()) limits.push_back({"viscosity", viscosity});
  if (conduction_operator_) limits.push_back({"conduction", conduction});
  for (StepLimit& limit : limits) limit.step *= courant_number;
  return limits;
}

template <int Dim>
std::string MovingScene<Dim>::closest_approach() const {
  SmoothingLength const h(particles_);
  auto const& v = particles_.vector(Field::velocity);
  auto const& x = particles_.positions();
  double fastest = 0.0;
  std::string who;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    for (std::uint32_t const j : geometry().neighbours.row(i)) {
      Vector<Dim> const r_ij = problem_.domain.nearest_image(x[i] - x[j]);
      if (r_ij.norm() >= h.support(i, j)) continue;
      double const rate = rate_of_approach<Dim>(-(v[i] - v[j]).dot(r_ij), r_ij.squaredNorm(), h(i, j));
      if (rate <= fastest) continue;
      fastest = rate;
      who = fmt::format("particles {} and {}, {:.3g} apart", i, j, r_ij.norm());
    }
  }
  for (std::size_t w = 0; w < geometry().contacts.size(); ++w) {
    auto const& contacts = geometry().contacts[w];
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      std::uint32_t const i = contacts.particle[k];
      double const rate = (v[i] - contacts.velocity[k]).dot(contacts.outward_normal) / contacts.distance[k];
      if (rate <= fastest) continue;
      fastest = rate;
      who = fmt::format("particle {} and wall {}, {:.3g} apart", i, w, contacts.distance[k]);
    }
  }
  return who;
}

template <int Dim>
std::vector<WallExchange<Dim>> MovingScene<Dim>::wall_exchange() const {
  std::vector<WallExchange<Dim>> all(walls_.size());
  for (std::size_t w = 0; w < geometry().contacts.size(); ++w) {
    WallContacts<Dim> const& contacts = geometry().contacts[w];
    WallExchange<Dim>& exchange = all[w];
    exchange.force = momentum_operator_->wall_force()[w];
    exchange.power = work_operator_->wall_power()[w];
    if (!evolves_total_energy()) {
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        std::uint32_t const i = contacts.particle[k];
        exchange.power +=
            particles_.masses()[i] * momentum_operator_->wall_acceleration()[w][k].dot(drift_[i]);
      }
    }
    if (viscosity_.is_on()) {
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
    exchange.heat = conduction_wall_power_[w];
    exchange.power += exchange.heat;
    // A flux that neither the wall nor the closure knows is taken as it is in the scheme.
    if (walls_[w].flux || contacts.flux.size() == contacts.size()) {
      exchange.prescribed_power -= whole * face_mean(contacts, [&](std::size_t c) {
                                     Vector<Dim> const flux = walls_[w].flux
                                                                  ? walls_[w].flux(contacts.foot[c], time_)
                                                                  : contacts.flux[c];
                                     return flux.dot(contacts.outward_normal);
                                   });
    } else {
      exchange.prescribed_power += exchange.heat;
    }
  }
  return all;
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::source_force() const {
  Vector<Dim> sum = Vector<Dim>::Zero();
  if (!problem_.body_force) return sum;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += particles_.masses()[i] * problem_.body_force(particles_.positions()[i], time_);
  }
  return sum;
}

template <int Dim>
double MovingScene<Dim>::source_power() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Vector<Dim> const x = particles_.positions()[i];
    double power = problem_.source ? problem_.source(x, time_) : 0.0;
    if (problem_.body_force)
      power += problem_.body_force(x, time_).dot(particles_.vector(Field::velocity)[i]);
    sum += particles_.masses()[i] * power;
  }
  return sum;
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::force() const {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) sum += particles_.masses()[i] * acceleration_[i];
  return sum;
}

template <int Dim>
double MovingScene<Dim>::power() const {
  double sum = 0.0;
  auto const& pressure = particles_.vector(Field::acceleration);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    double rate = energy_rate_[i];
    if (!evolves_total_energy()) {
      Vector<Dim> const rest = acceleration_[i] - pressure[i];
      rate += pressure[i].dot(drift_[i]) + rest.dot(particles_.vector(Field::velocity)[i]);
    }
    sum += particles_.masses()[i] * rate;
  }
  return sum;
}

template <int Dim>
Vector<Dim> MovingScene<Dim>::momentum() const {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += particles_.masses()[i] * particles_.vector(Field::velocity)[i];
  }
  return sum;
}

template <int Dim>
double MovingScene<Dim>::energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += particles_.masses()[i] * (particles_.scalar(Field::internal_energy)[i] +
                                     0.5 * particles_.vector(Field::velocity)[i].squaredNorm());
  }
  return sum;
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
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    volume -= particles_.masses()[i] / particles_.scalar(Field::density)[i];
  }
  return volume;
}

template <int Dim>
WorkCount MovingScene<Dim>::work() const {
  WorkCount work = work_;
  work.evaluations = evaluations_;  // of all schemes together
  return work;
}

template <int Dim>
SceneRecord MovingScene<Dim>::record() const {
  SceneRecord record;
  for (FieldInfo const& field : field_infos) {
    if (particles_.has(field.field)) record.fields.emplace_back(field.name);
  }
  if (adaptive_) record.fields.emplace_back("smoothing_length");
  for (auto const& [pass, times] : passes_) record.passes.emplace(pass, times);
  for (auto const& [pass, times] : geometry_.passes()) record.passes.emplace(pass, times);
  return record;
}

template class MovingScene<1>;
template class MovingScene<2>;
template class MovingScene<3>;

}  // namespace sphverify
