// SPDX-License-Identifier: GPL-3.0-or-later
// What Voronoi cells cost, beside Voro++'s own container; what a pair costs whose slope is stored, beside the kernels'; what
// images and dummies behind walls cost, beside wall terms. All in turn, best of several rounds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#ifdef SPHVERIFY_HAS_VOROPP
#include <voro++/voro++.hh>
#endif

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/layouts/layout.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"

using namespace sphverify;

namespace {

constexpr int rounds = 7;

/// The shortest time of each of some works, done in turn [s].
std::vector<double> shortest(std::vector<std::function<void()>> const& works) {
  std::vector<double> best(works.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < works.size(); ++k) {
      auto const start = std::chrono::steady_clock::now();
      works[k]();
      best[k] = std::min(best[k], std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  }
  return best;
}

template <int Dim>
struct Box {
  Domain<Dim> domain{.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()};
  std::vector<Wall<Dim>> walls;
  Layout<Dim> layout;
  Particles<Dim> particles{0, 1.0};

  Box(int resolution, double jitter) : layout(jittered(domain, resolution, jitter, 1)) {
    for (int k = 0; k < Dim; ++k) {
      for (double const side : {-1.0, 1.0}) {
        Wall<Dim> wall;
        wall.point = side < 0.0 ? domain.lower : domain.upper;
        wall.outward_normal = side * Vector<Dim>::Unit(k);
        wall.temperature = [](Vector<Dim> const& x, double) { return x[0]; };
        wall.conductivity = [](Vector<Dim> const&, double) { return 1.0; };
        wall.velocity = [](Vector<Dim> const&, double) { return Vector<Dim>::Zero().eval(); };
        walls.push_back(wall);
      }
    }
    particles = Particles<Dim>(layout.volumes.size(), 1.2 * layout.spacing);
    particles.positions() = layout.positions;
    particles.allocate({Field::density, Field::temperature, Field::conductivity, Field::heating, Field::pressure, Field::acceleration});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.masses()[i] = layout.volumes[i];
      particles.scalar(Field::density)[i] = particles.scalar(Field::conductivity)[i] = particles.scalar(Field::pressure)[i] = 1.0;
      particles.scalar(Field::temperature)[i] = particles.positions()[i][0];
    }
  }
  CellGrid<Dim> grid() const {
    return {particles.positions(), domain, SmoothingLength(particles).support(0)};
  }
};

#ifdef SPHVERIFY_HAS_VOROPP
/// Volumes, neighbours and areas of all cells.
double by_voropp(Box<3> const& box, int resolution) {
  int const blocks = std::max(1, resolution / 2);
  voro::container all(0, 1, 0, 1, 0, 1, blocks, blocks, blocks, false, false, false, 8);
  for (std::size_t i = 0; i < box.layout.volumes.size(); ++i) {
    Vector<3> const x = box.layout.positions[i];
    all.put(static_cast<int>(i), x[0], x[1], x[2]);
  }
  voro::c_loop_all loop(all);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbours;
  std::vector<double> areas;
  double volume = 0.0;
  if (loop.start()) do {
      if (!all.compute_cell(cell, loop)) continue;
      volume += cell.volume();
      cell.neighbors(neighbours);
      cell.face_areas(areas);
    } while (loop.inc());
  return volume;
}
#endif

template <int Dim>
void measure_cells(int resolution, double jitter) {
  Box<Dim> const box(resolution, jitter);
  std::vector<std::function<void()>> works;
  for (int const threads : {1, 2})
    works.push_back([&box, threads] { find_voronoi_cells(box.layout.positions, box.domain, box.walls, threads); });
#ifdef SPHVERIFY_HAS_VOROPP
  if constexpr (Dim == 3) works.push_back([&] { by_voropp(box, resolution); });
#endif
  std::vector<double> const best = shortest(works);
  double const per_cell = 1e6 / static_cast<double>(box.layout.volumes.size());
  fmt::print("cells {}D, {} along an axis, jitter {:g}: {:.2f} us each on one core, {:.2f} on two", Dim, resolution, jitter,
             best[0] * per_cell, best[1] * per_cell);
  if (best.size() > 2) fmt::print("; Voro++ {:.2f}, {:.2f} times as long", best[2] * per_cell, best[2] / best[0]);
  fmt::print("\n");
}

template <int Dim>
void measure_pairs(int resolution) {
  Box<Dim> box(resolution, 0.3);
  PairGeometry<Dim> by_kernel, by_cells;
  by_kernel.domain = by_cells.domain = box.domain;
  CellGrid<Dim> const grid = box.grid();
  by_kernel.neighbours = find_neighbours(grid);
  weigh_by_cells(by_cells, find_voronoi_cells(box.layout.positions, box.domain, std::vector<Wall<Dim>>{box.walls}, 1), grid,
                 SmoothingLength(box.particles), box.particles.masses(), box.particles.scalar(Field::density), 1);
  auto const scheme = make_rate_operator<Dim>("conduction/brookshaw");
  WorkCount work;
  auto const sweep = [&](PairGeometry<Dim>& geometry) {
    return [&, &geometry = geometry] { scheme->evaluate(box.particles, geometry, Closure::interpolated, 0.0, 1, work); };
  };
  std::vector<double> const best = shortest({sweep(by_kernel), sweep(by_cells)});
  auto const per_pair = [](double seconds, PairGeometry<Dim> const& geometry) {
    return 1e9 * seconds / static_cast<double>(geometry.neighbours.pairs());
  };
  fmt::print("sweep {}D, {} along an axis: {:.2f} ns a pair with the kernel, {:.2f} with stored slopes; {:.1f} and {:.1f} pairs a "
             "particle; a whole sweep takes {:.2f} of the kernel's time\n",
             Dim, resolution, per_pair(best[0], by_kernel), per_pair(best[1], by_cells),
             static_cast<double>(by_kernel.neighbours.pairs()) / static_cast<double>(box.particles.size()),
             static_cast<double>(by_cells.neighbours.pairs()) / static_cast<double>(box.particles.size()), best[1] / best[0]);
}

/// Finding contacts and what stands behind walls, then one evaluation, as a moving gas does at every step.
template <int Dim>
void measure_walls(int resolution) {
  Box<Dim> box(resolution, 0.2);
  CellGrid<Dim> const grid = box.grid();
  SmoothingLength const h(box.particles);
  NeighbourList const list = find_neighbours(grid);
  auto const scheme = make_rate_operator<Dim>("momentum/p-rho2");
  WorkCount work;
  auto const step = [&](char const* treatment) {
    return [&, treatment] {
      PairGeometry<Dim> geometry{.domain = box.domain, .neighbours = list, .walls = {}, .contacts = {}};
      if (treatment != nullptr) {
        geometry.walls = box.walls;
        for (Wall<Dim> const& wall : geometry.walls)
          geometry.contacts.push_back(find_wall_contacts(grid, wall, geometry.walls, h, box.particles.masses(),
                                                         box.particles.scalar(Field::density), FaceWeight::exact));
        if (WallTreatmentPart const* const part = find_wall_treatment(treatment))
          geometry.behind = stand_behind_walls(
              part->place<Dim>({box.particles, box.domain, geometry.walls, grid, box.layout.spacing}), geometry.contacts, box.particles,
              box.domain);
      }
      scheme->evaluate(box.particles, geometry, Closure::interpolated, 0.0, 1, work);
    };
  };
  std::vector<double> const best = shortest({step(nullptr), step("on"), step("mirror"), step("dummy")});
  fmt::print("walls {}D, {} along an axis: a step without walls {:.2f} ms; with wall terms {:.2f} times as long, mirror {:.2f}, dummy {:.2f}\n",
             Dim, resolution, 1e3 * best[0], best[1] / best[0], best[2] / best[0], best[3] / best[0]);
}

}  // namespace

int main() {
  measure_cells<1>(100'000, 0.3);
  for (double const jitter : {0.0, 0.1, 0.3, 0.45}) measure_cells<2>(300, jitter);
  for (double const jitter : {0.0, 0.1, 0.3, 0.45}) measure_cells<3>(40, jitter);
  measure_pairs<2>(300);
  measure_pairs<3>(48);
  measure_walls<2>(100);
  measure_walls<3>(32);
}
