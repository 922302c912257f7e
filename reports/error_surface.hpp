// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sphverify {

/// A number with its 95% interval; each is empty where the data cannot say.
struct Estimate {
  std::optional<double> value, lower, upper;
};

/// One place of a grid over resolution and h/dx, its replicates (the seeds of a layout) merged.
struct SurfaceCell {
  int resolution = 0;            ///< particles along the first axis
  double smoothing_ratio = 0.0;  ///< h/dx
  double spacing = 0.0;          ///< dx [m]
  double particles = 0.0;        ///< in all, mean over the replicates
  int replicates = 0;
  std::optional<double> error;    ///< mean over the replicates; empty if one of them failed
  std::optional<double> spread;   ///< their standard deviation; empty for fewer than two
  std::optional<double> fitted;   ///< the law's error here; empty without a law
  std::optional<double> seconds;  ///< processor time of a run (with several threads wall time), mean
  std::optional<double> pair_interactions;  ///< of a run, mean
};

/// The sampling error of one h/dx, where it is no power of it.
struct SamplingAtRatio {
  double ratio = 0.0;        ///< h/dx
  double coefficient = 0.0;  ///< at the finest spacing, in the unit of the error
};

/// The fitted law of an error over spacing d (in units of the finest one) and r = h/dx:
///   e = F + sqrt(S^2 + Q^2 + 2 c S Q),   S = A (r d)^p  smoothing,   Q = B r^-s d^t  sampling,
/// or Q = B(r) d^t with a B for each ratio of the grid. A term that the model lacks has coefficient 0.
struct SurfaceLaw {
  double unit = 0.0;                      ///< the finest spacing, that d counts in [m]
  double floor = 0.0;                     ///< F, in the unit of the error
  double smoothing_coefficient = 0.0;     ///< A, likewise
  double smoothing_exponent = 0.0;        ///< p
  double sampling_coefficient = 0.0;      ///< B, likewise
  double sampling_exponent = 0.0;         ///< s: how sampling errors fall with h/dx at one spacing
  double spacing_exponent = 0.0;          ///< t: how they fall with the spacing at one h/dx; 0: not at all
  double correlation = 0.0;               ///< c: 1 the two add, 0 their squares do, below 0 they cancel
  std::vector<SamplingAtRatio> sampling;  ///< B(r), by rising h/dx; empty where B r^-s is it
};

/// One of the models that were tried on a surface.
struct SurfaceCandidate {
  std::string model;
  int parameters = 0;
  double criterion = 0.0;  ///< Akaike's with its correction for few data, less the best model's
  double misfit = 0.0;     ///< root mean square of ln(error / law)
};

/// The h/dx of least error at one resolution.
struct BestRatio {
  int resolution = 0;
  Estimate ratio;  ///< by the law, within the grid (of its ratios, where sampling is no power); empty without
                   ///< a law
  std::string edge;             ///< `lower` or `upper`: it is the grid's end, and the best may lie beyond
  std::optional<double> error;  ///< by the law, there
  std::optional<double> grid_ratio;  ///< of the grid's cell of least error, no law asked
  std::optional<double> grid_error;  ///< its error
};

/// What a run costs: C N^a r^b, N particles along the first axis, r = h/dx.
struct CostLaw {
  std::string unit;  ///< `pair_interactions` or `seconds`
  double coefficient = 0.0, resolution_exponent = 0.0, ratio_exponent = 0.0;
  double misfit = 0.0;  ///< root mean square of ln(cost / law)
};

/// Where a surface is to be walked down: the cheapest place of an error.
struct PathPoint {
  double error = 0.0;
  double resolution = 0.0;  ///< particles along the first axis, not rounded
  Estimate ratio;           ///< h/dx
  double cost = 0.0;        ///< in the path's unit
  std::string edge;         ///< `lower` or `upper`: h/dx is the grid's end
};

/// A rule for the neighbour number beside the best path: neighbours ~ (particles in all)^k, which is h/dx ~
/// N^k in any number of dimensions. It starts where the best path does, at the coarsest N, and is compared
/// with it where it leaves the grid.
struct PathRule {
  double exponent = 0.0;    ///< k: 0 keeps h/dx, 0.5 is Zhu, Hernquist & Li's (2015)
  double resolution = 0.0;  ///< N where the two are compared,
  double ratio = 0.0;       ///< h/dx of the rule there,
  double error = 0.0;       ///< and its error
  Estimate error_ratio;  ///< of the rule's error to that of the best path at the same cost; above 1: it costs
  Estimate cost_ratio;   ///< of the rule's cost to that of the best path at the same error
  std::string remark;  ///< that the best path had to be followed beyond the grid, or why a number is missing
};

/// The cheapest way to ever smaller errors, cost counted in one unit.
struct SurfacePath {
  CostLaw cost;
  std::vector<PathPoint> points;  ///< from coarse to fine
  /// k of neighbours ~ (particles in all)^k along the cells that no other beats in error and cost.
  std::optional<double> grid_exponent;
  std::vector<PathRule> rules;
  std::string reason;  ///< why there is no path, or that it runs along the grid's end
};

/// An error over resolution and h/dx: the data, the law that explains them, and what follows from it.
struct ErrorSurface {
  std::string field, region, norm;
  std::vector<SurfaceCell> cells;  ///< by resolution, then by h/dx
  std::string model;               ///< which law explains the cells best; empty: none does
  std::string reason;              ///< why there is none, in words
  std::optional<SurfaceLaw> law;
  std::optional<double> misfit;  ///< root mean square of ln(error / law), also of a law that was refused
  Estimate smoothing_exponent, sampling_exponent, spacing_exponent;  ///< of the law, with intervals
  /// k of neighbours ~ (particles in all)^k along the law's best path, (p - t) / (p + s): the same for every
  /// cost and in any number of dimensions. Empty where the law lacks one of the two terms.
  Estimate neighbour_exponent;
  std::vector<SurfaceCandidate> candidates;  ///< from the best
  std::vector<BestRatio> best;               ///< by resolution, of those that have an error
  std::vector<SurfacePath> paths;            ///< by unit of cost
};

}  // namespace sphverify
