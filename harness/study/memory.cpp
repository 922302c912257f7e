#include "harness/study/memory.hpp"

#include <unistd.h>

#include <cmath>
#include <numbers>

#include "harness/scene/place.hpp"

namespace sphverify {

namespace {

template <int Dim>
double neighbours_per_particle(double smoothing_ratio) {
  double const support = 2.0 * smoothing_ratio;  // in dx
  if (Dim == 1) return 2.0 * support;
  if (Dim == 2) return std::numbers::pi * support * support;
  return 4.0 / 3.0 * std::numbers::pi * support * support * support;
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
                       double smoothing_ratio) {
  return std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        return particle_count(p.domain, layout, resolution) * neighbours_per_particle<Dim>(smoothing_ratio);
      },
      problem);
}

double estimated_bytes(AnyProblem const& problem, LayoutChoice const& layout, int resolution,
                       double smoothing_ratio) {
  return std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        // Indices of neighbours, twice while a list is made; where particles stand still, a conductance
        // beside each.
        double const per_pair = 8.0 + (p.gamma > 0.0 ? 0.0 : 8.0);
        // Fields, records of the sweep, and the integrator's copies of all unknowns.
        double const unknowns = p.gamma > 0.0 ? 2.0 * Dim + 2.0 : 1.0;
        double const per_particle = 300.0 + 8.0 * 12.0 * unknowns;
        return particle_count(p.domain, layout, resolution) *
               (per_particle + per_pair * neighbours_per_particle<Dim>(smoothing_ratio));
      },
      problem);
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace sphverify
