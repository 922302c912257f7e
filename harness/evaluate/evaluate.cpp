// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "formulations/basics/finite.hpp"
#include "formulations/density/grad_h.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/walls/finite_face.hpp"
#include "harness/evaluate/enclosure.hpp"
#include "harness/evaluate/state.hpp"
#include "harness/run/exact_fields.hpp"
#include "reports/json/lists_json.hpp"

namespace sphverify {

namespace {

template <int Dim>
Json list(VectorField<Dim> const& field) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < field.size(); ++i) {
    Vector<Dim> const v = field[i];
    rows.push_back(std::vector<double>(v.begin(), v.end()));
  }
  return rows;
}

template <class AField>
std::vector<std::span<double const>> components_of(AField const& field, int count) {
  std::vector<std::span<double const>> all;
  for (int k = 0; k < count; ++k) all.emplace_back(field.component(k));
  return all;
}

/// A field of numbers, of vectors or of tensors, component by component.
template <int Dim>
std::vector<std::span<double const>> values_of(Particles<Dim> const& particles, Field field) {
  if (info(field).is_tensor) return components_of(particles.tensor(field), TensorField<Dim>::components);
  if (info(field).is_vector) return components_of(particles.vector(field), Dim);
  return {particles.scalar(field)};
}

/// What makes little sense of a smoothing length among these particles.
template <int Dim>
Json remarks_on(Particles<Dim> const& particles, NeighbourList const& neighbours, Domain<Dim> const& domain) {
  Json remarks = Json::array();
  std::size_t const n = particles.size();
  if (n < 2) return remarks;
  double const ratio = particles.kernel().support_ratio();
  double const support = ratio * SmoothingLength(particles).largest();
  SmoothingLength const h(particles);
  std::size_t alone = 0;
  for (std::size_t i = 0; i < n; ++i) {
    auto const row = neighbours.row(i);
    // The list reaches as far as the largest support.
    bool const is_alone = std::none_of(row.begin(), row.end(), [&](std::uint32_t j) {
      Vector<Dim> const apart = domain.nearest_image(particles.positions()[i] - particles.positions()[j]);
      return apart.norm() < h.support(i, j);
    });
    alone += is_alone ? 1 : 0;
  }
  if (alone > 0) {
    remarks.push_back(fmt::format("{} of {} particles have no other within their support, {:g}h = {:.3g} m",
                                  alone, n, ratio, support));
  }
  double extent = 0.0;
  for (int k = 0; k < Dim; ++k) {
    auto const [low, high] = std::minmax_element(particles.positions().component(k).begin(),
                                                 particles.positions().component(k).end());
    extent = std::max(extent, *high - *low);
  }
  if (support > extent) {
    remarks.push_back(
        fmt::format("the support, {:g}h = {:.3g} m, is wider than all particles together, {:.3g} m: each "
                    "feels every other",
                    ratio, support, extent));
  }
  return remarks;
}

template <int Dim>
Json rates_of(SchemeInfo const& scheme, Particles<Dim>& particles, PairGeometry<Dim>& geometry,
              Closure closure, double time) {
  auto const rate = make_rate_operator<Dim>(scheme.id);
  particles.allocate(needed_fields(scheme));
  std::string const output(info(output_field(scheme.rate)).name);
  WorkCount work;
  try {
    rate->evaluate(particles, geometry, closure, time, 1, work);
  } catch (UndefinedRate const& error) {
    return {{output, nullptr}, {"reason", error.what()}};
  } catch (std::invalid_argument const& error) {  // a plug-in that says that it failed
    return {{output, nullptr}, {"reason", error.what()}};
  }
  std::string why = why_not_finite(output, values_of(particles, output_field(scheme.rate)));
  for (PassInfo const& pass : scheme.first_passes) {
    if (why.empty()) why = why_not_finite(info(pass.writes).name, values_of(particles, pass.writes));
  }
  if (!why.empty()) return {{output, nullptr}, {"reason", why}};
  Json json;
  if (scheme.rate == Rate::acceleration) {
    json[output] = list(particles.vector(Field::acceleration));
  } else {
    json[output] = particles.scalar(Field::heating);
  }
  for (PassInfo const& pass : scheme.first_passes) {
    if (pass_fields.contains(pass.writes)) continue;  // means something to the scheme alone
    std::string const name(info(pass.writes).name);
    if (info(pass.writes).is_vector) {
      json[name] = list(particles.vector(pass.writes));
    } else {
      json[name] = particles.scalar(pass.writes);
    }
  }
  return json;
}

