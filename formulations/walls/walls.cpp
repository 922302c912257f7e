// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/walls.hpp"

#include <algorithm>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <string>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/basics/readable.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/walls/finite_face.hpp"
#include "formulations/walls/wall_heat_balance.hpp"
#include "formulations/walls/wall_riemann.hpp"

namespace sphverify {

template <int Dim>
bool Wall<Dim>::prescribes(BoundaryValue value) const {
  switch (value) {
    case BoundaryValue::pressure:
      return static_cast<bool>(pressure);
    case BoundaryValue::velocity:
      return static_cast<bool>(velocity);
    case BoundaryValue::temperature:
      return static_cast<bool>(temperature);
    case BoundaryValue::conductivity:
      return static_cast<bool>(conductivity);
    case BoundaryValue::flux:
      return flux || heat_loss;
  }
  return false;
}

template <int Dim>
bool Wall<Dim>::prescribes_flux_only() const {
  return prescribes(BoundaryValue::flux) && !prescribes(BoundaryValue::temperature);
}

template <int Dim>
std::size_t WallContacts<Dim>::bytes() const {
  std::size_t const doubles = distance.capacity() + face_weight.capacity() + foot_density.capacity() +
                              pressure.capacity() + temperature.capacity() + conductivity.capacity() +
                              interpolation_kernel.capacity() +
                              Dim * (foot.size() + offset.size() + velocity.size() + flux.size());
  return sizeof(double) * doubles +
         sizeof(std::uint32_t) * (particle.capacity() + interpolation_neighbour.capacity()) +
         sizeof(std::size_t) * interpolation_first.capacity();
}

template <int Dim>
double face_weight(double d, double h, FaceWeight rule, Kernel const& kernel) {
  if (rule != FaceWeight::campbell) return kernel.plane_integral(d, h);
  double const support = kernel.support_ratio() * h;
  if (d >= support) return 0.0;
  double const squared_radius =
      square(support) - d * d;  // of the disc that the support cuts out of the plane
  double const area = Dim == 1   ? 1.0
                      : Dim == 2 ? 2.0 * std::sqrt(squared_radius)
                                 : std::numbers::pi * squared_radius;
  return kernel.value(d, h) * area;
}

template <int Dim>
double foot_density(CellGrid<Dim> const& grid, Vector<Dim> const& foot, std::vector<Wall<Dim>> const& walls,
                    double h, std::vector<double> const& mass, Kernel const& kernel) {
  double const factor = wall_interpolation_factor(foot, walls, h, kernel);
  double sum = 0.0;
  grid.for_each_within_reach(foot, [&](std::uint32_t j, Vector<Dim> const&, double distance) {
    sum += mass[j] * (factor * kernel.value(distance, h));
  });
  return sum;
}

template <int Dim>
double add_foot_interpolation(WallContacts<Dim>& contacts, CellGrid<Dim> const& grid, Vector<Dim> const& foot,
                         std::vector<Wall<Dim>> const& walls, double h, std::vector<double> const& mass,
                         Kernel const& kernel) {
  double const factor = wall_interpolation_factor(foot, walls, h, kernel);
  std::size_t const before = contacts.interpolation_neighbour.size();
  double sum = 0.0;
  grid.for_each_within_reach(foot, [&](std::uint32_t j, Vector<Dim> const&, double distance) {
    double const value = factor * kernel.value(distance, h);
    if (value == 0.0) return;
    contacts.interpolation_neighbour.push_back(j);
    contacts.interpolation_kernel.push_back(value);
    sum += mass[j] * value;
  });
  if (sum <= 0.0) {
    contacts.interpolation_neighbour.resize(before);
    contacts.interpolation_kernel.resize(before);
  }
  return sum;
}

namespace {

/// -n . sum_j (m_j/rho_j) grad_i W_ij: the face weight that makes a uniform state feel no force along n.
template <int Dim>
double balanced_face_weight(CellGrid<Dim> const& grid, std::size_t i, Vector<Dim> const& normal,
                            SmoothingLength const& h, std::vector<double> const& mass,
                            std::vector<double> const& density) {
  double sum = 0.0;
  grid.for_each_within_reach(
      grid.positions()[i], [&](std::uint32_t j, Vector<Dim> const& separation, double distance) {
        if (j == i) return;
        sum -= mass[j] / density[j] * h.kernel().radial(distance, h(i, j)) * separation.dot(normal);
      });
  return sum;
}

template <int Dim>
std::size_t walls_within_reach(std::vector<Wall<Dim>> const& walls, Vector<Dim> const& x, double reach) {
  return static_cast<std::size_t>(std::count_if(
      walls.begin(), walls.end(), [&](Wall<Dim> const& wall) { return wall.distance(x) < reach; }));
}

}  // namespace

namespace {

/// Contacts of the particles begin to end, and their foot points.
template <int Dim>
struct FoundContacts {
  WallContacts<Dim> contacts;
  std::vector<Vector<Dim>> feet;
  std::exception_ptr complaint;
};

template <int Dim>
void find_contacts_of(std::size_t begin, std::size_t end, CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& all_walls,
                      std::size_t index, SmoothingLength const& smoothing_length, std::vector<double> const& mass,
                      std::vector<double> const& density, FaceWeight rule, FoundContacts<Dim>& found) {
  VectorField<Dim> const& positions = grid.positions();
  Kernel const& kernel = smoothing_length.kernel();
  Wall<Dim> const& wall = all_walls[index];
  WallContacts<Dim>& contacts = found.contacts;
  for (std::size_t i = begin; i < end; ++i) {
    double const d = wall.distance(positions[i]);
    if (d <= 0.0) {
      throw std::invalid_argument("particle " + std::to_string(i) +
                                  " lies on or outside a wall: its distance is " + readable(d) +
                                  ", expected a positive one");
    }
    double const h = smoothing_length(i);
    double const reach = smoothing_length.support(i);
    if (d >= reach) continue;
    auto const foot = nearest_on_face(positions[i], all_walls, index, h);
    if (!foot) continue;
    bool const is_plane_s_own = *foot == wall.foot(positions[i]);  // else it may be out of reach
    if (!is_plane_s_own && (*foot - positions[i]).norm() >= reach) continue;
    double const at_foot = add_foot_interpolation(contacts, grid, *foot, all_walls, h, mass, kernel);
    if (at_foot <= 0.0) continue;  // alone, and at reach but for round-off
    contacts.interpolation_first.push_back(contacts.interpolation_neighbour.size());
    contacts.foot_density.push_back(at_foot);
    found.feet.push_back(*foot);
    contacts.particle.push_back(static_cast<std::uint32_t>(i));
    contacts.distance.push_back(d);
    bool const balance =
        rule == FaceWeight::balanced && walls_within_reach(all_walls, positions[i], reach) == 1;
    contacts.face_weight.push_back(
        balance ? balanced_face_weight(grid, i, wall.outward_normal, smoothing_length, mass, density)
                : face_weight(positions[i], all_walls, index, h,
                              rule == FaceWeight::balanced ? FaceWeight::exact : rule, kernel));
  }
}

/// Puts those of some particles in their place among all.
template <int Dim>
void put(FoundContacts<Dim> const& part, std::size_t first, std::size_t first_interpolated, WallContacts<Dim>& all) {
  auto const copy = [](auto const& from, auto& to, std::size_t at) {
    std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
  };
  WallContacts<Dim> const& some = part.contacts;
  copy(some.particle, all.particle, first);
  copy(some.distance, all.distance, first);
  copy(some.face_weight, all.face_weight, first);
  copy(some.foot_density, all.foot_density, first);
  copy(some.interpolation_neighbour, all.interpolation_neighbour, first_interpolated);
  copy(some.interpolation_kernel, all.interpolation_kernel, first_interpolated);
  for (std::size_t c = 0; c < some.size(); ++c) {
    all.interpolation_first[first + c + 1] = first_interpolated + some.interpolation_first[c];
    all.foot.set(first + c, part.feet[c]);
  }
}

}  // namespace

template <int Dim>
WallContacts<Dim> find_wall_contacts(CellGrid<Dim> const& grid, Wall<Dim> const& wall,
                                     std::vector<Wall<Dim>> const& all_walls,
                                     SmoothingLength const& smoothing_length, std::vector<double> const& mass,
                                     std::vector<double> const& density, FaceWeight rule, int threads) {
  auto const self = std::find_if(all_walls.begin(), all_walls.end(),
                                 [&](Wall<Dim> const& other) { return &other == &wall; });
  expects(self != all_walls.end());
  auto const index = static_cast<std::size_t>(self - all_walls.begin());
  std::size_t const n = grid.positions().size();
  constexpr std::size_t at_a_time = 4096;
  std::vector<FoundContacts<Dim>> parts(std::max<std::size_t>(1, (n + at_a_time - 1) / at_a_time));
  for_each_block(
      parts.size(), threads,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) {
          try {
            find_contacts_of(part * at_a_time, std::min(n, (part + 1) * at_a_time), grid, all_walls, index, smoothing_length,
                             mass, density, rule, parts[part]);
          } catch (...) {
            parts[part].complaint = std::current_exception();
          }
        }
      },
      1);
  // Of several complaints the first particle's is thrown, at any number of threads.
  for (FoundContacts<Dim> const& part : parts) {
    if (part.complaint) std::rethrow_exception(part.complaint);
  }
  std::vector<std::size_t> first{0}, first_interpolated{0};
  for (FoundContacts<Dim> const& part : parts) {
    first.push_back(first.back() + part.contacts.size());
    first_interpolated.push_back(first_interpolated.back() + part.contacts.interpolation_neighbour.size());
  }
  WallContacts<Dim> contacts;
  contacts.outward_normal = wall.outward_normal;
  contacts.prescribes_flux_only = wall.prescribes_flux_only();
  contacts.particle.resize(first.back());
  contacts.distance.resize(first.back());
  contacts.face_weight.resize(first.back());
  contacts.foot_density.resize(first.back());
  contacts.foot = VectorField<Dim>(first.back());
  contacts.interpolation_first.resize(first.back() + 1, 0);
  contacts.interpolation_neighbour.resize(first_interpolated.back());
  contacts.interpolation_kernel.resize(first_interpolated.back());
  for_each_block(
      parts.size(), threads,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) {
          put(parts[part], first[part], first_interpolated[part], contacts);
          parts[part] = {};
        }
      },
      1);
  return contacts;
}

