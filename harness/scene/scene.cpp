// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "formulations/basics/parallel.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"
#include "harness/scene/choices.hpp"
#include "harness/scene/initial_particles.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

template <int Dim>
Scene<Dim>::Scene(Problem<Dim> problem, SceneChoice const& choice)
    : problem_(std::move(problem)),
      operator_(make_rate_operator<Dim>(choice.formulation)),
      particles_(0, 1.0),
      closure_(closure_words.value(choice.discretisation.closure)),
      threads_(choice.threads) {
  place_particles(choice);
  find_geometry(choice);
  set_fields();
  if (scheme().least_squares) ++passes_["quadratic-weights"];  // once: nothing moves
}

template <int Dim>
void Scene<Dim>::place_particles(SceneChoice const& choice) {
  InitialParticles<Dim> start =
      initial_particles(problem_, choice.discretisation, choice.resolution, choice.smoothing_ratio, choice.threads);
  ++passes_["layout"];
  spacing_ = start.spacing;
  particles_ = std::move(start.particles);
  cut_cells_ = std::move(start.cut_cells);
  particles_.allocate(needed_fields(scheme()));
  // What the scene itself looks at, whatever the scheme reads.
  particles_.allocate(Field::density);
  if (scheme().rate == Rate::conduction_heating) particles_.allocate(Field::temperature);
}

template <int Dim>
void Scene<Dim>::find_geometry(SceneChoice const& choice) {
  SmoothingLength const h(particles_);
  CellGrid<Dim> const grid(particles_.positions(), problem_.domain, h.kernel().support_ratio() * h.largest());
  DensityRule const rule = density_words.value(choice.discretisation.density);
  bool const by_kernel = pair_weight_words.value(choice.discretisation.pair_weight) == PairWeight::kernel;
  geometry_.domain = problem_.domain;
  VoronoiCells<Dim> cells;
  if (!by_kernel || rule == DensityRule::voronoi) {
    cells = find_voronoi_cells(particles_.positions(), problem_.domain, problem_.walls, threads_, reads_face_offsets(scheme()));
    ++passes_["voronoi-cells"];
  }
  if (by_kernel) {
    geometry_.neighbours = find_neighbours(grid, threads_);
    ++passes_["neighbour-search"];
  }
  set_density(rule, grid, cells.volume);
  auto const& density = particles_.scalar(Field::density);
  if (choice.walls && !problem_.walls.empty()) {
    geometry_.walls = problem_.walls;
    ++passes_["wall-contacts"];
  }
  if (!by_kernel) return weigh_by_cells(geometry_, std::move(cells), grid, h, particles_.masses(), density, threads_);
  FaceWeight const face_weight = face_weight_words.value(choice.discretisation.face_weight);
  for (Wall<Dim> const& wall : geometry_.walls)
    geometry_.contacts.push_back(
        find_wall_contacts(grid, wall, geometry_.walls, h, particles_.masses(), density, face_weight));
  if (!choice.walls || choice.walls.are_terms() || geometry_.walls.empty()) return;
  WallTreatmentPart const* const treatment = find_wall_treatment(choice.walls.word);
  if (!treatment) throw std::invalid_argument("nothing called " + choice.walls.word + " stands behind walls");
  require_room_between_walls(geometry_.walls, h.kernel().support_ratio() * h.largest());
  geometry_.behind = stand_behind_walls(
      treatment->place<Dim>({particles_, problem_.domain, geometry_.walls, grid, spacing_}), geometry_.contacts, particles_, problem_.domain);
  ++passes_[treatment->info->id];
  if (rule != DensityRule::summation) return;
  for (std::size_t w = 0; w < geometry_.walls.size(); ++w) {
    fill_wall_particles(geometry_.behind[w], geometry_.contacts[w], geometry_.walls, particles_, {Field::mass}, 0.0);
    add_density_behind(geometry_.behind[w], geometry_.contacts[w], problem_.domain, threads_, particles_.scalar(Field::density));
  }
}

/// @param cells volumes of the Voronoi cells, where the rule asks for them
template <int Dim>
void Scene<Dim>::set_density(DensityRule rule, CellGrid<Dim> const& grid, std::vector<double> const& cells) {
  SmoothingLength const h(particles_);
  auto& density = particles_.scalar(Field::density);
  if (rule == DensityRule::given) {
    auto const& given = problem_.scalars.at(Field::density);
    for (std::size_t i = 0; i < density.size(); ++i) density[i] = given(particles_.positions()[i], 0.0);
    for (CutCell<Dim> const& cell : cut_cells_) density[cell.particle] = mean_density(problem_, cell);
    return;
  }
  if (rule == DensityRule::voronoi) {
    for (std::size_t i = 0; i < density.size(); ++i) density[i] = particles_.masses()[i] / cells[i];
    return;
  }
  if (geometry_.neighbours.first.empty()) {  // pairs are not the kernel's
    density = summation_density(grid, h, particles_.masses());
  } else {
    sum_density(particles_, geometry_.neighbours, problem_.domain, threads_);
  }
  ++passes_["density-summation"];
  if (rule == DensityRule::normalised && !problem_.walls.empty()) {
    for (std::size_t i = 0; i < density.size(); ++i) {
      density[i] /= kernel_inside(particles_.positions()[i], problem_.walls, h(i), h.kernel());
    }
    ++passes_["density-normalisation"];
  }
}

