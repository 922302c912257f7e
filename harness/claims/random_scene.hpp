// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/rate_operator.hpp"

// Particles that carry every field, with walls, and the rates of one scheme on them: what a scheme is held to its claims on,
// and what the tests of schemes start from.
namespace sphverify::claims {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  template <int Dim>
  Vector<Dim> vector(double low, double high) {
    Vector<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = uniform(low, high);
    return v;
  }
  template <int Dim>
  Vector<Dim> direction() {
    while (true) {
      Vector<Dim> const v = vector<Dim>(-1.0, 1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v / v.norm();
    }
  }
  /// Mirror image in a plane through the origin.
  template <int Dim>
  Matrix<Dim> reflection() {
    Vector<Dim> const n = direction<Dim>();
    return Matrix<Dim>::Identity() - 2.0 * n * n.transpose();
  }
  /// Rotation by an arbitrary angle; the identity in 1D.
  template <int Dim>
  Matrix<Dim> rotation() {
    Matrix<Dim> const first = reflection<Dim>();
    return reflection<Dim>() * first;
  }

 private:
  std::mt19937_64 engine_;
};

template <int Dim>
struct RandomScene {
  Particles<Dim> particles;
  Domain<Dim> domain;
  std::vector<Wall<Dim>> walls{};
  FaceWeight face_weight = FaceWeight::exact;
  Closure closure = Closure::interpolated;
  double time = 0.4;
  std::vector<Wall<Dim>> enclosure{};  ///< where cells end that no wall bounds, without being felt
};

/// The sides of a box.
template <int Dim>
std::vector<Wall<Dim>> sides_of(Vector<Dim> const& lower, Vector<Dim> const& upper) {
  std::vector<Wall<Dim>> sides;
  for (int k = 0; k < Dim; ++k) {
    sides.push_back({.point = lower, .outward_normal = -Vector<Dim>::Unit(k)});
    sides.push_back({.point = upper, .outward_normal = Vector<Dim>::Unit(k)});
  }
  return sides;
}

inline constexpr FieldSet all_fields{Field::position,     Field::mass,         Field::density,
                                     Field::velocity,     Field::pressure,     Field::internal_energy,
                                     Field::temperature,  Field::conductivity, Field::flux,
                                     Field::acceleration, Field::heating,      Field::sound_speed,
                                     Field::omega};

/// Lets a wall prescribe values that vary along it and with time; positive but for velocity and flux.
template <int Dim>
void prescribe(Wall<Dim>& wall, BoundaryValueSet values, Random& random) {
  auto const scalar = [&random]() -> ScalarAtWall<Dim> {
    return
        [mean = random.uniform(0.8, 1.6), amplitude = random.uniform(0.1, 0.4),
         wave = random.vector<Dim>(-3.0, 3.0), rate = random.uniform(1.0, 3.0)](
            Vector<Dim> const& x, double t) { return mean + amplitude * std::sin(wave.dot(x) + rate * t); };
  };
  auto const vector = [&random]() -> VectorAtWall<Dim> {
    return [mean = random.vector<Dim>(-1.0, 1.0), amplitude = random.vector<Dim>(-0.4, 0.4),
            wave = random.vector<Dim>(-3.0, 3.0),
            rate = random.uniform(1.0, 3.0)](Vector<Dim> const& x, double t) -> Vector<Dim> {
      return mean + amplitude * std::sin(wave.dot(x) + rate * t);
    };
  };
  if (values.contains(BoundaryValue::pressure)) wall.pressure = scalar();
  if (values.contains(BoundaryValue::velocity)) wall.velocity = vector();
  if (values.contains(BoundaryValue::temperature)) {
    wall.temperature = scalar();
    wall.conductivity = scalar();
  }
  if (values.contains(BoundaryValue::flux)) wall.flux = vector();
}

inline constexpr BoundaryValueSet no_flux{BoundaryValue::pressure, BoundaryValue::velocity,
                                          BoundaryValue::temperature, BoundaryValue::conductivity};

/// Fills every field with numbers of order one; density, pressure, temperature and conductivity are positive
/// and independent of each other and of where the particles are.
template <int Dim>
void randomise_fields(Particles<Dim>& particles, Random& random) {
  particles.allocate(all_fields);
  auto const n = static_cast<double>(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.masses()[i] = random.uniform(0.7, 1.3) / n;
    particles.scalar(Field::density)[i] = random.uniform(0.7, 1.4);
    particles.scalar(Field::pressure)[i] = random.uniform(0.5, 2.0);
    particles.scalar(Field::temperature)[i] = random.uniform(0.5, 2.0);
    particles.scalar(Field::conductivity)[i] = random.uniform(0.3, 1.2);
    particles.scalar(Field::internal_energy)[i] = random.uniform(0.5, 2.0);
    particles.vector(Field::velocity).set(i, random.vector<Dim>(-1.0, 1.0));
  }
  Random of_sound(17);  // by itself, so that other fields are what they were without it
  for (double& c : particles.scalar(Field::sound_speed)) c = of_sound.uniform(0.3, 2.0);
  Random of_omega(19);  // likewise
  for (double& omega : particles.scalar(Field::omega)) omega = of_omega.uniform(0.7, 1.4);
}

/// Particles at random places of the unit box between two walls of random orientation (so that in more than
/// one dimension they meet in a corner), the first particle 0.2 h from each.
template <int Dim>
RandomScene<Dim> random_scene(std::uint64_t seed, std::size_t count, BoundaryValueSet first = no_flux,
                              BoundaryValueSet second = no_flux) {
  Random random(seed);
  double const h = 1.3 * std::pow(static_cast<double>(count), -1.0 / Dim);
  RandomScene<Dim> scene{.particles = Particles<Dim>(count, h),
                         .domain = {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()}};
  scene.enclosure = sides_of<Dim>(Vector<Dim>::Constant(-0.1), Vector<Dim>::Constant(1.1));
  for (std::size_t i = 0; i < count; ++i) scene.particles.positions().set(i, random.vector<Dim>(0.0, 1.0));
  randomise_fields(scene.particles, random);
  Vector<Dim> normal = random.direction<Dim>();
  for (BoundaryValueSet const values : {first, second}) {
    double furthest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i)
      furthest = std::max(furthest, scene.particles.positions()[i].dot(normal));
    Wall<Dim> wall{.point = (furthest + 0.2 * h) * normal, .outward_normal = normal};
    prescribe(wall, values, random);
    scene.walls.push_back(wall);
    normal = Dim == 1 ? Vector<Dim>(-normal) : random.direction<Dim>();
  }
  return scene;
}

