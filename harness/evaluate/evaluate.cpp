#include "harness/evaluate/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "formulations/basics/finite.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/walls/finite_face.hpp"
#include "harness/evaluate/enclosure.hpp"
#include "harness/evaluate/state.hpp"

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
Json remarks_on(Particles<Dim> const& particles, NeighbourList const& neighbours) {
  Json remarks = Json::array();
  std::size_t const n = particles.size();
  if (n < 2) return remarks;
  double const ratio = particles.kernel().support_ratio();
  double const support = ratio * particles.smoothing_length();
  std::size_t alone = 0;
  for (std::size_t i = 0; i < n; ++i) alone += neighbours.row(i).empty() ? 1 : 0;
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
              Closure closure) {
  auto const rate = make_rate_operator<Dim>(scheme.id);
  particles.allocate(needed_fields(scheme));
  std::string const output(info(output_field(scheme.rate)).name);
  WorkCount work;
  try {
    rate->evaluate(particles, geometry, closure, 0.0, 1, work);
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

/// Why a scheme cannot be evaluated on a state; empty if it can.
template <int Dim>
std::string missing_field(SchemeInfo const& scheme, State<Dim> const& state) {
  for (FieldInfo const& field : field_infos) {
    if (fields_read(scheme).contains(field.field) && !state.particles.has(field.field)) {
      return fmt::format("the state gives no {}", field.name);
    }
  }
  return "";
}

template <int Dim>
Json evaluate_in_dimension(Node const& document) {
  State<Dim> state = read_state<Dim>(document);
  Particles<Dim>& particles = state.particles;
  double const h = particles.smoothing_length();
  SmoothingLength const smoothing(particles);
  Kernel const& kernel = particles.kernel();
  PairGeometry<Dim> geometry;
  Json walls = Json::array();
  Json remarks;
  try {
    CellGrid<Dim> const grid(particles.positions(), state.domain, smoothing.support(0));
    geometry.domain = state.domain;
    geometry.neighbours = find_neighbours(grid);
    remarks = remarks_on(particles, geometry.neighbours);
    auto& density = particles.scalar(Field::density);
    if (state.density_rule != DensityRule::given)
      density = summation_density(grid, smoothing, particles.masses());
    if (state.density_rule == DensityRule::normalised) {
      for (std::size_t i = 0; i < density.size(); ++i) {
        density[i] /= kernel_inside(particles.positions()[i], state.walls, h, kernel);
      }
    }
    geometry.walls = state.walls;
    for (Wall<Dim> const& wall : state.walls) {
      geometry.contacts.push_back(find_wall_contacts(grid, wall, state.walls, smoothing, particles.masses(),
                                                     density, state.face_weight));
      WallContacts<Dim> const& contacts = geometry.contacts.back();
      std::vector<double> at_foot(particles.size()), weight(particles.size(), 0.0);
      for (std::size_t i = 0; i < particles.size(); ++i) {
        auto const foot = nearest_on_face(particles.positions()[i], state.walls, walls.size(), h);
        at_foot[i] = foot ? foot_density(grid, *foot, state.walls, h, particles.masses(), kernel) : 0.0;
      }
      for (std::size_t c = 0; c < contacts.size(); ++c)
        weight[contacts.particle[c]] = contacts.face_weight[c];
      walls.push_back({{"density_at_foot", at_foot}, {"face_weight", weight}});
    }
  } catch (std::invalid_argument const& error) {
    throw UserError(fmt::format("{}: particles.position: {}", document.file(), error.what()));
  }

  Json rates = Json::object();
  Json left_out = Json::object();
  // With wall terms first; the contacts are then taken away for the controls.
  for (std::string const suffix : {"", "-no-walls"}) {
    if (!suffix.empty()) geometry.contacts.clear();
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      std::string const id = std::string(scheme->id) + suffix;
      if (std::string const reason = missing_field(*scheme, state); !reason.empty()) {
        left_out[id] = reason;
      } else {
        rates[id] = rates_of(*scheme, particles, geometry, state.closure);
      }
    }
  }
  std::optional<Vector<Dim>> open;
  if (!state.walls.empty()) open = open_direction(state.walls, state.domain);
  return {{"schema", "sphverify-rates/1"},
          {"density", particles.scalar(Field::density)},
          {"walls", walls},
          {"open_towards", open ? Json(std::vector<double>(open->begin(), open->end())) : Json()},
          {"remarks", remarks},
          {"rates", rates},
          {"left_out", left_out}};
}

}  // namespace

Json evaluate_state(Node const& state) {
  require_state_keys(state);
  switch (state.at("dimension").integer(1, 3)) {
    case 1:
      return evaluate_in_dimension<1>(state);
    case 2:
      return evaluate_in_dimension<2>(state);
    default:
      return evaluate_in_dimension<3>(state);
  }
}

}  // namespace sphverify
