// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "formulations/basics/parallel.hpp"
#include "formulations/density/grad_h.hpp"
#include "formulations/density/self_consistent_smoothing.hpp"
#include "harness/scene/list_skin.hpp"

namespace sphverify {

namespace {

/// What is solved for at the same place again, as smoothing lengths are, may differ by less.
constexpr double least_skin = 1e-10;

/// Contacts with each wall.
template <int Dim>
std::vector<WallContacts<Dim>> find_contacts(CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& walls,
                                             Particles<Dim> const& particles, FaceWeight rule, int threads) {
  SmoothingLength const h(particles);
  std::vector<WallContacts<Dim>> contacts;
  for (Wall<Dim> const& wall : walls) {
    contacts.push_back(
        find_wall_contacts(grid, wall, walls, h, particles.masses(), particles.scalar(Field::density), rule, threads));
  }
  return contacts;
}

}  // namespace

template <int Dim>
MovingGeometry<Dim>::MovingGeometry(Domain<Dim> const& domain, Choice const& choice) : choice_(choice) {
  geometry_.domain = domain;
}

template <int Dim>
std::size_t MovingGeometry<Dim>::bytes() const {
  std::size_t const of_grid = grid_ ? sizeof(std::uint32_t) * (grid_->particles().capacity() + grid_->cells() + 1) : 0;
  return geometry_.bytes() + of_grid + sizeof(double) * (Dim * found_at_.size() + found_with_.capacity());
}

template <int Dim>
void MovingGeometry<Dim>::follow(Particles<Dim>& particles, std::vector<Wall<Dim>> const& walls,
                                 std::vector<Wall<Dim>> const& all_walls) {
  auto& density = particles.scalar(Field::density);
  VoronoiCells<Dim> cells;
  if (!weighs_by_kernel() || choice_.density == DensityRule::voronoi) {
    cells = find_voronoi_cells(particles.positions(), geometry_.domain, all_walls, choice_.threads, choice_.face_offsets);
    ++passes_["voronoi-cells"];
  }
  if (choice_.density == DensityRule::voronoi) {
    for_each_row(density.size(), choice_.threads,
                 [&](std::size_t i) { density[i] = particles.masses()[i] / cells.volume[i]; });
  }
  if (choice_.adaptive) {
    sums_density() ? solve_smoothing_length(particles, all_walls) : set_smoothing_length(particles);
    ++passes_["smoothing-length"];
  }
  if (weighs_by_kernel()) {
    follow_list(particles);
  } else {
    SmoothingLength const h(particles);
    grid_.reset();
    grid_.emplace(particles.positions(), geometry_.domain, h.kernel().support_ratio() * h.largest(), choice_.threads);
  }
  if (sums_density()) set_density(particles, *grid_, all_walls);
  if (particles.has(Field::omega)) set_omega(particles, *grid_, all_walls);
  if (!walls.empty()) ++passes_["wall-contacts"];
  geometry_.walls = walls;
  if (weighs_by_kernel()) {
    if (!walls.empty())
      geometry_.contacts = find_contacts(*grid_, geometry_.walls, particles, choice_.face_weight, choice_.threads);
  } else {
    weigh_by_cells(geometry_, std::move(cells), *grid_, SmoothingLength(particles), particles.masses(), density, choice_.threads);
  }
  if (choice_.behind_walls && !walls.empty()) stand_behind(particles);
}

/// What stands behind the walls, where they are now; a summed density takes it in.
template <int Dim>
void MovingGeometry<Dim>::stand_behind(Particles<Dim>& particles) {
  SmoothingLength const h(particles);
  require_room_between_walls(geometry_.walls, h.kernel().support_ratio() * h.largest());
  geometry_.behind = stand_behind_walls(
      choice_.behind_walls->template place<Dim>({particles, geometry_.domain, geometry_.walls, *grid_, choice_.spacing}), geometry_.contacts,
      particles, geometry_.domain);
  ++passes_[choice_.behind_walls->info->id];
  if (choice_.density != DensityRule::summation) return;
  for (std::size_t w = 0; w < geometry_.walls.size(); ++w) {
    fill_wall_particles(geometry_.behind[w], geometry_.contacts[w], geometry_.walls, particles, {Field::mass}, 0.0);
    add_density_behind(geometry_.behind[w], geometry_.contacts[w], geometry_.domain, choice_.threads,
                       particles.scalar(Field::density));
  }
}

/// Keeps the list of neighbours as long as it holds all pairs.
template <int Dim>
void MovingGeometry<Dim>::follow_list(Particles<Dim> const& particles) {
  if (!grid_) {
    find_list(particles, 0.0);  // how fast they are is not known yet
  } else {
    double const used = skin_used(particles);
    if (std::abs(used - used_) > least_skin) {
      ++places_;
      used_ = used;
    }
    if (used > skin_) find_list(particles, cheapest_skin(used / static_cast<double>(places_), Dim));
  }
}

/// By how much, in half supports, places and smoothing lengths have changed since the list was found. With
/// s_i the half of a support it holds every pair that was closer than (1 + skin)(s_i + s_j), and a pair is
/// now closer than s_i + s_j only if it was closer than that plus what both have moved. Where the larger of
/// two supports counts it holds those that were closer than (1 + skin) times that, and what the one with the
/// larger moved counts with what anybody has. Infinite where a place is not a number.
template <int Dim>
double MovingGeometry<Dim>::skin_used(Particles<Dim> const& particles) const {
  SmoothingLength const h(particles);
  double const support_ratio = h.kernel().support_ratio();
  /// The largest of all particles.
  struct Moved {
    double used = 0.0, far = 0.0;       // of the skin; in space
    double found_with = 0.0, now = 0.0;  // smoothing lengths
  };
  auto const join = [](Moved& all, Moved const& part) {
    all.used = std::max(all.used, part.used);
    all.far = std::max(all.far, part.far);
    all.found_with = std::max(all.found_with, part.found_with);
    all.now = std::max(all.now, part.now);
  };
  Moved const most = joined_blocks(
      particles.size(), choice_.threads, Moved{},
      [&](std::size_t begin, std::size_t end) {
        Moved part;
        for (std::size_t i = begin; i < end; ++i) {
          double const moved = geometry_.domain.nearest_image(particles.positions()[i] - found_at_[i]).norm();
          double const with = h.is_uniform() ? found_with_.front() : found_with_[i];
          double const of_one = (h(i) + moved / (0.5 * support_ratio)) / with - 1.0;
          join(part, {std::isfinite(of_one) ? of_one : std::numeric_limits<double>::infinity(), moved, with, h(i)});
        }
        return part;
      },
      join);
  double used = most.used;
  if (choice_.support == PairSupport::larger) {
    used = std::max(used, joined_blocks(
                              particles.size(), choice_.threads, 0.0,
                              [&](std::size_t begin, std::size_t end) {
                                double part = 0.0;
                                for (std::size_t i = begin; i < end; ++i) {
                                  double const moved = geometry_.domain.nearest_image(particles.positions()[i] - found_at_[i]).norm();
                                  double const with = h.is_uniform() ? found_with_.front() : found_with_[i];
                                  part = std::max(part, (h(i) + (moved + most.far) / support_ratio) / with - 1.0);
                                }
                                return part;
                              },
                              [](double& all, double part) { all = std::max(all, part); }));
  }
  // The grid is asked for all within the largest support, whoever has moved.
  return std::max(used, (most.now + most.far / support_ratio) / most.found_with - 1.0);
}

template <int Dim>
void MovingGeometry<Dim>::find_list(Particles<Dim> const& particles, double skin) {
  SmoothingLength const h(particles);
  double const support = h.kernel().support_ratio() * h.largest();
  // Where a periodic axis is just long enough for the support, there is no room for a skin.
  double reach = (1.0 + std::max(skin, least_skin)) * support;
  for (int k = 0; k < Dim; ++k) {
    double const half = 0.5 * geometry_.domain.extent()[k];
    if (geometry_.domain.periodic[k] && reach > half) reach = std::max(support, half);
  }
  skin_ = reach / support - 1.0;
  NeighbourList old = std::move(geometry_.neighbours);
  geometry_.neighbours.first.assign(particles.size() + 1, 0);  // should what follows not succeed
  geometry_.neighbours.neighbour.clear();
  grid_.reset();
  CellGrid<Dim> const grid(particles.positions(), geometry_.domain, reach, choice_.threads);
  geometry_.neighbours = find_neighbours(grid, h, skin_, choice_.threads, std::move(old), choice_.support);
  grid_.emplace(grid);
  found_with_.assign(h.is_uniform() ? 1 : particles.size(), particles.smoothing_length());
  if (!h.is_uniform()) {
    for (std::size_t i = 0; i < found_with_.size(); ++i) found_with_[i] = h(i);
  }
  found_at_ = particles.positions();
  used_ = 0.0;
  places_ = 0;
  ++passes_["neighbour-search"];
}

template <int Dim>
void MovingGeometry<Dim>::set_density(Particles<Dim>& particles, CellGrid<Dim> const& grid,
                                      std::vector<Wall<Dim>> const& walls) {
  SmoothingLength const h(particles);
  auto& density = particles.scalar(Field::density);
  if (h.is_uniform() && weighs_by_kernel()) {
    sum_density(particles, geometry_.neighbours, geometry_.domain, choice_.threads);
  } else {
    density = summation_density(grid, h, particles.masses(), choice_.threads);
  }
  ++passes_["density-summation"];
  if (choice_.density != DensityRule::normalised || walls.empty()) return;
  for_each_row(density.size(), choice_.threads, [&](std::size_t i) {
    density[i] /= kernel_inside(particles.positions()[i], walls, h(i), h.kernel());
  });
  ++passes_["density-normalisation"];
}

/// 1 where smoothing lengths stay; else of the summed density that they follow, and no number where it is not summed.
template <int Dim>
void MovingGeometry<Dim>::set_omega(Particles<Dim>& particles, CellGrid<Dim> const& grid,
                                    std::vector<Wall<Dim>> const& walls) {
  if (!choice_.adaptive || !sums_density()) {
    particles.scalar(Field::omega).assign(particles.size(), choice_.adaptive ? std::numeric_limits<double>::quiet_NaN() : 1.0);
    return;
  }
  std::vector<Wall<Dim>> const none;
  std::vector<Wall<Dim>> const& normalised_by = choice_.density == DensityRule::normalised ? walls : none;
  particles.scalar(Field::omega) = grad_h_terms(grid, SmoothingLength(particles), particles.masses(),
                                                particles.scalar(Field::density), normalised_by, choice_.threads);
  ++passes_["grad-h"];
}

/// h_i = (h/dx) (m_i/rho_i)^(1/Dim), with the densities that are there.
template <int Dim>
void MovingGeometry<Dim>::set_smoothing_length(Particles<Dim>& particles) {
  auto& h = particles.smoothing_lengths();
  auto const& density = particles.scalar(Field::density);
  for_each_row(h.size(), choice_.threads, [&](std::size_t i) {
    h[i] = choice_.smoothing_ratio * std::pow(particles.masses()[i] / density[i], 1.0 / Dim);
  });
}

template <int Dim>
void MovingGeometry<Dim>::solve_smoothing_length(Particles<Dim>& particles,
                                                 std::vector<Wall<Dim>> const& walls) {
  std::vector<Wall<Dim>> const none;
  SelfConsistentSmoothing<Dim> const equations{
      particles.positions(),   particles.masses(),
      geometry_.domain,        choice_.density == DensityRule::normalised ? walls : none,
      choice_.smoothing_ratio, choice_.threads,
      particles.kernel(),
  };
  equations.solve(particles.smoothing_lengths());
}

template class MovingGeometry<1>;
template class MovingGeometry<2>;
template class MovingGeometry<3>;

}  // namespace sphverify