/// The same with a kernel and this many particles.
inline constexpr std::size_t usual_count = 60;
template <int Dim>
RandomScene<Dim> random_scene(Kernel const& kernel, std::uint64_t seed) {
  RandomScene<Dim> scene = random_scene<Dim>(seed, usual_count);
  scene.particles.set_kernel(kernel);
  return scene;
}

/// A cubic lattice of `side` particles per axis around the origin, with volumes dx^Dim and unit density.
/// No walls; only positions, masses and density are set.
template <int Dim>
RandomScene<Dim> lattice_scene(int side, double spacing, double smoothing_ratio) {
  std::size_t count = 1;
  for (int k = 0; k < Dim; ++k) count *= static_cast<std::size_t>(side);
  Vector<Dim> const corner = Vector<Dim>::Constant(0.5 * spacing * side);
  RandomScene<Dim> scene{.particles = Particles<Dim>(count, smoothing_ratio * spacing),
                         .domain = {.lower = -corner, .upper = corner}};
  scene.enclosure = sides_of<Dim>(-corner, corner);
  scene.particles.allocate(all_fields);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t rest = i;
    Vector<Dim> x;
    for (int k = 0; k < Dim; ++k) {
      x[k] = spacing * (static_cast<double>(rest % side) - 0.5 * (side - 1));
      rest /= side;
    }
    scene.particles.positions().set(i, x);
    scene.particles.masses()[i] = std::pow(spacing, Dim);
    scene.particles.scalar(Field::density)[i] = 1.0;
    scene.particles.scalar(Field::omega)[i] = 1.0;
  }
  return scene;
}

