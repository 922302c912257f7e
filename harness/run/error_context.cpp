// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/error_context.hpp"

#include <cmath>

#include "harness/measure/allowed_order.hpp"
#include "harness/run/exact_fields.hpp"

namespace sphverify {

namespace {

bool is_finite(NormSet const& n) {
  return std::isfinite(n.l1) && std::isfinite(n.l2) && std::isfinite(n.linf);
}

template <int Dim>
FieldErrors errors_of_initial_state(Problem<Dim> const& problem, Particles<Dim> const& particles, Field field,
                                    std::vector<double> const& weights, std::vector<Region> const& regions) {
  if (info(field).is_vector) {
    auto const& exact = problem.vectors.at(field);
    VectorField<Dim> const before = sample(exact, particles, 0.0);
    VectorField<Dim> const after = sample(exact, particles, problem.final_time);
    return field_errors(components(before), components(after), weights, regions, 0.0);
  }
  auto const& exact = problem.scalars.at(field);
  return field_errors({sample(exact, particles, 0.0)}, {sample(exact, particles, problem.final_time)},
                      weights, regions, 0.0);
}

}  // namespace

template <int Dim>
void add_error_context(Problem<Dim> const& problem, Particles<Dim> const& particles,
                       std::vector<double> const& weights, std::vector<Region> const& regions,
                       std::map<std::string, FieldErrors>& errors) {
  Features<Dim> const features = final_features(problem);
  for (FieldInfo const& one : field_infos) {
    auto const found = errors.find(std::string(one.name));
    if (found == errors.end()) continue;
    FieldErrors const initial = errors_of_initial_state(problem, particles, one.field, weights, regions);
    std::vector<double> exact;
    if (!one.is_vector) exact = sample(problem.scalars.at(one.field), particles, problem.final_time);
    for (Region const& region : regions) {
      RegionError& error = found->second.at(region.name);
      NormSet const& norms = initial.at(region.name).error;
      if (is_finite(norms)) error.initial = norms;
      if (!one.is_vector) error.mean = mean_difference(particles.scalar(one.field), exact, weights, region);
      error.allowed = allowed_orders(one.field, features, particles, region);
    }
  }
}

template void add_error_context(Problem<1> const&, Particles<1> const&, std::vector<double> const&,
                                std::vector<Region> const&, std::map<std::string, FieldErrors>&);
template void add_error_context(Problem<2> const&, Particles<2> const&, std::vector<double> const&,
                                std::vector<Region> const&, std::map<std::string, FieldErrors>&);
template void add_error_context(Problem<3> const&, Particles<3> const&, std::vector<double> const&,
                                std::vector<Region> const&, std::map<std::string, FieldErrors>&);

}  // namespace sphverify