/// By how much sums of terms as large as these can be off in numbers of that rounding, whatever cancels in them: 128 roundings
/// of a term of the size of the fields over powers of h.
template <int Dim>
double rounding_of_terms(Rate rate, State<Dim> const& state) {
  Particles<Dim> const& particles = state.particles;
  auto const largest = [&](Field field) { return particles.has(field) ? largest_magnitude(particles.scalar(field)) : 0.0; };
  auto const& rho = particles.scalar(Field::density);
  double const least_density = *std::min_element(rho.begin(), rho.end());
  auto const& lengths = particles.smoothing_lengths();
  double const least_length =
      lengths.empty() ? particles.smoothing_length() : *std::min_element(lengths.begin(), lengths.end());
  double term = 0.0;
  switch (rate) {
    case Rate::acceleration:
      term = largest(Field::pressure) / (least_density * least_length);
      break;
    case Rate::internal_work:
    case Rate::total_work:
      for (int k = 0; k < Dim && particles.has(Field::velocity); ++k) {
        double const speed = largest_magnitude(particles.vector(Field::velocity).component(k));
        term = std::max(term, largest(Field::pressure) * speed / (least_density * least_length));
      }
      break;
    case Rate::conduction_heating:
      term = largest(Field::conductivity) * largest(Field::temperature) / (least_density * least_length * least_length);
      break;
    case Rate::density:
      break;
  }
  return 128.0 * state.rounding * term;
}

/// What viscosity adds to the rates of a gas.
template <int Dim>
Json viscous_rates(State<Dim>& state, PairGeometry<Dim>& geometry) {
  Particles<Dim>& particles = state.particles;
  BoundaryValueSet wanted{BoundaryValue::velocity};
  if (particles.has(Field::pressure)) wanted.insert(BoundaryValue::pressure);
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w)
    fill_boundary_values(geometry.contacts[w], geometry.walls[w], particles, wanted, state.closure, state.time);
  ViscousRates<Dim> rates;
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, 1);
  add_viscosity(state.viscosity, particles, sweep, rates);
  sweep.run(particles);
  add_viscous_walls(state.viscosity, particles, geometry, state.closure, SchemeInfo{}.wall_pressure_share, state.time, 1, rates);
  std::string why = why_not_finite("acceleration", components_of(rates.acceleration, Dim));
  if (why.empty()) why = why_not_finite("heating", {rates.heating});
  if (!why.empty()) return {{"acceleration", nullptr}, {"heating", nullptr}, {"reason", why}};
  return {{"acceleration", list(rates.acceleration)}, {"heating", rates.heating}};
}

/// How densities answer to smoothing lengths that follow them: not at all where there is one h for all.
template <int Dim>
void set_omega(State<Dim>& state, CellGrid<Dim> const& grid) {
  Particles<Dim>& particles = state.particles;
  SmoothingLength const h(particles);
  bool const normalised = state.density_rule == DensityRule::normalised;
  if (!h.is_uniform() && !normalised && state.density_rule != DensityRule::summation) return;
  particles.allocate(Field::omega);
  particles.scalar(Field::omega).assign(particles.size(), 1.0);
  if (h.is_uniform()) return;
  std::vector<Wall<Dim>> const none;
  particles.scalar(Field::omega) =
      grad_h_terms(grid, h, particles.masses(), particles.scalar(Field::density), normalised ? state.walls : none, 1);
}

/// What an ideal gas has beside what the state gives, once its density is known.
template <int Dim>
void complete_gas(State<Dim>& state) {
  if (state.gamma == 0.0) return;
  Particles<Dim>& particles = state.particles;
  auto const& rho = particles.scalar(Field::density);
  if (!particles.has(Field::pressure) && particles.has(Field::internal_energy)) {
    particles.allocate(Field::pressure);
    for (std::size_t i = 0; i < rho.size(); ++i)
      particles.scalar(Field::pressure)[i] = (state.gamma - 1.0) * rho[i] * particles.scalar(Field::internal_energy)[i];
  }
  if (!particles.has(Field::pressure)) return;
  particles.allocate(Field::sound_speed);
  for (std::size_t i = 0; i < rho.size(); ++i) {
    particles.scalar(Field::sound_speed)[i] =
        std::sqrt(state.gamma * std::max(particles.scalar(Field::pressure)[i], 0.0) / rho[i]);
  }
}

/// Why a scheme cannot be evaluated on a state; empty if it can.
template <int Dim>
std::string missing_field(SchemeInfo const& scheme, State<Dim> const& state) {
  for (FieldInfo const& field : field_infos) {
    if (fields_read(scheme).contains(field.field) && !state.particles.has(field.field)) {
      if (field.field == Field::omega)
        return "how the density answers to each particle's h is known of summation and normalised only";
      return fmt::format("the state gives no {}", field.name);
    }
  }
  return std::string(state.pair_weight == PairWeight::kernel ? why_no_kernel_weights(scheme) : why_no_pair_weights(scheme));
}