template <int Dim>
void Scene<Dim>::set_fields() {
  for (auto const& [field, exact] : problem_.scalars) {
    if (field == Field::density || !particles_.has(field)) continue;
    auto& values = particles_.scalar(field);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = exact(particles_.positions()[i], 0.0);
  }
  for (auto const& [field, exact] : problem_.vectors) {
    if (scheme().first_passes.writes().contains(field) || !particles_.has(field)) continue;
    auto& values = particles_.vector(field);
    for (std::size_t i = 0; i < particles_.size(); ++i) values.set(i, exact(particles_.positions()[i], 0.0));
  }
  if (particles_.has(Field::conductivity)) set_conductivity();
}

template <int Dim>
void Scene<Dim>::set_conductivity() {
  fill_conductivity(problem_, particles_.positions(), cut_cells_, particles_.scalar(Field::temperature), threads_,
                    particles_.scalar(Field::conductivity));
  ++passes_["conductivity"];
}

template <int Dim>
void Scene<Dim>::set_temperature(double const* temperature) {
  auto& T = particles_.scalar(Field::temperature);
  std::copy(temperature, temperature + T.size(), T.begin());
  if (problem_.conductivity_depends_on_temperature) set_conductivity();
}

template <int Dim>
void Scene<Dim>::freeze() {
  if (!scheme().difference_form) return;
  operator_->freeze(particles_, geometry_, threads_);
  for (PassInfo const& pass : scheme().first_passes) ++passes_[pass.name];
  ++passes_["conductances"];
  is_frozen_ = true;
}

template <int Dim>
void Scene<Dim>::evaluate(double time) {
  operator_->evaluate(particles_, geometry_, closure_, time, threads_, work_);
  if (!is_frozen_) {
    for (PassInfo const& pass : scheme().first_passes) ++passes_[pass.name];
  }
  ++passes_[scheme().id];
}

template <int Dim>
void Scene<Dim>::heating(double time, double* out) {
  auto const& rate = particles_.scalar(Field::heating);
  std::copy(rate.begin(), rate.end(), out);
  if (!problem_.source) return;
  for_each_row(rate.size(), threads_,
               [&](std::size_t i) { out[i] += problem_.source(particles_.positions()[i], time); });
  ++passes_["source"];
}

template <int Dim>
std::vector<double> Scene<Dim>::wall_power() const {
  return geometry_.contacts.empty() ? std::vector<double>(problem_.walls.size(), 0.0)
                                    : operator_->wall_power();
}

template <int Dim>
std::vector<Vector<Dim>> Scene<Dim>::wall_force() const {
  return geometry_.contacts.empty() ? std::vector<Vector<Dim>>(problem_.walls.size(), Vector<Dim>::Zero())
                                    : operator_->wall_force();
}

template <int Dim>
std::vector<Number> Scene<Dim>::prescribed_wall_power(double time) {
  std::vector<Number> power(geometry_.contacts.size());
  std::vector<double> const areas = wall_areas();
  bool const closes_flux = scheme().boundary.contains(BoundaryValue::flux);
  for (std::size_t w = 0; w < geometry_.contacts.size(); ++w) {
    Wall<Dim> const& wall = geometry_.walls[w];
    WallContacts<Dim> const& contacts = geometry_.contacts[w];
    if (!wall.prescribes(BoundaryValue::flux) && !closes_flux) continue;
    // Mean of F_B . n over the contacts, weighted by the face that each stands for.
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      std::uint32_t const i = contacts.particle[c];
      double const face =
          particles_.masses()[i] / particles_.scalar(Field::density)[i] * contacts.face_weight[c];
      Vector<Dim> const flux = wall.flux ? wall.flux(contacts.foot[c], time) : contacts.flux[c];
      sum += face * flux.dot(contacts.outward_normal);
      weight += face;
    }
    if (weight != 0.0) power[w] = -sum / weight * areas[w];
  }
  return power;
}

template <int Dim>
std::vector<double> Scene<Dim>::exchanged_power(std::vector<Number> const& prescribed) const {
  if (scheme().wall_terms_are_exchange || geometry_.contacts.empty()) return wall_power();
  std::vector<double> power;
  for (Number const& one : prescribed) power.push_back(one.value_or(0.0));
  return power;
}

template <int Dim>
bool Scene<Dim>::exchange_is_known() const {
  return heat_exchange_is_known(scheme(), geometry_);
}

template <int Dim>
double Scene<Dim>::scheme_power() const {
  double power = 0.0;
  auto const& heating = particles_.scalar(Field::heating);
  for (std::size_t i = 0; i < particles_.size(); ++i) power += particles_.masses()[i] * heating[i];
  return power;
}

template <int Dim>
double Scene<Dim>::source_power(double time) {
  if (!problem_.source) return 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    power += particles_.masses()[i] * problem_.source(particles_.positions()[i], time);
  }
  return power;
}

template <int Dim>
std::vector<double> Scene<Dim>::wall_areas() const {
  std::vector<double> areas;
  for (Wall<Dim> const& wall : problem_.walls) areas.push_back(wall_area(problem_.domain, wall));
  return areas;
}

template <int Dim>
SceneRecord Scene<Dim>::record() const {
  SceneRecord record;
  for (FieldInfo const& field : field_infos) {
    if (particles_.has(field.field)) record.fields.emplace_back(field.name);
  }
  for (auto const& [pass, times] : passes_) record.passes.emplace(pass, times);
  return record;
}

template class Scene<1>;
template class Scene<2>;
template class Scene<3>;

}  // namespace sphverify
