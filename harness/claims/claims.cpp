// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/claims.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "formulations/rate_operator.hpp"
#include "harness/claims/defects.hpp"

namespace sphverify {

namespace {

using Defect = std::optional<double> (*)(SchemeInfo const&, Kernel const&);

/// A claim by its defect in 1, 2 and 3 dimensions.
struct Question {
  std::string words;
  bool claimed;
  double allowed;
  std::array<Defect, 3> defect;
};

#define SPHVERIFY_IN_DIMENSIONS(defect) \
  { claims::defect<1>, claims::defect<2>, claims::defect<3> }

char const* name_of(ConductivityMean mean) {
  switch (mean) {
    case ConductivityMean::arithmetic:
      return "arithmetic";
    case ConductivityMean::harmonic:
      return "harmonic";
    case ConductivityMean::geometric:
      return "geometric";
    case ConductivityMean::unknown:
      break;
  }
  return "unknown";
}

std::vector<Question> questions(SchemeInfo const& s) {
  bool const is_momentum = s.rate == Rate::acceleration;
  int const powers = s.claims.lattice_factors < 0 ? derivatives_taken(s) : s.claims.lattice_factors;
  std::string const linear = powers == 0   ? "linear fields: the exact derivative on a lattice"
                             : powers == 1 ? "linear fields: the derivative times the lattice's factor"
                                           : fmt::format("linear fields: the derivative times factor^{}", powers);
  return {
      {is_momentum ? "pairs conserve momentum" : "pairs conserve energy",
       s.conserves.contains(is_momentum ? Invariant::momentum : Invariant::energy), 1e-13,
       SPHVERIFY_IN_DIMENSIONS(pair_budget)},
      {"pairs conserve energy together with " + std::string(s.work_partner),
       s.claims.energy_with_partner, 1e-13, SPHVERIFY_IN_DIMENSIONS(energy_with_partner)},
      {"particles gain what the walls give", true, 1e-12, SPHVERIFY_IN_DIMENSIONS(wall_budget)},
      {"a uniform state is steady on a lattice", true, 1e-12, SPHVERIFY_IN_DIMENSIONS(uniform_on_lattice)},
      {"a uniform state is steady on any particles", s.claims.steady_on_any_particles, 1e-12,
       SPHVERIFY_IN_DIMENSIONS(uniform_on_jittered)},
      {linear, s.claims.linear_on_lattice, 1e-6, SPHVERIFY_IN_DIMENSIONS(linear_on_lattice)},
      {"moving, turning and mirroring all changes nothing", true, 1e-10, SPHVERIFY_IN_DIMENSIONS(covariance)},
      {"the order of the particles does not matter", true, 1e-10, SPHVERIFY_IN_DIMENSIONS(numbering)},
      {"a common velocity changes nothing", s.claims.galilean_invariant, 1e-10, SPHVERIFY_IN_DIMENSIONS(boost)},
      {"continuous where a neighbour leaves the support", s.claims.continuous_at_support, 1e-4,
       SPHVERIFY_IN_DIMENSIONS(at_the_support)},
      {fmt::format("pairs conduct by the {} mean", name_of(s.claims.mean)), true, 1e-12,
       SPHVERIFY_IN_DIMENSIONS(conductivity_mean)}};
}

/// Nothing where no dimension and no kernel has an answer.
std::optional<ClaimResult> answer(SchemeInfo const& scheme, Question const& question) {
  ClaimResult result;
  result.claim = question.words;
  result.claimed = question.claimed;
  result.allowed = question.allowed;
  bool looked = false;
  std::string refusal;
  std::array<bool, 3> in{};
  for (KernelInfo const& info : all_kernel_infos()) {
    for (int dimension = 1; dimension <= 3; ++dimension) {
      std::optional<double> found;
      try {
        found = question.defect[static_cast<std::size_t>(dimension - 1)](scheme, kernel(info.id, dimension));
      } catch (std::invalid_argument const& error) {
        refusal = error.what();
        continue;
      }
      if (!found) continue;
      // What is no number fails every claim.
      double const defect = std::isnan(*found) ? INFINITY : *found;
      if (!looked || defect > result.found) {
        result.found = defect;
        result.where = fmt::format("{}D, {}", dimension, info.id);
      }
      looked = in[static_cast<std::size_t>(dimension - 1)] = true;
    }
  }
  if (!looked && refusal.empty()) return std::nullopt;
  result.is_looked_at = looked;
  if (refusal.empty()) return result;
  std::string where;
  for (int dimension = 1; dimension <= 3; ++dimension) {
    if (!in[static_cast<std::size_t>(dimension - 1)]) where += fmt::format("{}{}D", where.empty() ? "" : ", ", dimension);
  }
  if (!where.empty()) result.remark = fmt::format("not looked at in {}: {}", where, refusal);
  return result;
}

}  // namespace

std::vector<ClaimResult> check_claims(SchemeInfo const& scheme) {
  std::vector<ClaimResult> results;
  for (Question const& question : questions(scheme)) {
    if (auto const result = answer(scheme, question)) results.push_back(*result);
  }
  return results;
}

}  // namespace sphverify