namespace {

/// sum_j (m_j/rho_j) f_j W(r_j - r_B)/Gamma(r_B) of a contact.
template <int Dim, class Value, class Values>
Value kernel_sum(WallContacts<Dim> const& contacts, std::size_t c, Particles<Dim> const& particles,
                 Value zero, Values const& f) {
  auto const& mass = particles.masses();
  auto const& density = particles.scalar(Field::density);
  Value sum = zero;
  for (std::size_t k = contacts.interpolation_first[c]; k < contacts.interpolation_first[c + 1]; ++k) {
    std::uint32_t const j = contacts.interpolation_neighbour[k];
    sum += mass[j] / density[j] * contacts.interpolation_kernel[k] * f(j);
  }
  return sum;
}

/// What a closure's interpolation is divided by.
template <int Dim>
double divisor(WallContacts<Dim> const& contacts, std::size_t c, Particles<Dim> const& particles,
               Closure closure) {
  if (closure != Closure::quotient) return 1.0;
  return kernel_sum(contacts, c, particles, 0.0, [](std::uint32_t) { return 1.0; });
}

template <int Dim>
double interpolated(WallContacts<Dim> const& contacts, std::size_t c, Particles<Dim> const& particles,
                    Closure closure, std::vector<double> const& f) {
  double const sum = kernel_sum(contacts, c, particles, 0.0, [&](std::uint32_t j) { return f[j]; });
  return sum / divisor(contacts, c, particles, closure);
}

template <int Dim>
Vector<Dim> interpolated(WallContacts<Dim> const& contacts, std::size_t c, Particles<Dim> const& particles,
                         Closure closure, VectorField<Dim> const& f) {
  Vector<Dim> const zero = Vector<Dim>::Zero();
  Vector<Dim> const sum =
      kernel_sum(contacts, c, particles, zero, [&](std::uint32_t j) -> Vector<Dim> { return f[j]; });
  return sum / divisor(contacts, c, particles, closure);
}

/// F_B = -K_B (T_B - T_i)/d_i n where the wall prescribes temperature only.
template <int Dim>
void one_sided_flux(WallContacts<Dim>& contacts, Particles<Dim> const& particles, int threads) {
  auto const& T = particles.scalar(Field::temperature);
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    double const slope = (contacts.temperature[c] - T[contacts.particle[c]]) / contacts.distance[c];
    contacts.flux.set(c, -contacts.conductivity[c] * slope * contacts.outward_normal);
  });
}

