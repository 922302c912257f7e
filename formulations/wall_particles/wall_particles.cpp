// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/wall_particles/wall_particles.hpp"

#include <algorithm>
#include <memory>

#include "formulations/basics/tensor_index.hpp"
#include "formulations/sweep/pair_sweep.hpp"
#include "formulations/walls/wall_heat_balance.hpp"

namespace sphverify {

template <int Dim>
std::size_t WallParticles<Dim>::bytes() const {
  std::size_t bytes = particles.bytes() + pairs.bytes() + placed.capacity() * sizeof(PlacedBehind<Dim>);
  for (auto const& one : placed) bytes += one.sources.capacity() * sizeof(one.sources.front());
  return bytes;
}

namespace {

/// The means of the sources' values that a particle behind walls goes by.
template <int Dim>
class Mean {
 public:
  Mean(PlacedBehind<Dim> const& placed, Particles<Dim> const& fluid) : placed_(placed), fluid_(fluid) {}

  double scalar(Field field) const {
    auto const& values = fluid_.scalar(field);
    double sum = 0.0;
    for (auto const& [j, weight] : placed_.sources) sum += weight * values[j];
    return sum;
  }
  Vector<Dim> vector(Field field) const {
    auto const& values = fluid_.vector(field);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (auto const& [j, weight] : placed_.sources) sum += weight * values[j];
    return sum;
  }
  Tensor<Dim> tensor(Field field) const {
    auto const& values = fluid_.tensor(field);
    Tensor<Dim> sum = Tensor<Dim>::Zero();
    for (auto const& [j, weight] : placed_.sources) sum += weight * values[j];
    return sum;
  }

 private:
  PlacedBehind<Dim> const& placed_;
  Particles<Dim> const& fluid_;
};

/// Continues one particle's values in its walls.
template <int Dim>
class Continuation {
 public:
  Continuation(PlacedBehind<Dim> const& placed, std::vector<Wall<Dim>> const& walls, double time)
      : placed_(placed), walls_(walls), time_(time) {}

  /// @param K asked for where a wall prescribes flux or loses heat
  template <class Conductivity>
  double temperature(double T, Conductivity const& K) const {
    for_each_mirror([&](WallMirror<Dim> const& mirror, Wall<Dim> const& wall) {
      if (wall.temperature) {
        T = 2.0 * wall.temperature(mirror.foot, time_) - T;
      } else if (wall.heat_loss) {
        T = 2.0 * balanced_wall_temperature(*wall.heat_loss, T, K() / mirror.inside) - T;
      } else if (wall.flux && K() > 0.0) {
        T -= (mirror.inside + mirror.behind) * wall.flux(mirror.foot, time_).dot(wall.outward_normal) / K();
      }
    });
    return T;
  }
  double pressure(double P) const {
    for_each_mirror([&](WallMirror<Dim> const& mirror, Wall<Dim> const& wall) {
      if (wall.pressure) P = 2.0 * wall.pressure(mirror.foot, time_) - P;
    });
    return P;
  }
  Vector<Dim> velocity(Vector<Dim> v) const {
    for_each_mirror([&](WallMirror<Dim> const& mirror, Wall<Dim> const& wall) {
      if (!wall.velocity) return;
      v += 2.0 * (wall.velocity(mirror.foot, time_) - v).dot(wall.outward_normal) * wall.outward_normal;
    });
    return v;
  }
  /// @param K asked for where a wall prescribes temperature
  template <class Conductivity>
  Vector<Dim> flux(Vector<Dim> F, Conductivity const& K) const {
    for_each_mirror([&](WallMirror<Dim> const& mirror, Wall<Dim> const& wall) {
      Vector<Dim> const& n = wall.outward_normal;
      double const normal = F.dot(n);
      if (wall.temperature) {
        F = 2.0 * (normal * n - K() * slope_along(mirror, wall)) - F;
      } else if (wall.flux) {
        F += 2.0 * (wall.flux(mirror.foot, time_).dot(n) - normal) * n;
      } else if (!wall.heat_loss) {
        F -= 2.0 * normal * n;
      }
    });
    return F;
  }
  Vector<Dim> reflected(Vector<Dim> x) const {
    for_each_mirror([&](WallMirror<Dim> const&, Wall<Dim> const& wall) {
      x -= 2.0 * x.dot(wall.outward_normal) * wall.outward_normal;
    });
    return x;
  }
  Tensor<Dim> reflected_tensor(Tensor<Dim> t) const {
    for_each_mirror([&](WallMirror<Dim> const&, Wall<Dim> const& wall) {
      Tensor<Dim> const turn = Tensor<Dim>::Identity() - 2.0 * wall.outward_normal * wall.outward_normal.transpose();
      t = turn * t * turn;
    });
    return t;
  }

