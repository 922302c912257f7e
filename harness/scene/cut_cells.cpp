// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/cut_cells.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "formulations/basics/expects.hpp"

namespace sphverify {

namespace {

struct Interval {
  double lower, upper;
};

/// How far boxes of a width about the places must be moved for `wanted` of their number to be below the jump,
/// parts of boxes counted.
double shift_of(std::vector<double> const& places, double width, double jump, double wanted) {
  auto const below = [&](double shift) {
    double sum = 0.0;
    for (double const x : places) sum += std::clamp((jump - x - shift) / width + 0.5, 0.0, 1.0);
    return sum;
  };
  // It falls as the boxes move up; beyond the ends of the bracket all are on one side.
  auto const [first, last] = std::minmax_element(places.begin(), places.end());
  double low = jump - *last - width;
  double high = jump - *first + width;
  for (int step = 0; step < 200; ++step) {
    double const middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (below(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Every particle's cell along the domain's first axis, from its place there.
template <int Dim>
class Cells {
 public:
  Cells(Problem<Dim> const& problem, Layout<Dim> const& layout, LayoutChoice const& choice)
      : layout_(layout), lower_(problem.domain.lower[0]), width_(layout.cell[0]) {
    if (choice.id == "hexagonal") centred_ = true;
    if (choice.id == "close-packed") {  // two layers to a cubic cell
      centred_ = true;
      width_ *= 0.5;
    }
    if (choice.id == "glass" || (choice.id == "random" && Dim > 1)) {
      centred_ = true;
      width_ = layout.spacing;
      std::vector<double> places(layout.volumes.size());
      for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = problem.domain.to_box(layout.positions[i])[0];
      for (double const jump : problem.initial_jumps) {
        double const part = (jump - lower_) / problem.domain.extent()[0];
        jumps_.push_back(jump);
        shifts_.push_back(shift_of(places, width_, jump, part * static_cast<double>(places.size())));
      }
    }
  }

  Interval of(std::size_t particle, double x) const {
    if constexpr (Dim == 1) {
      return {layout_.edges[particle], layout_.edges[particle + 1]};
    } else {
      if (centred_) {
        double const middle = x + shift_near(x);
        return {middle - 0.5 * width_, middle + 0.5 * width_};
      }
      double const cell = std::floor((x - lower_) / width_);
      return {lower_ + cell * width_, lower_ + (cell + 1.0) * width_};
    }
  }

 private:
  double shift_near(double x) const {
    if (jumps_.empty()) return 0.0;
    auto const nearest = std::min_element(
        jumps_.begin(), jumps_.end(), [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
    return shifts_[static_cast<std::size_t>(nearest - jumps_.begin())];
  }

  Layout<Dim> const& layout_;
  double lower_, width_;
  bool centred_ = false;
  std::vector<double> jumps_, shifts_;  ///< where cells are in no order
};

/// Gauss's places and weights in an interval, for which they add up to its length over `whole`.
template <int Dim>
void add_samples(CutCell<Dim>& cell, Interval const& piece, double whole, Vector<Dim> at,
                 Domain<Dim> const& domain) {
  using Rule = boost::math::quadrature::gauss<double, 5>;
  double const middle = 0.5 * (piece.lower + piece.upper);
  double const half = 0.5 * (piece.upper - piece.lower);
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    double const node = Rule::abscissa()[k];
    for (double const side : {-1.0, 1.0}) {
      if (node == 0.0 && side > 0.0) continue;
      at[0] = middle + side * node * half;
      cell.samples.emplace_back(domain.to_space(at), Rule::weights()[k] * half / whole);
    }
  }
}

}  // namespace

template <int Dim>
std::vector<CutCell<Dim>> cut_cells(Problem<Dim> const& problem, Layout<Dim> const& layout,
                                    LayoutChoice const& choice) {
  std::vector<CutCell<Dim>> cut;
  if (problem.initial_jumps.empty()) return cut;
  Domain<Dim> const& domain = problem.domain;
  expects(!domain.periodic[0]);
  // A jump between two cells cuts neither, however their edges have been rounded.
  double const rounding = 16.0 * std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(domain.lower[0]), std::abs(domain.upper[0]));
  Cells<Dim> const cells(problem, layout, choice);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    Vector<Dim> const at = domain.to_box(layout.positions[i]);
    Interval const own = cells.of(i, at[0]);
    // The particle itself may lie beside its cell, where these are in no order.
    Interval const seen{std::min(own.lower, at[0]), std::max(own.upper, at[0])};
    std::vector<double> edges{own.lower};
    bool is_cut = false;
    for (double const jump : problem.initial_jumps) {
      is_cut = is_cut || (jump > seen.lower + rounding && jump < seen.upper - rounding);
      if (jump > own.lower + rounding && jump < own.upper - rounding) edges.push_back(jump);
    }
    if (!is_cut) continue;
    edges.push_back(own.upper);
    double const width = own.upper - own.lower;
    CutCell<Dim>& cell = cut.emplace_back(CutCell<Dim>{i, Dim == 1 ? width : layout.volumes[i], {}});
    for (std::size_t e = 0; e + 1 < edges.size(); ++e)
      add_samples(cell, {edges[e], edges[e + 1]}, width, at, domain);
  }
  return cut;
}

template <int Dim>
CellState<Dim> held(CutCell<Dim> const& cell, Problem<Dim> const& problem) {
  auto const& rho = problem.scalars.at(Field::density);
  auto const& e = problem.scalars.at(Field::internal_energy);
  auto const& v = problem.vectors.at(Field::velocity);
  using Point = Vector<Dim>;
  double const density = cell.mean([&](Point const& x) { return rho(x, 0.0); });
  Point const momentum = cell.mean([&](Point const& x) -> Point { return rho(x, 0.0) * v(x, 0.0); });
  Point const velocity = momentum / density;
  // Of the motion against each other, rather than the difference of two energies, in which cold fast gas
  // would lose its temperature to rounding.
  double const heat = cell.mean(
      [&](Point const& x) { return rho(x, 0.0) * (e(x, 0.0) + 0.5 * (v(x, 0.0) - velocity).squaredNorm()); });
  return {density, velocity, heat / density};
}

template std::vector<CutCell<1>> cut_cells(Problem<1> const&, Layout<1> const&, LayoutChoice const&);
template std::vector<CutCell<2>> cut_cells(Problem<2> const&, Layout<2> const&, LayoutChoice const&);
template std::vector<CutCell<3>> cut_cells(Problem<3> const&, Layout<3> const&, LayoutChoice const&);
template CellState<1> held(CutCell<1> const&, Problem<1> const&);
template CellState<2> held(CutCell<2> const&, Problem<2> const&);
template CellState<3> held(CutCell<3> const&, Problem<3> const&);

}  // namespace sphverify