/// The same scene turned by an orthogonal matrix and moved.
template <int Dim>
RandomScene<Dim> transformed(RandomScene<Dim> scene, Matrix<Dim> const& turn, Vector<Dim> const& shift) {
  auto& positions = scene.particles.positions();
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    positions.set(i, turn * positions[i] + shift);
    auto& velocities = scene.particles.vector(Field::velocity);
    velocities.set(i, turn * velocities[i]);
  }
  auto const back = [turn, shift](Vector<Dim> const& x) -> Vector<Dim> {
    return turn.transpose() * (x - shift);
  };
  for (Wall<Dim>& wall : scene.walls) {
    wall.point = turn * wall.point + shift;
    wall.outward_normal = turn * wall.outward_normal;
    for (auto* value : {&wall.pressure, &wall.temperature, &wall.conductivity}) {
      if (*value) *value = [old = *value, back](Vector<Dim> const& x, double t) { return old(back(x), t); };
    }
    for (auto* value : {&wall.velocity, &wall.flux}) {
      if (!*value) continue;
      *value = [old = *value, back, turn](Vector<Dim> const& x, double t) -> Vector<Dim> {
        return turn * old(back(x), t);
      };
    }
  }
  for (Wall<Dim>& side : scene.enclosure) {
    side.point = turn * side.point + shift;
    side.outward_normal = turn * side.outward_normal;
  }
  return scene;
}

/// Neighbours and wall contacts, by the particles' own smoothing lengths where they have such.
template <int Dim>
PairGeometry<Dim> geometry_of(RandomScene<Dim> const& scene, bool with_walls = true, PairSupport support = PairSupport::mean) {
  SmoothingLength const h(scene.particles);
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain,
                           h.kernel().support_ratio() * h.largest());
  PairGeometry<Dim> geometry;
  geometry.domain = scene.domain;
  geometry.neighbours = find_neighbours(grid, h, 0.0, 1, {}, support);
  geometry.walls = scene.walls;
  for (std::size_t w = 0; with_walls && w < scene.walls.size(); ++w) {
    geometry.contacts.push_back(
        find_wall_contacts(grid, scene.walls[w], scene.walls, h, scene.particles.masses(),
                           scene.particles.scalar(Field::density), scene.face_weight));
  }
  return geometry;
}

/// Pairs and contacts by the faces of cells, which end at the walls whether these are felt or not.
template <int Dim>
PairGeometry<Dim> faces_of(RandomScene<Dim> const& scene, bool with_walls = true) {
  Particles<Dim> const& p = scene.particles;
  SmoothingLength const h(p);
  CellGrid<Dim> const grid(p.positions(), scene.domain, h.kernel().support_ratio() * h.largest());
  std::vector<Wall<Dim>> bounds;  // none of a periodic box
  if (!scene.domain.is_periodic()) {
    bounds = scene.walls;
    bounds.insert(bounds.end(), scene.enclosure.begin(), scene.enclosure.end());
  }
  PairGeometry<Dim> geometry;
  geometry.domain = scene.domain;
  if (!bounds.empty()) geometry.walls = scene.walls;
  weigh_by_cells(geometry, find_voronoi_cells(p.positions(), scene.domain, bounds, 1, true), grid, h, p.masses(),
                 p.scalar(Field::density), 1);
  if (!with_walls) geometry.contacts.clear();
  return geometry;
}

/// That of the two which the scheme can read.
template <int Dim>
PairGeometry<Dim> geometry_for(std::string_view id, RandomScene<Dim> const& scene, bool with_walls = true) {
  SchemeInfo const* const scheme = find_scheme(id);
  return scheme && reads_face_offsets(*scheme) ? faces_of(scene, with_walls) : geometry_of(scene, with_walls);
}

