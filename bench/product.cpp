// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/passes.hpp"
#include "bench/sample.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/density/density.hpp"
#include "formulations/neighbours/locality.hpp"
#include "formulations/viscosity/viscosity.hpp"

namespace sphverify::bench {

namespace {

/// The sample as the product holds it, in a box without walls.
class Cube {
 public:
  Cube(std::size_t side, bool sorted, std::string_view of_kernel = CubicSpline<3>::id)
      : domain{.lower = Vector<3>::Zero(), .upper = Vector<3>::Ones()}, particles(0, 1.0) {
    Sample sample = make_sample(side);
    if (sorted) {
      sample = reordered(sample, locality_order(positions_of(sample), domain, sample.reach()));
    }
    particles = Particles<3>(sample.size(), sample.h);
    particles.positions() = positions_of(sample);
    particles.masses() = sample.m;
    particles.allocate({Field::density, Field::pressure, Field::temperature, Field::conductivity,
                        Field::velocity, Field::sound_speed, Field::acceleration, Field::heating, Field::flux,
                        Field::density_rate});
    particles.scalar(Field::density) = sample.rho;
    particles.scalar(Field::pressure) = sample.P;
    particles.scalar(Field::temperature) = sample.T;
    particles.scalar(Field::conductivity) = sample.K;
    particles.scalar(Field::sound_speed) = sample.c;
    auto& v = particles.vector(Field::velocity);
    v.component(0) = sample.vx;
    v.component(1) = sample.vy;
    v.component(2) = sample.vz;
    geometry.domain = domain;
    particles.set_kernel(kernel(of_kernel, 3));
    find_list(1);
  }

  void find_list(int threads) {
    CellGrid<3> const grid(particles.positions(), domain,
                           particles.kernel().support_ratio() * particles.smoothing_length());
    geometry.neighbours = find_neighbours(grid, threads, std::move(geometry.neighbours));
  }

  Domain<3> domain;
  Particles<3> particles;
  PairGeometry<3> geometry;
  WorkCount work;

 private:
  static VectorField<3> positions_of(Sample const& sample) {
    VectorField<3> x(sample.size());
    x.component(0) = sample.x;
    x.component(1) = sample.y;
    x.component(2) = sample.z;
    return x;
  }
};

/// One sweep of several terms, as a moving gas makes it.
struct GasSweep {
  std::vector<std::unique_ptr<RateOperator<3>>> operators;
  Viscosity viscosity;
  ViscousRates<3> rates;
  bool drifts;

  GasSweep(std::vector<std::string> const& ids, double alpha, double beta, bool continuity, bool drift)
      : viscosity(MonaghanViscosity{alpha, beta}), drifts(drift) {
    for (std::string const& id : ids) operators.push_back(make_rate_operator<3>(id));
    if (continuity) operators.push_back(make_continuity_operator<3>());
  }
  void run(Cube& cube, int threads) {
    PairSweep<3> sweep(cube.geometry.neighbours, cube.domain, threads);
    for (auto const& one : operators) {
      one->begin_pass(0, cube.particles, cube.geometry, Closure::interpolated, 0.0, threads, sweep);
    }
    if (is_on(viscosity)) add_viscosity(viscosity, cube.particles, sweep, rates);
    sweep.run(cube.particles, drifts ? &cube.particles.vector(Field::velocity) : nullptr);
    for (auto const& one : operators) one->end_pass(0, cube.particles, cube.geometry, cube.work);
  }
};

void measure(std::string const& name, std::size_t side, int threads, bool sorted,
             std::function<std::function<void(Cube&)>(Cube&)> const& make_pass,
             std::string const& of_kernel = std::string(CubicSpline<3>::id)) {
  benchmark::RegisterBenchmark(("product/" + name + "/" + std::to_string(side) +
                                (threads > 1 ? "/threads:" + std::to_string(threads) : ""))
                                   .c_str(),
                               [=](benchmark::State& state) {
                                 Cube cube(side, sorted, of_kernel);
                                 auto const pass = make_pass(cube);
                                 time_passes(state, cube.particles.size(), cube.geometry.neighbours.pairs(),
                                             [&] { pass(cube); });
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

auto scheme_pass(std::string const& id, int threads, bool frozen) {
  return [=](Cube& cube) -> std::function<void(Cube&)> {
    std::shared_ptr<RateOperator<3>> const one = make_rate_operator<3>(id);
    if (frozen) one->freeze(cube.particles, cube.geometry, threads);
    return
        [=](Cube& c) { one->evaluate(c.particles, c.geometry, Closure::interpolated, 0.0, threads, c.work); };
  };
}

/// @param drifts whether viscosity rubs with velocities of its own, as in a leapfrog step
auto gas_pass(std::vector<std::string> const& ids, bool viscous, bool continuity, int threads,
              bool drifts = false) {
  return [=](Cube&) -> std::function<void(Cube&)> {
    auto const sweep =
        std::make_shared<GasSweep>(ids, viscous ? 1.0 : 0.0, viscous ? 2.0 : 0.0, continuity, drifts);
    return [=](Cube& cube) { sweep->run(cube, threads); };
  };
}

}  // namespace

void register_product(std::span<std::size_t const> sides) {
  std::vector<std::string> const euler{"momentum/p-rho2", "work/internal-energy"};
  for (std::size_t const side : sides) {
    for (int const threads : {1, 2}) {
      measure("list/from-unsorted", side, threads, false, [=](Cube&) -> std::function<void(Cube&)> {
        return [=](Cube& cube) { cube.find_list(threads); };
      });
      measure("conduction/brookshaw", side, threads, true,
              scheme_pass("conduction/brookshaw", threads, false));
      measure("stored/brookshaw", side, threads, true, scheme_pass("conduction/brookshaw", threads, true));
      measure("density", side, threads, true, [=](Cube&) -> std::function<void(Cube&)> {
        return
            [=](Cube& cube) { sum_density(cube.particles, cube.geometry.neighbours, cube.domain, threads); };
      });
      measure("euler/full", side, threads, true, gas_pass(euler, true, false, threads));
    }
    // Every kernel at the same h: a wider one has more pairs, so compare nanoseconds per pair.
    for (KernelInfo const& info : all_kernel_infos()) {
      std::string const id(info.id);
      measure("kernel/" + id + "/euler", side, 1, true, gas_pass(euler, true, true, 1), id);
      measure("kernel/" + id + "/conduction", side, 1, true, scheme_pass("conduction/brookshaw", 1, false), id);
    }
    // What a scene saves that does without: each line beside euler/full.
    measure("euler/without-viscosity", side, 1, true, gas_pass(euler, false, false, 1));
    measure("euler/without-work", side, 1, true, gas_pass({euler[0]}, true, false, 1));
    measure("euler/with-continuity", side, 1, true, gas_pass(euler, true, true, 1));
    measure("euler/with-drift", side, 1, true, gas_pass(euler, true, true, 1, true));
    measure("momentum/p-rho2", side, 1, true, scheme_pass("momentum/p-rho2", 1, false));
    measure("momentum/sqrt-p", side, 1, true, scheme_pass("momentum/sqrt-p", 1, false));
    measure("conduction/two-pass", side, 1, true, scheme_pass("conduction/campbell-flux", 1, false));
    measure("conduction/brookshaw-unsorted", side, 1, false, scheme_pass("conduction/brookshaw", 1, false));
  }
}

}  // namespace sphverify::bench
