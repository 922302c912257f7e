// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "harness/codes/read_snapshot.hpp"
#include "harness/evaluate/enclosure.hpp"
#include "harness/scene/choices.hpp"

namespace sphverify {

namespace {

constexpr double farthest_position = 1e100;  // [m]

template <int Dim>
Vector<Dim> read_vector(Node const& node) {
  std::vector<double> const values = node.numbers();
  if (values.size() != Dim) node.complain(fmt::format("a list of {} numbers", Dim));
  return Eigen::Map<Vector<Dim> const>(values.data());
}

/// Of a size that squares and cubes to a number.
template <int Dim>
Vector<Dim> read_place(Node const& node) {
  for (Node const& coordinate : node.elements()) coordinate.number_between(-farthest_position, farthest_position);
  return read_vector<Dim>(node);
}

void require_length(Node const& node, std::size_t count) {
  if (!node.is_array() || node.json().size() != count) {
    std::string const found =
        node.is_array() ? fmt::format("a list of {}", node.json().size()) : node.describe();
    throw UserError(node.file(), node.key(), found, fmt::format("a list of {}, one per position", count));
  }
}

template <int Dim>
void read_field(Node const& particles_node, FieldInfo const& field, Particles<Dim>& particles) {
  auto const node = particles_node.find(std::string(field.name));
  if (!node) return;
  require_length(*node, particles.size());
  particles.allocate(field.field);
  auto const elements = node->elements();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (field.is_vector) {
      bool const is_place = field.field == Field::position;
      particles.vector(field.field)
          .set(i, is_place ? read_place<Dim>(elements[i]) : read_vector<Dim>(elements[i]));
    } else if (field.field == Field::mass || field.field == Field::density) {
      particles.scalar(field.field)[i] = elements[i].positive_number();
    } else {
      particles.scalar(field.field)[i] = elements[i].number();
    }
  }
}

template <int Dim>
Wall<Dim> read_wall(Node const& node) {
  node.require_keys(
      {"point", "outward_normal", "pressure", "velocity", "temperature", "conductivity", "flux"});
  Wall<Dim> wall;
  wall.point = read_place<Dim>(node.at("point"));
  wall.outward_normal = read_vector<Dim>(node.at("outward_normal"));
  double const length = wall.outward_normal.norm();
  if (std::abs(length - 1.0) > 1e-6) {
    node.at("outward_normal").complain(fmt::format("a vector of unit length, this one's is {:.6g}", length));
  }
  wall.outward_normal /= length;
  auto const scalar = [&](char const* key) -> ScalarAtWall<Dim> {
    auto const found = node.find(key);
    if (!found) return {};
    return [value = found->number()](Vector<Dim> const&, double) { return value; };
  };
  auto const vector = [&](char const* key) -> VectorAtWall<Dim> {
    auto const found = node.find(key);
    if (!found) return {};
    return [value = read_vector<Dim>(*found)](Vector<Dim> const&, double) { return value; };
  };
  wall.pressure = scalar("pressure");
  wall.temperature = scalar("temperature");
  wall.conductivity = scalar("conductivity");
  wall.velocity = vector("velocity");
  wall.flux = vector("flux");
  if (wall.temperature && !wall.conductivity) node.at("conductivity");  // complains of its absence
  return wall;
}

/// [[lower, upper] or null, ...], one per axis.
template <int Dim>
void read_periodic(Node const& node, Domain<Dim>& domain) {
  auto const axes = node.elements();
  if (axes.size() != Dim) node.complain(fmt::format("a list of {}, one per axis", Dim));
  for (int k = 0; k < Dim; ++k) {
    if (axes[k].is_null()) continue;
    auto const ends = axes[k].numbers();
    for (Node const& end : axes[k].elements()) end.number_between(-farthest_position, farthest_position);
    if (ends.size() != 2 || !(ends[1] > ends[0])) axes[k].complain("[lower, upper] or null");
    domain.periodic[k] = true;
    domain.lower[k] = ends[0];
    domain.upper[k] = ends[1];
  }
}

/// Where a particle's place stands in the document.
template <int Dim>
std::string text_of(Vector<Dim> const& x) {
  return Json(std::vector<double>(x.begin(), x.end())).dump();
}

/// Refuses particles outside their periods, and supports in which a particle would meet two images of
/// another.
template <int Dim>
void require_room(Node const& particles, State<Dim> const& state) {
  SmoothingLength const h(state.particles);
  for (int k = 0; k < Dim; ++k) {
    if (!state.domain.periodic[k]) continue;
    double const lower = state.domain.lower[k];
    double const upper = state.domain.upper[k];
    double const widest = (upper - lower) / (2.0 * state.particles.kernel().support_ratio());
    if (h.largest() > widest) {
      throw UserError(
          particles.file(), particles.key() + ".smoothing_length", fmt::format("{}", h.largest()),
              fmt::format("at most {}: axis {} is periodic, and no shorter than two supports", widest, k));
    }
    // What wraps by adding a period, or writes fewer digits, may end just beyond its end.
    double const rounding = 1e-9 * (upper - lower);
    auto const& x = state.particles.positions().component(k);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < lower - rounding || x[i] > upper + rounding) {
        throw UserError(particles.file(), fmt::format("{}.position[{}]", particles.key(), i),
                        text_of<Dim>(state.particles.positions()[i]),
                        fmt::format("a place within the period of axis {}, {} to {}", k, lower, upper));
      }
    }
  }
}

}  // namespace

