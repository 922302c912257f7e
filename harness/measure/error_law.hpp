// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "harness/measure/normal_mixture.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// The mean error of one level of a ladder, and how far its replicates scatter.
struct LevelError {
  double spacing;          ///< [any unit]
  double error;            ///< mean over the replicates, positive
  int replicates;          ///< 1 or more
  double scatter_squared;  ///< sum over the replicates of (error / mean - 1)^2
};

/// The laws that an error may follow as the spacing d goes to 0.
enum class LawKind {
  power,        ///< A d^p
  next_first,   ///< A d^p (1 + c d)
  next_second,  ///< A d^p (1 + c d^2)
  floor,        ///< F + A d^p
  alternation   ///< A d^p, times b and 1/b in turn
};
inline constexpr std::array law_kinds{LawKind::power, LawKind::next_first, LawKind::next_second,
                                      LawKind::floor, LawKind::alternation};
std::string_view name_of(LawKind kind);

/// What the levels say of one law.
struct LawEvidence {
  LawKind kind;
  double probability = 0.0;   ///< among the laws
  ErrorLaw best;              ///< the most likely member of the law; d in units of the finest spacing
  double scatter = 0.0;       ///< what it leaves of log(error): root mean square over the degrees of freedom
  NormalMixture order;        ///< of p
  NormalMixture local_order;  ///< d log e / d log d at the finest level
  NormalMixture log_floor;    ///< of log F; empty without a floor
  NormalMixture floor_share;  ///< F over the error at the finest level; empty without a floor
};

/// Weighs the laws by Bayes' rule: the scatter of the logarithms about the law is normal and alike for all
/// levels; of replicates it is known from them, but for a part that all replicates of a level share. A and
/// the order are integrated in closed form (on a floor the order is linearised about its best value), the
/// shape on adapted cells, the scatter on a grid (docs/decisions/0009).
/// @param levels coarse to fine, two or more, spacings different
std::vector<LawEvidence> weigh_laws(std::vector<LevelError> const& levels);

}  // namespace sphverify
