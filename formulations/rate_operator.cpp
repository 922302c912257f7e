// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/rate_operator.hpp"

#include <cmath>
#include <string>
#include <tuple>

#include "formulations/all.hpp"
#include "formulations/basics/readable.hpp"
#include "formulations/density/continuity.hpp"
#include "formulations/scheme_operator.hpp"

namespace sphverify {

void require_non_negative(SchemeInfo const& scheme, std::string_view quantity, std::vector<double> const& values,
                          std::optional<std::size_t> wall) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0.0 || std::isnan(values[i])) continue;
    throw UndefinedRate(std::string(scheme.id) + " is undefined for negative " + std::string(quantity) + ": " +
                        (wall ? "wall " + std::to_string(*wall) : "particle " + std::to_string(i)) + " has " +
                        readable(values[i], 3));
  }
}

namespace {

std::vector<SchemePart>& parts() {
  static std::vector<SchemePart> all = std::apply(
      [](auto... scheme) { return std::vector<SchemePart>{scheme_part<decltype(scheme)>()...}; }, AllSchemes{});
  return all;
}

SchemePart const* find_part(std::string_view id) {
  for (SchemePart const& part : parts()) {
    if (part.info->id == id) return &part;
  }
  return nullptr;
}

}  // namespace

void add_scheme(SchemePart const& part) {
  if (find_part(part.info->id)) throw std::invalid_argument("two schemes are called " + std::string(part.info->id));
  parts().push_back(part);
}

std::vector<SchemePart> const& all_scheme_parts() { return parts(); }

std::vector<SchemeInfo const*> all_scheme_infos() {
  std::vector<SchemeInfo const*> infos;
  for (SchemePart const& part : parts()) infos.push_back(part.info);
  return infos;
}

SchemeInfo const* find_scheme(std::string_view id) {
  SchemePart const* const part = find_part(id);
  return part ? part->info : nullptr;
}

template <int Dim>
void RateOperator<Dim>::evaluate(Particles<Dim>& particles, PairGeometry<Dim>& geometry, Closure closure,
                                 double time, int threads, WorkCount& work) {
  ++work.evaluations;
  for (int pass = 0; pass < passes(); ++pass) {
    PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads);
    begin_pass(pass, particles, geometry, closure, time, threads, sweep);
    if (!sweep.empty()) sweep.run(particles);
    end_pass(pass, particles, geometry, work);
  }
}

template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_rate_operator(std::string_view id) {
  SchemePart const* const part = find_part(id);
  if (!part) throw std::invalid_argument("unknown formulation '" + std::string(id) + "'");
  return part->make<Dim>();
}

template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_continuity_operator() {
  return std::make_unique<SchemeOperator<ContinuityDensity, Dim>>();
}

template class RateOperator<1>;
template class RateOperator<2>;
template class RateOperator<3>;
template std::unique_ptr<RateOperator<1>> make_continuity_operator();
template std::unique_ptr<RateOperator<2>> make_continuity_operator();
template std::unique_ptr<RateOperator<3>> make_continuity_operator();
template std::unique_ptr<RateOperator<1>> make_rate_operator<1>(std::string_view);
template std::unique_ptr<RateOperator<2>> make_rate_operator<2>(std::string_view);
template std::unique_ptr<RateOperator<3>> make_rate_operator<3>(std::string_view);

}  // namespace sphverify