void require_state_keys(Node const& document) {
  document.require_document("sphverify-state/1", {"schema", "dimension", "kernel", "pair_weight", "face_weight", "closure", "periodic",
                                                  "particles", "walls", "gamma", "time", "precision", "viscosity"});
}

namespace {

/// What stands in a file beside the document.
Snapshot read_beside(Node const& particles, Kernel const& kernel) {
  Node const file = particles.at("file");
  Json options = Json::object();
  for (char const* key : {"format", "map", "array"}) {
    if (auto const node = particles.find(key)) options[key] = node->json();
  }
  auto const folder = std::filesystem::path(file.file()).parent_path();
  SnapshotOptions const read = read_snapshot_options(Node(options, particles.file(), particles.key()));
  Snapshot snapshot = read_snapshot({(folder / file.string()).lexically_normal().string()}, read);
  convert_lengths(snapshot, LengthConvention::as_format, kernel);
  return snapshot;
}

/// Fields that the document does not give itself.
template <int Dim>
void take_fields(Snapshot const& snapshot, Node const& node, Particles<Dim>& particles) {
  for (FieldInfo const& field : field_infos) {
    std::vector<std::string> columns;
    for (SnapshotColumn const& column : snapshot_columns) {
      if (column.quantity == field.name && columns.size() < static_cast<std::size_t>(field.is_vector ? Dim : 1))
        columns.emplace_back(column.name);
    }
    if (columns.empty() || node.find(std::string(field.name)) || !snapshot.has(columns.front())) continue;
    particles.allocate(field.field);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      auto const found = snapshot.columns.find(columns[k]);
      if (found == snapshot.columns.end())
        throw UserError(snapshot.file, columns[k], "nothing", fmt::format("{} components", Dim));
      for (std::size_t i = 0; i < found->second.size(); ++i) {
        double const value = found->second[i];
        bool const is_positive = field.field == Field::mass || field.field == Field::density;
        bool const is_in_range = std::abs(value) <= farthest_position && (!is_positive || value >= 1.0 / farthest_position);
        if (!is_in_range)
          throw UserError(snapshot.file, columns[k], fmt::format("{:g} of particle {}", value, i),
                          is_positive ? "a number from 1e-100 to 1e100" : "a number of a size up to 1e100");
      }
      (field.is_vector ? particles.vector(field.field).component(static_cast<int>(k)) : particles.scalar(field.field)) =
          found->second;
    }
  }
}

/// One for all, or one each.
template <int Dim>
void read_lengths(Node const& node, std::optional<Snapshot> const& snapshot, Particles<Dim>& particles) {
  auto const given = node.find("smoothing_length");
  if (given && !given->is_array()) return;  // the particles are made with it
  particles.vary_smoothing_length();
  if (given) {
    require_length(*given, particles.size());
    auto const elements = given->elements();
    for (std::size_t i = 0; i < elements.size(); ++i)
      particles.smoothing_lengths()[i] = elements[i].number_between(1.0 / farthest_position, farthest_position);
    return;
  }
  if (!snapshot || !snapshot->has("h")) node.at("smoothing_length");  // complains of its absence
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double const h = snapshot->columns.at("h")[i];
    if (!(h >= 1.0 / farthest_position && h <= farthest_position))
      throw UserError(snapshot->file, "h", fmt::format("{:g} of particle {}", h, i), "a number from 1e-100 to 1e100");
    particles.smoothing_lengths()[i] = h;
  }
}

}  // namespace

