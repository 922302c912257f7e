// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "reports/error_surface.hpp"

namespace sphverify {

/// Where a surface may be asked: between its coarsest and finest resolution and its smallest and largest
/// h/dx.
struct SurfaceRange {
  double coarsest = 0.0, finest = 0.0;  ///< N, particles along the first axis
  double finest_spacing = 0.0;          ///< dx there; elsewhere it is as 1/N
  double lowest = 0.0, highest = 0.0;   ///< h/dx
};

/// A place on a surface.
struct SurfacePlace {
  double resolution = 0.0, ratio = 0.0, error = 0.0, cost = 0.0;
  std::string edge;  ///< `lower` or `upper`: h/dx is the range's end
};

/// C N^a r^b.
double surface_cost(CostLaw const& cost, double resolution, double ratio);

/// An error law on a range: where it is least, and how it is walked down at least cost. Where sampling errors
/// are known by ratio only, the ratios are those and none between them.
class SurfaceWalk {
 public:
  SurfaceWalk(SurfaceLaw const& law, SurfaceRange const& range);

  double error(double resolution, double ratio) const;

  /// The h/dx of least error at a resolution.
  SurfacePlace best(double resolution) const;

  /// The least error that a cost buys, at any resolution: that which the cost and h/dx leave.
  SurfacePlace best_for(double cost_spent, CostLaw const& cost) const;

  /// The least cost of an error; empty where it is not reached within a millionth to a million times the cost
  /// of the finest resolution.
  std::optional<SurfacePlace> cheapest(double error, CostLaw const& cost) const;

  /// The cheapest way through the range: places of rising cost that lie within its resolutions.
  /// @param most of them, from the cheapest
  std::vector<SurfacePlace> path(CostLaw const& cost,
                                 std::size_t most = std::numeric_limits<std::size_t>::max()) const;

 private:
  template <typename ErrorOf>
  SurfacePlace least(ErrorOf const& error_of) const;

  SurfaceLaw law_;
  SurfaceRange range_;
  bool continuous_;             ///< any h/dx may be taken
  std::vector<double> ratios_;  ///< looked at
};

/// ln(h/dx) over ln(N) of places, by least squares: k of neighbours ~ (particles in all)^k. Empty for fewer
/// than three resolutions.
std::optional<double> neighbour_exponent(std::vector<SurfacePlace> const& places);

/// neighbours ~ (particles in all)^k from a place to where the range ends, beside the best path.
PathRule follow_rule(double exponent, SurfaceWalk const& walk, SurfacePlace const& start, CostLaw const& cost,
                     SurfaceRange const& range);

/// C N^a r^b through costs, by least squares of the logarithms (GSL); empty for fewer than four cells, or if
/// all have one N or one r.
struct CostDatum {
  double resolution, ratio, cost;
};
std::optional<CostLaw> fit_cost(std::string const& unit, std::vector<CostDatum> const& data);

}  // namespace sphverify
