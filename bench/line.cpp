// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <string>

#include "bench/benchmarks.hpp"
#include "bench/passes.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/kernels/cubic_spline.hpp"

namespace sphverify::bench {

namespace {

constexpr double smoothing_ratio = 1.2;

/// Equal particles side by side on [0, 1], without walls.
struct Line {
  Domain<1> domain{.lower = Vector<1>::Zero(), .upper = Vector<1>::Ones()};
  Particles<1> particles;
  PairGeometry<1> geometry;
  WorkCount work;

  explicit Line(std::size_t count) : particles(count, smoothing_ratio / static_cast<double>(count)) {
    double const dx = 1.0 / static_cast<double>(count);
    particles.masses().assign(count, dx);
    particles.allocate(
        {Field::density, Field::temperature, Field::conductivity, Field::heating, Field::flux});
    particles.scalar(Field::density).assign(count, 1.0);
    particles.scalar(Field::conductivity).assign(count, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      double const x = (static_cast<double>(i) + 0.5) * dx;
      particles.positions().component(0)[i] = x;
      particles.scalar(Field::temperature)[i] = 1.0 + std::sin(3.0 * x);
    }
    CellGrid<1> const grid(particles.positions(), domain,
                           CubicSpline<1>::support_ratio * particles.smoothing_length());
    geometry.domain = domain;
    geometry.neighbours = find_neighbours(grid, 1, NeighbourList{});
  }
};

/// Adds to the counters of time_passes how many particles' rates a second of processor time gives.
void measure(std::string const& name, std::string const& scheme, std::size_t count, bool frozen) {
  benchmark::RegisterBenchmark(
      ("product/line/" + name + "/" + std::to_string(count)).c_str(),
      [=](benchmark::State& state) {
        Line line(count);
        auto const rates = make_rate_operator<1>(scheme);
        if (frozen) rates->freeze(line.particles, line.geometry, 1);
        time_passes(state, count, line.geometry.neighbours.pairs(), [&] {
          rates->evaluate(line.particles, line.geometry, Closure::interpolated, 0.0, 1, line.work);
        });
        double const ns_per_particle = state.counters["ns_per_pair"] * state.counters["pairs_per_particle"];
        state.counters["million_updates_per_s"] = 1e3 / ns_per_particle;
      })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_line() {
  for (std::size_t const count : {std::size_t{10'000}, std::size_t{1'000'000}}) {
    measure("brookshaw", "conduction/brookshaw", count, false);
    measure("brookshaw-stored", "conduction/brookshaw", count, true);
    measure("two-pass", "conduction/campbell-flux", count, false);
  }
}

}  // namespace sphverify::bench