template <int Dim>
State<Dim> read_state(Node const& document) {
  Node const node = document.at("particles");
  std::vector<std::string> keys{"smoothing_length", "file", "format", "map", "array"};
  for (FieldInfo const& field : field_infos) {
    constexpr FieldSet computed{Field::acceleration, Field::heating, Field::flux, Field::sound_speed,
                                Field::density_rate, Field::omega};
    if (!computed.contains(field.field) && !pass_fields.contains(field.field)) keys.emplace_back(field.name);
  }
  node.require_keys(keys);
  for (char const* key : {"format", "map", "array"}) {
    if (auto const option = node.find(key); option && !node.find("file")) option->complain("none: it is of a file, and no `file` is named");
  }
  std::string kernel_id(default_kernel(Dim).id());
  if (auto const id = document.find("kernel")) kernel_id = id->word(kernel_words());
  std::optional<Snapshot> snapshot;
  if (node.find("file")) snapshot = read_beside(node, kernel(kernel_id, Dim));
  bool const places_in_file = snapshot && !node.find("position");
  std::size_t const count = places_in_file ? snapshot->size() : node.at("position").elements().size();
  if (count == 0) node.at("position").complain("at least one particle");
  if (snapshot && snapshot->size() != count)
    throw UserError(snapshot->file, "", fmt::format("{} particles", snapshot->size()),
                    fmt::format("{}, as many as {} lists", count, node.at("position").key()));
  auto const length = node.find("smoothing_length");
  double const common =
      length && !length->is_array() ? length->number_between(1.0 / farthest_position, farthest_position) : 1.0;

  State<Dim> state{
      Particles<Dim>(count, common),
      {Vector<Dim>::Zero(), Vector<Dim>::Zero(), {}},
      {},
      DensityRule::given,
      PairWeight::kernel,
      FaceWeight::exact,
      Closure::interpolated};
  state.particles.set_kernel(kernel(kernel_id, Dim));
  if (snapshot) take_fields(*snapshot, node, state.particles);
  if (!snapshot || !snapshot->has("m")) node.at("mass");
  read_lengths(node, snapshot, state.particles);
  for (FieldInfo const& field : field_infos) {
    if (field.field != Field::density) read_field(node, field, state.particles);
  }
  auto const density = node.find("density");
  if (!density && !state.particles.has(Field::density)) node.at("density");  // complains of its absence
  if (density && density->is_string()) {
    state.particles.allocate(Field::density);
    state.density_rule = density_words.value(density->word({"summation", "normalised", "voronoi"}));
  } else if (density) {
    read_field(node, info(Field::density), state.particles);
  }
  if (auto const time = document.find("time")) state.time = time->number();
  bool is_single = false;
  if (auto const precision = document.find("precision")) is_single = precision->word({"single", "double"}) == "single";
  state.rounding = is_single ? single_rounding : 0.5 * std::numeric_limits<double>::epsilon();
  auto const gamma = document.find("gamma");
  if (gamma) state.gamma = gamma->number_between(1.0 + 1e-9, 100.0);
  if (auto const viscosity = document.find("viscosity")) {
    if (!gamma) document.at("gamma");  // complains of its absence: the sound speed
    if (viscosity->is_string()) {
      viscosity->word({"riemann"});
      state.viscosity = RiemannViscosity{state.gamma};
    } else {
      viscosity->require_keys({"alpha", "beta"});
      state.viscosity =
          MonaghanViscosity{viscosity->at("alpha").number_between(0.0, 100.0), viscosity->at("beta").number_between(0.0, 100.0)};
    }
  }
  if (auto const weight = document.find("pair_weight"))
    state.pair_weight = pair_weight_words.value(weight->word(pair_weight_words.all()));
  if (auto const rule = document.find("face_weight")) {
    state.face_weight = face_weight_words.value(rule->word(face_weight_words.all()));
  }
  if (auto const closure = document.find("closure")) {
    state.closure = closure_words.value(closure->word(closure_words.all()));
  }
  if (auto const periodic = document.find("periodic")) read_periodic(*periodic, state.domain);
  if (auto const walls = document.find("walls")) {
    for (Node const& wall : walls->elements()) state.walls.push_back(read_wall<Dim>(wall));
    require_consistent(*walls, state.walls, state.domain);
  }
  require_room(node, state);
  return state;
}

template State<1> read_state<1>(Node const&);
template State<2> read_state<2>(Node const&);
template State<3> read_state<3>(Node const&);

}  // namespace sphverify