 private:
  /// The gradient of the temperature that a wall prescribes, along the wall, by central differences.
  Vector<Dim> slope_along(WallMirror<Dim> const& mirror, Wall<Dim> const& wall) const {
    double const step = 1e-4 * (mirror.inside + mirror.behind);
    Vector<Dim> slope = Vector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) {
      Vector<Dim> along = Vector<Dim>::Unit(k);
      along -= along.dot(wall.outward_normal) * wall.outward_normal;
      if (along.norm() < 1e-12) continue;
      double const rise = wall.temperature(mirror.foot + step * along, time_) - wall.temperature(mirror.foot - step * along, time_);
      slope[k] = rise / (2.0 * step);
    }
    return slope;
  }

  template <class Visit>
  void for_each_mirror(Visit const& visit) const {
    for (int k = 0; k < placed_.mirror_count; ++k) {
      WallMirror<Dim> const& mirror = placed_.mirrors[static_cast<std::size_t>(k)];
      visit(mirror, walls_[mirror.wall]);
    }
  }

  PlacedBehind<Dim> const& placed_;
  std::vector<Wall<Dim>> const& walls_;
  double time_;
};

template <int Dim>
void fill_scalar(WallParticles<Dim>& behind, Field field, Particles<Dim> const& fluid, std::vector<Wall<Dim>> const& walls,
                 double time) {
  auto& out = behind.particles.scalar(field);
  std::size_t const contacts = behind.pairs.rows();
  for (std::size_t k = 0; k < behind.placed.size(); ++k) {
    PlacedBehind<Dim> const& placed = behind.placed[k];
    Mean<Dim> const mean(placed, fluid);
    Continuation<Dim> const continued(placed, walls, time);
    double& value = out[contacts + k];
    value = mean.scalar(field);
    if (field == Field::temperature)
      value = continued.temperature(value, [&] { return mean.scalar(Field::conductivity); });
    if (field == Field::pressure) value = continued.pressure(value);
    if (field == Field::mass && placed.volume > 0.0) value = placed.volume * mean.scalar(Field::density);
  }
}

template <int Dim>
void fill_vector(WallParticles<Dim>& behind, Field field, Particles<Dim> const& fluid, std::vector<Wall<Dim>> const& walls,
                 double time) {
  auto& out = behind.particles.vector(field);
  std::size_t const contacts = behind.pairs.rows();
  for (std::size_t k = 0; k < behind.placed.size(); ++k) {
    Continuation<Dim> const continued(behind.placed[k], walls, time);
    Mean<Dim> const means(behind.placed[k], fluid);
    Vector<Dim> const mean = means.vector(field);
    out.set(contacts + k, field == Field::velocity ? continued.velocity(mean)
                          : field == Field::flux ? continued.flux(mean, [&] { return means.scalar(Field::conductivity); })
                                                 : continued.reflected(mean));
  }
}

}  // namespace