/// What one evaluation of a scheme gave: `acceleration` or `heating`, and `flux` of a two-pass form.
template <int Dim>
struct Rates {
  std::vector<Vector<Dim>> acceleration;
  std::vector<double> heating;
  std::vector<Vector<Dim>> flux;
  std::vector<Vector<Dim>> wall_force;
  std::vector<double> wall_power;
  WorkCount work;

  /// All numbers of the rate in one list.
  std::vector<double> numbers() const {
    std::vector<double> list = heating;
    for (Vector<Dim> const& a : acceleration) list.insert(list.end(), a.data(), a.data() + Dim);
    return list;
  }
};

template <int Dim>
Rates<Dim> evaluate(RandomScene<Dim> scene, std::string_view id, PairGeometry<Dim> geometry,
                    int threads = 1) {
  auto const scheme = make_rate_operator<Dim>(id);
  scene.particles.allocate(needed_fields(scheme->info()));
  Rates<Dim> rates;
  scheme->evaluate(scene.particles, geometry, scene.closure, scene.time, threads, rates.work);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    if (scheme->info().rate == Rate::acceleration) {
      rates.acceleration.push_back(scene.particles.vector(Field::acceleration)[i]);
    } else {
      rates.heating.push_back(scene.particles.scalar(Field::heating)[i]);
    }
    if (scheme->info().first_passes.writes().contains(Field::flux))
      rates.flux.push_back(scene.particles.vector(Field::flux)[i]);
  }
  rates.wall_force = scheme->wall_force();
  rates.wall_power = scheme->wall_power();
  return rates;
}

/// The same with so wide a kernel that particles at random have others on all sides.
template <int Dim>
RandomScene<Dim> widened(RandomScene<Dim> scene) {
  Particles<Dim> const& narrow = scene.particles;
  Particles<Dim> wide(narrow.size(), 2.5 * narrow.smoothing_length());
  wide.set_kernel(narrow.kernel());
  for (FieldInfo const& field : field_infos) {
    if (!narrow.has(field.field) || field.is_tensor) continue;
    wide.allocate(field.field);
    if (field.is_vector) {
      wide.vector(field.field) = narrow.vector(field.field);
    } else {
      wide.scalar(field.field) = narrow.scalar(field.field);
    }
  }
  scene.particles = std::move(wide);
  return scene;
}

/// A scheme that needs partners on all sides is given them.
template <int Dim>
Rates<Dim> evaluate(RandomScene<Dim> const& scene, std::string_view id, bool with_walls = true,
                    int threads = 1) {
  if (SchemeInfo const* const scheme = find_scheme(id); scheme && scheme->needs_partners) {
    RandomScene<Dim> const wide = widened(scene);
    return evaluate(wide, id, geometry_of(wide, with_walls), threads);
  }
  return evaluate(scene, id, geometry_for(id, scene, with_walls), threads);
}

inline double largest(std::vector<double> const& values) {
  double most = 0.0;
  for (double const value : values) most = std::isfinite(value) ? std::max(most, std::abs(value)) : INFINITY;
  return most;
}
template <int Dim>
double largest(std::vector<Vector<Dim>> const& values) {
  double most = 0.0;
  for (Vector<Dim> const& value : values) {
    most = value.allFinite() ? std::max(most, value.cwiseAbs().maxCoeff()) : INFINITY;
  }
  return most;
}

/// Largest difference relative to the largest of `expected`; infinite where a number is not finite or one is
/// missing.
template <class Value>
double relative_difference(std::vector<Value> const& found, std::vector<Value> const& expected) {
  if (found.size() != expected.size()) return INFINITY;
  // What is no number is as far off as can be, even from itself.
  if (!std::isfinite(largest(found)) || !std::isfinite(largest(expected))) return INFINITY;
  std::vector<Value> difference = found;
  for (std::size_t i = 0; i < found.size(); ++i) difference[i] -= expected[i];
  double const most = largest(difference);
  return most == 0.0 ? 0.0 : most / largest(expected);
}

}  // namespace sphverify::claims