template <int Dim>
Json evaluate_in_dimension(Node const& document, std::set<std::string> const& only) {
  State<Dim> state = read_state<Dim>(document);
  Particles<Dim>& particles = state.particles;
  SmoothingLength const h(particles);
  Kernel const& kernel = particles.kernel();
  PairGeometry<Dim> geometry;
  Json walls = Json::array();
  Json remarks;
  try {
    CellGrid<Dim> const grid(particles.positions(), state.domain, kernel.support_ratio() * h.largest());
    geometry.domain = state.domain;
    bool const by_kernel = state.pair_weight == PairWeight::kernel;
    VoronoiCells<Dim> cells;
    if (!by_kernel || state.density_rule == DensityRule::voronoi)
      cells = find_voronoi_cells(particles.positions(), state.domain, state.walls, 1, true);
    geometry.neighbours = find_neighbours(grid);
    remarks = remarks_on(particles, geometry.neighbours, state.domain);
    auto& density = particles.scalar(Field::density);
    if (state.density_rule == DensityRule::voronoi) {
      for (std::size_t i = 0; i < density.size(); ++i) density[i] = particles.masses()[i] / cells.volume[i];
    } else if (state.density_rule != DensityRule::given) {
      density = summation_density(grid, h, particles.masses());
    }
    if (state.density_rule == DensityRule::normalised) {
      for (std::size_t i = 0; i < density.size(); ++i) {
        density[i] /= kernel_inside(particles.positions()[i], state.walls, h(i), kernel);
      }
    }
    set_omega(state, grid);
    geometry.walls = state.walls;
    if (by_kernel) {
      for (Wall<Dim> const& wall : state.walls)
        geometry.contacts.push_back(
            find_wall_contacts(grid, wall, state.walls, h, particles.masses(), density, state.face_weight));
    } else {
      weigh_by_cells(geometry, std::move(cells), grid, h, particles.masses(), density, 1);
    }
    for (WallContacts<Dim> const& contacts : geometry.contacts) {
      std::vector<double> at_foot(particles.size()), weight(particles.size(), 0.0);
      for (std::size_t i = 0; i < particles.size(); ++i) {
        auto const foot = nearest_on_face(particles.positions()[i], state.walls, walls.size(), h(i));
        at_foot[i] = foot ? foot_density(grid, *foot, state.walls, h(i), particles.masses(), kernel) : 0.0;
      }
      for (std::size_t c = 0; c < contacts.size(); ++c)
        weight[contacts.particle[c]] = contacts.face_weight[c];
      walls.push_back({{"density_at_foot", at_foot}, {"face_weight", weight}});
    }
  } catch (std::invalid_argument const& error) {
    throw UserError(fmt::format("{}: particles.position: {}", document.file(), error.what()));
  }

  complete_gas(state);

  Json rates = Json::object();
  Json left_out = Json::object();
  Json rounding = Json::object();
  // With wall terms first; the contacts are then taken away for the controls.
  for (std::string const suffix : {"", "-no-walls"}) {
    if (!suffix.empty()) geometry.contacts.clear();
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      std::string const id = std::string(scheme->id) + suffix;
      if (!only.empty() && !only.contains(id)) continue;
      if (std::string const reason = missing_field(*scheme, state); !reason.empty()) {
        left_out[id] = reason;
      } else {
        rates[id] = rates_of(*scheme, particles, geometry, state.closure, state.time);
        rounding[id] = number(rounding_of_terms(scheme->rate, state));
      }
    }
    bool const is_riemann = std::holds_alternative<RiemannViscosity>(state.viscosity);
    std::string const id = (is_riemann ? "viscosity/riemann" : "viscosity/monaghan") + std::string(suffix);
    if (!is_on(state.viscosity) || (!only.empty() && !only.contains(id))) continue;
    if (particles.has(Field::velocity) && particles.has(Field::sound_speed)) {
      rates[id] = viscous_rates(state, geometry);
    } else {
      left_out[id] = "the state gives no velocity, or neither pressure nor internal energy";
    }
  }
  std::optional<Vector<Dim>> open;
  if (!state.walls.empty()) open = open_direction(state.walls, state.domain);
  return {{"schema", "sphverify-rates/1"},
          {"density", particles.scalar(Field::density)},
          {"walls", walls},
          {"open_towards", open ? Json(std::vector<double>(open->begin(), open->end())) : Json()},
          {"remarks", remarks},
          {"round_off", rounding},
          {"rates", rates},
          {"left_out", left_out}};
}

}  // namespace

Json evaluate_state(Node const& state, std::set<std::string> const& only) {
  require_state_keys(state);
  switch (state.at("dimension").integer(1, 3)) {
    case 1:
      return evaluate_in_dimension<1>(state, only);
    case 2:
      return evaluate_in_dimension<2>(state, only);
    default:
      return evaluate_in_dimension<3>(state, only);
  }
}

}  // namespace sphverify