/// T_B = T_i - (F_B . n) d_i / K_i where the wall prescribes flux only.
template <int Dim>
void one_sided_temperature(WallContacts<Dim>& contacts, Wall<Dim> const& wall,
                           Particles<Dim> const& particles, double time, int threads) {
  auto const& T = particles.scalar(Field::temperature);
  auto const& K = particles.scalar(Field::conductivity);
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    std::uint32_t const i = contacts.particle[c];
    double const outward = wall.flux(contacts.foot[c], time).dot(contacts.outward_normal);
    // Where nothing conducts the wall is at the particle's own temperature.
    contacts.temperature[c] = K[i] > 0.0 ? T[i] - outward * contacts.distance[c] / K[i] : T[i];
  });
}

/// T_B and F_B of a wall that loses heat: the temperature at which as much reaches it from within as it
/// loses. Within is, by Closure::one_sided, the particle; else what the kernel sees, at the mean distance
/// that it sees it from, so that a temperature linear along the normal gives the wall's own.
template <int Dim>
void balance_heat(WallContacts<Dim>& contacts, Wall<Dim> const& wall, Particles<Dim> const& particles,
                  Closure closure, int threads) {
  expects(!wall.temperature && !wall.flux);
  auto const& T = particles.scalar(Field::temperature);
  auto const& K = particles.scalar(Field::conductivity);
  auto const& positions = particles.positions();
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    std::uint32_t const i = contacts.particle[c];
    double inside = T[i];
    double distance = contacts.distance[c];
    double conductivity = K[i];
    if (closure != Closure::one_sided) {
      auto const mean = [&](auto const& f) {
        return kernel_sum(contacts, c, particles, 0.0, f) / divisor(contacts, c, particles, closure);
      };
      inside = mean([&](std::uint32_t j) { return T[j]; });
      distance = mean([&](std::uint32_t j) { return wall.distance(positions[j]); });
      conductivity = mean([&](std::uint32_t j) { return K[j]; });
    }
    double const wall_temperature =
        balanced_wall_temperature(*wall.heat_loss, inside, conductivity / distance);
    contacts.temperature[c] = wall_temperature;
    contacts.flux.set(c, wall.heat_loss->flux(wall_temperature) * contacts.outward_normal);
  });
}

