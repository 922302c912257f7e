// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/initial_snapshot.hpp"

#include "harness/codes/csv.hpp"
#include "harness/codes/hdf5.hpp"
#include "harness/codes/read_snapshot.hpp"
#include "harness/scene/initial_particles.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

template <int Dim>
Snapshot snapshot_of(CaseKind kind, Problem<Dim> const& problem, Discretisation const& discretisation, int resolution,
                     double smoothing_ratio) {
  InitialParticles<Dim> const start = initial_particles(problem, discretisation, resolution, smoothing_ratio);
  Particles<Dim> const& particles = start.particles;
  std::size_t const n = particles.size();
  Snapshot s;
  s.time = 0.0;
  if (problem.gamma > 0.0) s.gamma = problem.gamma;
  auto const put_vector = [&](std::array<char const*, 3> const& names, VectorField<Dim> const& field) {
    for (int k = 0; k < Dim; ++k) s.columns[names[static_cast<std::size_t>(k)]] = field.component(k);
  };
  auto const put_exact = [&](char const* column, Field field) {
    if (!problem.scalars.contains(field)) return;
    auto const& exact = problem.scalars.at(field);
    auto& values = s.columns[column];
    for (std::size_t i = 0; i < n; ++i) values.push_back(exact(particles.positions()[i], 0.0));
  };
  put_vector(position_columns, particles.positions());
  s.columns["m"] = particles.masses();
  s.columns["h"].assign(n, particles.smoothing_length());
  if (moves(kind)) {
    InitialGas<Dim> const gas = initial_gas(problem, particles, start.cut_cells);
    put_vector(velocity_columns, gas.velocity);
    s.columns["rho"] = gas.density;
    s.columns["e"] = gas.internal_energy;
    s.columns["T"] = gas.internal_energy;  // specific heat 1
    auto& pressure = s.columns["P"];
    for (std::size_t i = 0; i < n; ++i)
      pressure.push_back((problem.gamma - 1.0) * gas.density[i] * gas.internal_energy[i]);
  } else {
    put_exact("rho", Field::density);
    for (CutCell<Dim> const& cell : start.cut_cells) s.columns["rho"][cell.particle] = mean_density(problem, cell);
    put_exact("P", Field::pressure);
    put_exact("e", Field::internal_energy);
    put_exact("T", Field::temperature);
    if (auto const velocity = problem.vectors.find(Field::velocity); velocity != problem.vectors.end()) {
      VectorField<Dim> field(n);
      for (std::size_t i = 0; i < n; ++i) field.set(i, velocity->second(particles.positions()[i], 0.0));
      put_vector(velocity_columns, field);
    }
  }
  if (problem.conductivity && s.has("T")) {
    auto& conductivity = s.columns["K"];
    conductivity.resize(n);
    fill_conductivity(problem, particles.positions(), start.cut_cells, s.columns.at("T"), 1, conductivity);
  }
  return s;
}

}  // namespace

Snapshot initial_snapshot(CaseKind kind, AnyProblem const& problem, Discretisation const& discretisation, int resolution,
                          double smoothing_ratio) {
  return std::visit(
      [&](auto const& p) { return snapshot_of(kind, p, discretisation, resolution, smoothing_ratio); }, problem);
}

void write_initial_particles(std::string const& path, std::string const& format, Snapshot const& snapshot,
                             AnyProblem const& problem, Discretisation const& discretisation) {
  if (format == "csv") return write_document(path, csv_text(snapshot));
  std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        Kernel const& used = kernel(discretisation.kernel, Dim);
        Vector<Dim> const extent = p.domain.extent();
        Snapshot moved = snapshot;
        if (format == "swift" && p.domain.is_turned())
          throw UserError(path, "--format", "swift, and a case whose domain is turned", "csv, hdf5 or pysph");
        if (format == "swift") {
          // Its boxes begin at 0.
          for (int k = 0; k < Dim; ++k) {
            for (double& x : moved.columns.at(position_columns[static_cast<std::size_t>(k)])) x -= p.domain.lower[k];
          }
        }
        write_hdf5_snapshot(path, moved,
                            {.format = format,
                             .dimension = Dim,
                             .box = {extent.begin(), extent.end()},
                             .support_over_h = used.support_ratio(),
                             .support_over_two_sigma = support_over_two_sigma(used)});
      },
      problem);
}

}  // namespace sphverify