template <int Dim>
std::vector<WallParticles<Dim>> stand_behind_walls(std::vector<PlacedBehind<Dim>> placed,
                                                   std::vector<WallContacts<Dim>> const& contacts, Particles<Dim> const& fluid,
                                                   Domain<Dim> const& domain) {
  SmoothingLength const h(fluid);
  double const reach = h.kernel().support_ratio() * h.largest();
  // A particle behind a wall is as wide as its sources.
  auto const width = [&](PlacedBehind<Dim> const& one) {
    double sum = 0.0;
    for (auto const& [j, weight] : one.sources) sum += weight * h(j);
    return sum;
  };
  std::vector<WallParticles<Dim>> walls(contacts.size());
  for (PlacedBehind<Dim>& one : placed) walls[one.booked_to()].placed.push_back(std::move(one));
  for (std::size_t w = 0; w < walls.size(); ++w) {
    WallParticles<Dim>& behind = walls[w];
    std::vector<std::uint32_t> const& seen_from = contacts[w].particle;
    VectorField<Dim> places(behind.placed.size());
    std::vector<double> widths(behind.placed.size());
    for (std::size_t k = 0; k < behind.placed.size(); ++k) {
      places.set(k, behind.placed[k].position);
      widths[k] = width(behind.placed[k]);
    }
    behind.pairs.first.assign(1, 0);
    std::vector<std::uint32_t> number(behind.placed.size(), 0);  // 1 + its number among those that are seen
    std::vector<std::uint32_t> kept;
    if (!seen_from.empty() && !behind.placed.empty()) {
      CellGrid<Dim> const grid(places, domain, reach);
      for (std::uint32_t const i : seen_from) {
        grid.for_each_within_reach(fluid.positions()[i], [&](std::uint32_t k, Vector<Dim> const&, double distance) {
          if (distance >= h.kernel().support_ratio() * 0.5 * (h(i) + widths[k])) return;
          if (number[k] == 0) {
            kept.push_back(k);
            number[k] = static_cast<std::uint32_t>(kept.size());
          }
          behind.pairs.neighbour.push_back(static_cast<std::uint32_t>(seen_from.size()) + number[k] - 1);
        });
        behind.pairs.first.push_back(behind.pairs.neighbour.size());
      }
    } else {
      behind.pairs.first.assign(seen_from.size() + 1, 0);
    }
    std::vector<PlacedBehind<Dim>> seen;
    for (std::uint32_t const k : kept) seen.push_back(std::move(behind.placed[k]));
    behind.placed = std::move(seen);
    behind.particles = Particles<Dim>(seen_from.size() + kept.size(), fluid.smoothing_length());
    behind.particles.set_kernel(fluid.kernel());
    if (!h.is_uniform()) behind.particles.vary_smoothing_length();
    for (std::size_t c = 0; c < seen_from.size(); ++c) {
      behind.particles.positions().set(c, fluid.positions()[seen_from[c]]);
      if (!h.is_uniform()) behind.particles.smoothing_lengths()[c] = h(seen_from[c]);
    }
    for (std::size_t k = 0; k < kept.size(); ++k) {
      behind.particles.positions().set(seen_from.size() + k, behind.placed[k].position);
      if (!h.is_uniform()) behind.particles.smoothing_lengths()[seen_from.size() + k] = widths[kept[k]];
    }
  }
  return walls;
}

template <int Dim>
void fill_wall_particles(WallParticles<Dim>& behind, WallContacts<Dim> const& contacts, std::vector<Wall<Dim>> const& walls,
                         Particles<Dim> const& fluid, FieldSet fields, double time) {
  behind.particles.allocate(fields);
  for (FieldInfo const& field : field_infos) {
    if (!fields.contains(field.field) || field.field == Field::position) continue;
    if (field.is_tensor) {
      auto& out = behind.particles.tensor(field.field);
      for (std::size_t c = 0; c < contacts.size(); ++c) out.set(c, fluid.tensor(field.field)[contacts.particle[c]]);
      for (std::size_t k = 0; k < behind.placed.size(); ++k) {
        Continuation<Dim> const continued(behind.placed[k], walls, time);
        out.set(contacts.size() + k, continued.reflected_tensor(Mean<Dim>(behind.placed[k], fluid).tensor(field.field)));
      }
    } else if (field.is_vector) {
      auto& out = behind.particles.vector(field.field);
      for (std::size_t c = 0; c < contacts.size(); ++c) out.set(c, fluid.vector(field.field)[contacts.particle[c]]);
      fill_vector(behind, field.field, fluid, walls, time);
    } else {
      auto& out = behind.particles.scalar(field.field);
      for (std::size_t c = 0; c < contacts.size(); ++c) out[c] = fluid.scalar(field.field)[contacts.particle[c]];
      fill_scalar(behind, field.field, fluid, walls, time);
    }
  }
}

template <int Dim>
void add_density_behind(WallParticles<Dim>& behind, WallContacts<Dim> const& contacts, Domain<Dim> const& domain, int threads,
                        std::vector<double>& density) {
  PairSweep<Dim> sweep(behind.pairs, domain, threads);
  std::vector<double> sum(behind.particles.size());
  sweep.add(loops_of_sweep<Dim>().density, {Field::mass}, {}, sum);
  sweep.run(behind.particles);
  for (std::size_t c = 0; c < contacts.size(); ++c) density[contacts.particle[c]] += sum[c];
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                                     \
  template struct WallParticles<Dim>;                                                                                  \
  template std::vector<WallParticles<Dim>> stand_behind_walls(std::vector<PlacedBehind<Dim>>,                          \
                                                              std::vector<WallContacts<Dim>> const&,                   \
                                                              Particles<Dim> const&, Domain<Dim> const&);              \
  template void fill_wall_particles(WallParticles<Dim>&, WallContacts<Dim> const&, std::vector<Wall<Dim>> const&,      \
                                    Particles<Dim> const&, FieldSet, double);                                          \
  template void add_density_behind(WallParticles<Dim>&, WallContacts<Dim> const&, Domain<Dim> const&, int,             \
                                   std::vector<double>&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
