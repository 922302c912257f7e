// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/scene/choices.hpp"
#include "harness/scene/initial_particles.hpp"
#include "harness/scene/place.hpp"

namespace sphverify {

namespace {

Viscosity viscosity_of(ViscosityChoice const& choice, double gamma) {
  if (choice.riemann) return RiemannViscosity{gamma};
  return MonaghanViscosity{choice.alpha, choice.beta};
}

template <int Dim>
std::unique_ptr<RateOperator<Dim>> operator_if_named(std::string const& id) {
  return id.empty() ? nullptr : make_rate_operator<Dim>(id);
}

/// Which pairs some of them need.
template <int Dim>
PairSupport widest_support(std::initializer_list<RateOperator<Dim> const*> operators) {
  bool const larger = std::any_of(operators.begin(), operators.end(), [](RateOperator<Dim> const* one) {
    return one && pair_support(one->info()) == PairSupport::larger;
  });
  return larger ? PairSupport::larger : PairSupport::mean;
}

}  // namespace

template <int Dim>
MovingScene<Dim>::MovingScene(Problem<Dim> problem, SceneChoice const& choice)
    : problem_(std::move(problem)),
      momentum_operator_(make_rate_operator<Dim>(choice.formulation)),
      work_operator_(make_rate_operator<Dim>(choice.work)),
      conduction_operator_(operator_if_named<Dim>(choice.conduction)),
      viscosity_(viscosity_of(choice.discretisation.viscosity, problem_.gamma)),
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
                                  .threads = choice.threads,
                                  .pair_weight = pair_weight_words.value(choice.discretisation.pair_weight),
                                  .behind_walls = find_wall_treatment(choice.walls.word),
                                  .spacing = spacing_of(problem_.domain, choice.discretisation.layout, choice.resolution),
                                  .face_offsets = read_face_offsets(),
                                  .support = widest_support<Dim>({momentum_operator_.get(), work_operator_.get(),
                                                                  conduction_operator_.get()})}) {
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
  InitialParticles<Dim> start =
      initial_particles(problem_, choice.discretisation, choice.resolution, choice.smoothing_ratio, choice.threads);
  ++passes_["layout"];
  spacing_ = start.spacing;
  particles_ = std::move(start.particles);
  cut_cells_ = std::move(start.cut_cells);
  std::size_t const n = particles_.size();
  particles_.allocate(
      {Field::density, Field::velocity, Field::pressure, Field::internal_energy, Field::sound_speed});
  particles_.allocate(needed_fields(momentum_operator_->info()));
  particles_.allocate(needed_fields(work_operator_->info()));
  if (conduction_operator_) {
    particles_.allocate(needed_fields(conduction_operator_->info()));
    particles_.allocate({Field::temperature, Field::conductivity});  // which limit a step, whatever the form reads
  }
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

template <int Dim>
std::vector<double> MovingScene<Dim>::initial_state() {
  std::size_t const n = particles_.size();
  std::vector<double> state;
  state.reserve(unknowns());
  // Of the places where the layout put them, as long as no state was loaded.
  VectorField<Dim> const& x = particles_.positions();
  InitialGas<Dim> const gas = initial_gas(problem_, particles_, cut_cells_);
  for (VectorField<Dim> const* field : {&x, &gas.velocity}) {
    for (int k = 0; k < Dim; ++k) {
      state.insert(state.end(), field->component(k).begin(), field->component(k).end());
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    double const internal = gas.internal_energy[i];
    state.push_back(evolves_total_energy() ? internal + 0.5 * gas.velocity[i].squaredNorm() : internal);
  }
  if (has_continuity()) state.insert(state.end(), gas.density.begin(), gas.density.end());
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
std::size_t MovingScene<Dim>::bytes(bool drifts) const {
  auto const of = [](VectorField<Dim> const& field) { return Dim * field.component(0).capacity(); };
  std::size_t numbers = of(drift_) + of(acceleration_) + energy_rate_.capacity() + of(viscous_.acceleration) +
                        viscous_.heating.capacity() + viscous_.largest_mu.capacity();
  FieldSet reads{Field::mass};
  for (RateOperator<Dim> const* const one : {momentum_operator_.get(), work_operator_.get(), continuity_operator_.get()}) {
    if (one) reads = reads | one->info().reads | one->info().first_passes.writes();
  }
  if (is_on(viscosity_)) reads = reads | FieldSet{Field::density, Field::velocity, Field::sound_speed};
  numbers += particles_.size() * record_slots(reads, Dim, adaptive_, drifts && is_on(viscosity_)).stride();
  return particles_.bytes() + geometry_.bytes() + sizeof(double) * numbers + sizeof(std::size_t) * order_.capacity();
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
