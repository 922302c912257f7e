// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/memory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formulations/rate_operator.hpp"
#include "harness/scene/place.hpp"

namespace sphverify {

namespace {

/// @param support in dx, as everywhere here
template <int Dim>
double neighbours_per_particle(double support) {
  if (Dim == 1) return 2.0 * support;
  if (Dim == 2) return std::numbers::pi * support * support;
  return 4.0 / 3.0 * std::numbers::pi * support * support * support;
}

/// Particles are 1/resolution of the first axis apart.
template <int Dim>
double contacts_per_particle(Problem<Dim> const& problem, int resolution, double support) {
  Vector<Dim> const extent = problem.domain.extent();
  double const reach = support * extent[0] / resolution;
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    if (!problem.domain.periodic[static_cast<std::size_t>(axis)]) sum += std::min(1.0, reach / extent[axis]);
  }
  return problem.walls.empty() ? 0.0 : 2.0 * sum;
}

}  // namespace

std::string why_not(AnyProblem const& problem, LayoutChoice const& layout) {
  try {
    estimated_particles(problem, layout, 1);
    return "";
  } catch (std::invalid_argument const& error) {
    return error.what();
  }
}

double estimated_particles(AnyProblem const& problem, LayoutChoice const& layout, int resolution) {
  return std::visit([&](auto const& p) { return particle_count(p.domain, layout, resolution); }, problem);
}

double estimated_pairs(AnyProblem const& problem, LayoutChoice const& layout, int resolution,
                       double support) {
  return std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        return particle_count(p.domain, layout, resolution) * neighbours_per_particle<Dim>(support);
      },
      problem);
}

double estimated_bytes(CaseKind kind, std::string_view integrator, AnyProblem const& problem,
                       LayoutChoice const& layout, int resolution, double support) {
  return std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        // Indices of neighbours, in part twice while a list is made. In moving lists a skin is included;
        // where conduction is integrated a conductance is beside each index. Runs are timed one by one, each
        // with a scene of its own after the measured one's is gone.
        double const per_pair = moves(kind) ? 14.5 : (kind == CaseKind::rates ? 5.3 : 15.0);
        // Fields, records of the sweep, and the integrator's copies of all unknowns.
        double const copies = integrator == "leapfrog" ? 2.5 : 6.5;
        double const copied =
            moves(kind) ? copies * (2.0 * Dim + 2.0) : (kind == CaseKind::rates ? 0.0 : 12.0);
        double const per_particle = (moves(kind) ? 350.0 : 215.0) + 8.0 * copied;
        // Whom a wall's foot point interpolates from, and more while it is found anew.
        double const per_interpolated = moves(kind) ? 20.0 : 8.0;
        double const neighbours = neighbours_per_particle<Dim>(support);
        return particle_count(p.domain, layout, resolution) *
               (per_particle +
                neighbours * (per_pair + per_interpolated * contacts_per_particle(p, resolution, support)));
      },
      problem);
}

double bytes_of_weights(FormulationChoice const& formulation, AnyProblem const& problem, LayoutChoice const& layout,
                        int resolution, double support) {
  for (std::string const& id : {formulation.id, formulation.conduction}) {
    SchemeInfo const* const scheme = find_scheme(id);
    if (scheme && scheme->least_squares) return 16.0 * estimated_pairs(problem, layout, resolution, support);
  }
  return 0.0;
}

}  // namespace sphverify
