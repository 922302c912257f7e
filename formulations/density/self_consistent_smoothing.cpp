// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/self_consistent_smoothing.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "formulations/basics/parallel.hpp"
#include "formulations/density/density.hpp"

namespace sphverify {

namespace {

/// How far a guess is looked beyond at first: between two evaluations of moving particles h usually changes
/// by less.
constexpr double usual_widening = 1.2;
constexpr int most_doublings = 60;
constexpr int most_halvings = 60;
constexpr int bits = 46;

/// A particle's equation for x, its smoothing length in units of the guess: how much of it is missing at x,
/// as a part of the whole. Falls with x.
template <int Dim>
class MissingMass {
 public:
  MissingMass(SelfConsistentSmoothing<Dim> const& all, std::size_t i, double guess)
      : place_(all.positions[i]),
        walls_(all.walls),
        kernel_(all.kernel),
        guess_(guess),
        whole_(std::pow(all.ratio, Dim) / all.kernel.sigma()) {}

  /// What may be within the support at x, all of which is asked for before.
  void meet(double mass_ratio, double distance) {
    mass_ratio_.push_back(mass_ratio);
    distance_.push_back(distance / guess_);
  }

  double operator()(double x) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < distance_.size(); ++k) {
      double const q = distance_[k] / x;
      if (q < kernel_.support_ratio()) sum += mass_ratio_[k] * kernel_.shape(q);
    }
    if (!walls_.empty()) sum /= kernel_inside(place_, walls_, x * guess_, kernel_);
    return 1.0 - sum / whole_;
  }

 private:
  Vector<Dim> place_;
  std::vector<Wall<Dim>> const& walls_;
  Kernel const& kernel_;
  double guess_;
  double whole_;
  std::vector<double> mass_ratio_;  ///< m_j/m_i
  std::vector<double> distance_;    ///< in units of the guess
};

/// The x between 0 and `upper` at which nothing is missing, where something is not at `upper`.
template <int Dim>
double root(MissingMass<Dim> const& missing, double upper, double at_upper, std::size_t particle) {
  double lower = 1.0 / usual_widening;
  double at_lower = missing(lower);
  for (int halving = 0; at_lower < 0.0; ++halving) {
    if (halving == most_halvings) {
      throw std::invalid_argument(
          "no smoothing length of particle " + std::to_string(particle) +
          " is short enough for the density summed with it: another is in its place, or it is on or "
          "outside a wall");
    }
    upper = lower;
    at_upper = at_lower;
    lower *= 0.5;
    at_lower = missing(lower);
  }
  std::uintmax_t steps = 200;
  auto const [below, above] = boost::math::tools::toms748_solve(
      missing, lower, upper, at_lower, at_upper, boost::math::tools::eps_tolerance<double>(bits), steps);
  return 0.5 * (below + above);
}

}  // namespace

template <int Dim>
void SelfConsistentSmoothing<Dim>::solve(std::vector<double>& smoothing_length) const {
  double const support = kernel.support_ratio();
  double widest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < Dim; ++k) {
    if (domain.periodic[k]) widest = std::min(widest, 0.5 * domain.extent()[k]);
  }
  std::vector<double> h = smoothing_length;
  auto const makes_no_sense = [&](std::size_t i) {
    return !(std::isnormal(h[i]) && h[i] > 0.0 && std::isnormal(masses[i]) && masses[i] > 0.0);
  };
  if (auto const i = first_row(h.size(), threads, makes_no_sense)) {
    throw std::invalid_argument("particle " + std::to_string(*i) + " has no positive, finite mass and smoothing length");
  }
  for_each_row(h.size(), threads, [&](std::size_t i) { h[i] = std::min(h[i], widest / support); });
  std::vector<std::size_t> open(h.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  double widening = usual_widening;
  // Who turns out to need more than was looked at is looked at again, twice as far.
  for (int doubling = 0; !open.empty(); ++doubling, widening *= 2.0) {
    if (doubling == most_doublings) {
      throw std::invalid_argument("no smoothing length of particle " + std::to_string(open.front()) +
                                  " is long enough for the density summed with it: it is alone in the open");
    }
    double longest = 0.0;
    for (std::size_t const i : open) longest = std::max(longest, h[i]);
    double const reach = std::min(support * widening * longest, widest);
    CellGrid<Dim> const grid(positions, domain, reach, threads);
    enum : char { not_yet, solved, fills_the_box };
    std::vector<char> end(open.size(), not_yet);
    for_each_row(open.size(), threads, [&](std::size_t row) {
      std::size_t const i = open[row];
      double const upper = std::min(widening, reach / (support * h[i]));
      MissingMass<Dim> missing(*this, i, h[i]);
      grid.for_each_within_reach(positions[i], [&](std::uint32_t j, Vector<Dim> const&, double distance) {
        if (distance < support * upper * h[i]) missing.meet(masses[j] / masses[i], distance);
      });
      double const at_upper = missing(upper);
      if (at_upper > 0.0) {
        if (support * widening * h[i] > widest) end[row] = fills_the_box;
        return;
      }
      h[i] *= root(missing, upper, at_upper, i);
      end[row] = solved;
    });
    if (std::find(end.begin(), end.end(), fills_the_box) != end.end()) {
      throw std::invalid_argument(
          "the smoothing lengths that the summed density asks for are too long for the periodic box");
    }
    std::size_t left = 0;
    for (std::size_t row = 0; row < open.size(); ++row) {
      if (end[row] == not_yet) open[left++] = open[row];
    }
    open.resize(left);
  }
  smoothing_length = std::move(h);
}

template struct SelfConsistentSmoothing<1>;
template struct SelfConsistentSmoothing<2>;
template struct SelfConsistentSmoothing<3>;

}  // namespace sphverify