/// The gas at a contact's foot point, by the quotient. A gas that has lost its pressure sends no wave.
template <int Dim>
struct GasAtFoot {
  double rho, P;
  Vector<Dim> v;

  GasAtFoot(WallContacts<Dim> const& contacts, std::size_t c, Particles<Dim> const& particles)
      : rho(interpolated(contacts, c, particles, Closure::quotient, particles.scalar(Field::density))),
        P(std::max(
            0.0, interpolated(contacts, c, particles, Closure::quotient, particles.scalar(Field::pressure)))),
        v(interpolated(contacts, c, particles, Closure::quotient, particles.vector(Field::velocity))) {}
};

/// P_B of the wave that a wall of prescribed velocity sends into the gas.
template <int Dim>
void one_sided_pressure(WallContacts<Dim>& contacts, Wall<Dim> const& wall, Particles<Dim> const& particles,
                        double time, int threads) {
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    GasAtFoot<Dim> const gas(contacts, c, particles);
    double const closing = (gas.v - wall.velocity(contacts.foot[c], time)).dot(contacts.outward_normal);
    contacts.pressure[c] = pressure_at_wall(gas.rho, gas.P, closing, wall.gamma);
  });
}

/// v_B of the wave that a wall of prescribed pressure sends into the gas; along the wall the gas slips.
template <int Dim>
void one_sided_velocity(WallContacts<Dim>& contacts, Wall<Dim> const& wall, Particles<Dim> const& particles,
                        double time, int threads) {
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    GasAtFoot<Dim> const gas(contacts, c, particles);
    double const closing =
        closing_speed_at_wall(gas.rho, gas.P, wall.pressure(contacts.foot[c], time), wall.gamma);
    contacts.velocity.set(c, gas.v - closing * contacts.outward_normal);
  });
}

template <int Dim>
void fill(WallContacts<Dim> const& contacts, ScalarAtWall<Dim> const& prescribed,
          Particles<Dim> const& particles, Closure closure, Field field, std::vector<double>& out,
          double time, int threads) {
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    out[c] = prescribed ? prescribed(contacts.foot[c], time)
                        : interpolated(contacts, c, particles, closure, particles.scalar(field));
  });
}

template <int Dim>
void fill(WallContacts<Dim> const& contacts, VectorAtWall<Dim> const& prescribed,
          Particles<Dim> const& particles, Closure closure, Field field, VectorField<Dim>& out, double time,
          int threads) {
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    out.set(c, prescribed ? prescribed(contacts.foot[c], time)
                          : interpolated(contacts, c, particles, closure, particles.vector(field)));
  });
}

