#include "harness/scene/moving_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formulations/support/cubic_spline.hpp"
#include "formulations/support/sweep.hpp"
#include "harness/scene/choices.hpp"
#include "harness/scene/place.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

/// Part of the time in which sound, or what else limits a step, crosses a smoothing length (Monaghan, Annu.
/// Rev. Astron. Astrophys. 30 (1992) 543, section 10).
constexpr double courant_number = 0.3;
constexpr int most_iterations = 100;

template <int Dim>
std::unique_ptr<RateOperator<Dim>> operator_if_named(std::string const& id) {
  return id.empty() ? nullptr : make_rate_operator<Dim>(id);
}

template <int Dim>
void copy_into(VectorField<Dim>& field, double const* state) {
  for (int k = 0; k < Dim; ++k) {
    std::copy(state, state + field.size(), field.component(k).begin());
    state += field.size();
  }
}

template <int Dim>
bool same_places(VectorField<Dim> const& a, VectorField<Dim> const& b) {
  for (int k = 0; k < Dim; ++k) {
    if (a.component(k) != b.component(k)) return false;
  }
  return true;
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
      face_weight_(face_weight_words.value(choice.discretisation.face_weight)),
      closure_(closure_words.value(choice.discretisation.closure)),
      wall_motion_(wall_motion_words.value(choice.discretisation.wall_motion)),
      adaptive_(choice.discretisation.smoothing == "adaptive"),
      with_walls_(choice.walls && !problem_.walls.empty()),
      smoothing_ratio_(choice.smoothing_ratio),
      threads_(choice.threads),
      particles_(0, 1.0),
      walls_(problem_.walls) {
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
  particles_ = Particles<Dim>(n, smoothing_ratio_ * spacing_);
  for (std::size_t i = 0; i < n; ++i) {
    particles_.masses()[i] =
        problem_.scalars.at(Field::density)(layout.positions[i], 0.0) * layout.volumes[i];
  }
  particles_.positions() = std::move(layout.positions);
  particles_.allocate(
      {Field::density, Field::velocity, Field::pressure, Field::internal_energy, Field::sound_speed});
  particles_.allocate(needed_fields(momentum_operator_->info()));
  particles_.allocate(needed_fields(work_operator_->info()));
  if (conduction_operator_) particles_.allocate(needed_fields(conduction_operator_->info()));
  if (has_continuity()) particles_.allocate(Field::density_rate);
  if (adaptive_) particles_.vary_smoothing_length();
  energy_rate_.assign(n, 0.0);
  acceleration_ = drift_ = found_at_ = VectorField<Dim>(n);
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

template <int Dim>
std::vector<double> MovingScene<Dim>::initial_state() {
  std::size_t const n = particles_.size();
  std::vector<double> state;
  state.reserve(unknowns());
  VectorField<Dim> const x = particles_.positions();
  VectorField<Dim> v(n);
  for (std::size_t i = 0; i < n; ++i) v.set(i, problem_.vectors.at(Field::velocity)(x[i], 0.0));
  for (VectorField<Dim> const* field : {&x, static_cast<VectorField<Dim> const*>(&v)}) {
    for (int k = 0; k < Dim; ++k) {
      state.insert(state.end(), field->component(k).begin(), field->component(k).end());
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    double const e = problem_.scalars.at(Field::internal_energy)(x[i], 0.0);
    state.push_back(evolves_total_energy() ? e + 0.5 * v[i].squaredNorm() : e);
  }
  if (has_continuity()) {
    for (std::size_t i = 0; i < n; ++i) state.push_back(problem_.scalars.at(Field::density)(x[i], 0.0));
  }
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
  if (adaptive_ && has_continuity()) set_smoothing_length();
  find_geometry(time);
  set_gas(time);
  evaluate_motion(time);
  evaluate_rates(time);
}

template <int Dim>
void MovingScene<Dim>::load(double const* state) {
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

/// h_i = (h/dx) (m_i/rho_i)^(1/Dim), with the densities that are there.
template <int Dim>
void MovingScene<Dim>::set_smoothing_length() {
  auto& h = particles_.smoothing_lengths();
  auto const& density = particles_.scalar(Field::density);
  for (std::size_t i = 0; i < h.size(); ++i) {
    h[i] = smoothing_ratio_ * std::pow(particles_.masses()[i] / density[i], 1.0 / Dim);
  }
  ++passes_["smoothing-length"];
}

template <int Dim>
void MovingScene<Dim>::find_geometry(double time) {
  try {
    if (adaptive_ && !has_continuity()) adapt_smoothing_length_to_sum();
    SmoothingLength const h(particles_);
    CellGrid<Dim> const grid(particles_.positions(), problem_.domain,
                             CubicSpline<Dim>::support_ratio * h.largest());
    // With own lengths these follow the density, and through Gamma the walls.
    bool const h_may_have_changed = adaptive_ && (has_continuity() || !free_walls_.empty());
    if (!same_places(found_at_, particles_.positions()) || h_may_have_changed) {
      geometry_.neighbours = find_neighbours(grid, h);
      ++passes_["neighbour-search"];
      KernelWeightSet wanted = momentum_operator_->info().kernel | work_operator_->info().kernel;
      if (conduction_operator_) wanted = wanted | conduction_operator_->info().kernel;
      geometry_.weights =
          evaluate_kernel(geometry_.neighbours, particles_.positions(), problem_.domain, h, wanted);
      ++passes_["kernel"];
      found_at_ = particles_.positions();
    }
    if (!has_continuity()) set_density(grid);
    if (!with_walls_) return;
    geometry_.walls = walls_;
    geometry_.contacts.clear();
    for (Wall<Dim> const& wall : walls_) {
      geometry_.contacts.push_back(find_wall_contacts(grid, wall, walls_, h, particles_.masses(),
                                                      particles_.scalar(Field::density), face_weight_));
    }
    ++passes_["wall-contacts"];
  } catch (std::invalid_argument const& error) {
    // At the start it is the study that makes no sense; later it is what the run has come to.
    if (time == 0.0) throw;
    throw BrokenRun("unstable", fmt::format("{} at t = {:.6g}", error.what(), time));
  }
}

template <int Dim>
void MovingScene<Dim>::set_density(CellGrid<Dim> const& grid) {
  SmoothingLength const h(particles_);
  auto& density = particles_.scalar(Field::density);
  density = summation_density(grid, h, particles_.masses());
  ++passes_["density-summation"];
  if (density_rule_ != DensityRule::normalised || problem_.walls.empty()) return;
  for (std::size_t i = 0; i < density.size(); ++i) {
    density[i] /= kernel_inside(particles_.positions()[i], walls_, h(i));
  }
  ++passes_["density-normalisation"];
}

/// Solves h_i = (h/dx) (m_i/rho_i(h_i))^(1/Dim) for all particles by fixed-point iteration, which converges
/// at the rate at which the density hardly depends on h; at a jump it may swing, and is damped.
template <int Dim>
void MovingScene<Dim>::adapt_smoothing_length_to_sum() {
  constexpr int undamped = 10;
  auto& h = particles_.smoothing_lengths();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    CellGrid<Dim> const grid(particles_.positions(), problem_.domain,
                             CubicSpline<Dim>::support_ratio * SmoothingLength(particles_).largest());
    set_density(grid);
    std::vector<double> const before = h;
    set_smoothing_length();
    double change = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      change = std::max(change, std::abs(h[i] / before[i] - 1.0));
      if (iteration >= undamped) h[i] = 0.5 * (h[i] + before[i]);
    }
    if (change < 1e-10) return;
  }
  throw std::invalid_argument("the smoothing lengths that the summed density asks for do not settle");
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

/// Pressure, its work, conduction and the continuity equation, with the velocities of the drift.
template <int Dim>
void MovingScene<Dim>::evaluate_motion(double time) {
  auto const run = [&](RateOperator<Dim>& one) {
    try {
      one.evaluate(particles_, geometry_, closure_, time, threads_, work_);
    } catch (UndefinedRate const& error) {
      throw BrokenRun("positivity-lost", fmt::format("{} at t = {:.6g}", error.what(), time));
    }
    if (one.info().two_pass) ++passes_["flux"];
    ++passes_[one.info().id];
  };
  auto const& heating = particles_.scalar(Field::heating);
  std::swap(particles_.vector(Field::velocity), drift_);
  run(*momentum_operator_);
  acceleration_ = particles_.vector(Field::acceleration);
  run(*work_operator_);
  energy_rate_ = heating;
  if (continuity_operator_) run(*continuity_operator_);
  if (conduction_operator_) {
    run(*conduction_operator_);
    for (std::size_t i = 0; i < particles_.size(); ++i) energy_rate_[i] += heating[i];
    conduction_wall_power_ = conduction_operator_->wall_power();
  }
  std::swap(particles_.vector(Field::velocity), drift_);
}

/// What viscosity and the case's sources add, with the velocities of the state.
template <int Dim>
void MovingScene<Dim>::evaluate_rates(double time) {
  std::size_t const n = particles_.size();
  auto const& v = particles_.vector(Field::velocity);
  if (viscosity_.is_on()) {
    evaluate_viscosity(viscosity_, particles_, geometry_, problem_.domain, closure_, threads_, viscous_);
    ++passes_["viscosity"];
    work_.pair_interactions += geometry_.neighbours.pairs();
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
    WallContacts<Dim> const& contacts = geometry_.contacts[free_walls_[f]];
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
std::vector<StepLimit> MovingScene<Dim>::step_limits() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SmoothingLength const h(particles_);
  auto const& c = particles_.scalar(Field::sound_speed);
  auto const& v = particles_.vector(Field::velocity);
  auto const& x = particles_.positions();
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
    for (std::uint32_t const j : geometry_.neighbours.row(i)) {
      Vector<Dim> const r_ij = problem_.domain.nearest_image(x[i] - x[j]);
      approach = std::max(approach, -(v[i] - v[j]).dot(r_ij) / r_ij.squaredNorm());
    }
  }
  for (auto const& contacts : geometry_.contacts) {
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
  auto const& v = particles_.vector(Field::velocity);
  auto const& x = particles_.positions();
  double fastest = 0.0;
  std::string who;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    for (std::uint32_t const j : geometry_.neighbours.row(i)) {
      Vector<Dim> const r_ij = problem_.domain.nearest_image(x[i] - x[j]);
      double const rate = -(v[i] - v[j]).dot(r_ij) / r_ij.squaredNorm();
      if (rate <= fastest) continue;
      fastest = rate;
      who = fmt::format("particles {} and {}, {:.3g} apart", i, j, r_ij.norm());
    }
  }
  for (std::size_t w = 0; w < geometry_.contacts.size(); ++w) {
    auto const& contacts = geometry_.contacts[w];
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
  for (std::size_t w = 0; w < geometry_.contacts.size(); ++w) {
    WallContacts<Dim> const& contacts = geometry_.contacts[w];
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
double MovingScene<Dim>::volume_defect() const {
  double volume = problem_.domain.extent().prod();
  double length = 0.0;  // between the walls
  for (Wall<Dim> const& wall : walls_)
    length += (wall.point - problem_.domain.lower).dot(wall.outward_normal);
  if (walls_.size() == 2) volume *= length / problem_.domain.extent()[0];
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
  return record;
}

template class MovingScene<1>;
template class MovingScene<2>;
template class MovingScene<3>;

}  // namespace sphverify