template <int Dim>
void allocate(WallContacts<Dim>& contacts, BoundaryValueSet wanted) {
  auto const scalar = [&](BoundaryValue value, std::vector<double>& out) {
    if (wanted.contains(value)) out.resize(contacts.size());
  };
  auto const vector = [&](BoundaryValue value, VectorField<Dim>& out) {
    if (wanted.contains(value) && out.size() != contacts.size()) out = VectorField<Dim>(contacts.size());
  };
  scalar(BoundaryValue::pressure, contacts.pressure);
  scalar(BoundaryValue::temperature, contacts.temperature);
  scalar(BoundaryValue::conductivity, contacts.conductivity);
  vector(BoundaryValue::velocity, contacts.velocity);
  vector(BoundaryValue::flux, contacts.flux);
}

}  // namespace

template <int Dim>
void fill_boundary_values(WallContacts<Dim>& contacts, Wall<Dim> const& wall, Particles<Dim> const& particles,
                          BoundaryValueSet wanted, Closure closure, double time, int threads) {
  bool const one_sided = closure == Closure::one_sided;
  bool const has_gas = wall.gamma > 1.0;
  bool const fourier_flux =
      one_sided && !wall.flux && wall.temperature && wanted.contains(BoundaryValue::flux);
  if (fourier_flux) wanted.insert(BoundaryValue::conductivity);
  bool const balances =
      wall.heat_loss && (wanted.contains(BoundaryValue::temperature) || wanted.contains(BoundaryValue::flux));
  if (balances) wanted = wanted | BoundaryValueSet{BoundaryValue::temperature, BoundaryValue::flux};
  allocate(contacts, wanted);
  if (balances) balance_heat(contacts, wall, particles, closure, threads);
  if (wanted.contains(BoundaryValue::pressure)) {
    if (one_sided && has_gas && !wall.pressure && wall.velocity) {
      one_sided_pressure(contacts, wall, particles, time, threads);
    } else {
      fill(contacts, wall.pressure, particles, closure, Field::pressure, contacts.pressure, time, threads);
    }
  }
  if (wanted.contains(BoundaryValue::velocity)) {
    if (one_sided && has_gas && !wall.velocity && wall.pressure) {
      one_sided_velocity(contacts, wall, particles, time, threads);
    } else {
      fill(contacts, wall.velocity, particles, closure, Field::velocity, contacts.velocity, time, threads);
    }
  }
  if (wanted.contains(BoundaryValue::temperature) && !balances) {
    if (one_sided && contacts.prescribes_flux_only) {
      one_sided_temperature(contacts, wall, particles, time, threads);
    } else {
      fill(contacts, wall.temperature, particles, closure, Field::temperature, contacts.temperature, time, threads);
    }
  }
  if (wanted.contains(BoundaryValue::conductivity)) {
    fill(contacts, wall.conductivity, particles, closure, Field::conductivity, contacts.conductivity, time, threads);
  }
  if (wanted.contains(BoundaryValue::flux) && !balances) {
    if (fourier_flux) {
      one_sided_flux(contacts, particles, threads);
    } else {
      fill(contacts, wall.flux, particles, closure, Field::flux, contacts.flux, time, threads);
    }
  }
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                      \
  template struct Wall<Dim>;                                                                            \
  template struct WallContacts<Dim>;                                                                    \
  template double face_weight<Dim>(double, double, FaceWeight, Kernel const&);                          \
  template double foot_density(CellGrid<Dim> const&, Vector<Dim> const&, std::vector<Wall<Dim>> const&, \
                               double, std::vector<double> const&, Kernel const&);                      \
  template double add_foot_interpolation(WallContacts<Dim>&, CellGrid<Dim> const&, Vector<Dim> const&,  \
                                         std::vector<Wall<Dim>> const&, double,                         \
                                         std::vector<double> const&, Kernel const&);                    \
  template WallContacts<Dim> find_wall_contacts(                                                        \
      CellGrid<Dim> const&, Wall<Dim> const&, std::vector<Wall<Dim>> const&, SmoothingLength const&,    \
      std::vector<double> const&, std::vector<double> const&, FaceWeight, int);                              \
  template void fill_boundary_values(WallContacts<Dim>&, Wall<Dim> const&, Particles<Dim> const&,       \
                                     BoundaryValueSet, Closure, double, int);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
