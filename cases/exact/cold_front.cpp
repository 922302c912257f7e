// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/cold_front.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double toe = 1e-20;     // w/cold at which the integration starts
constexpr double spacing = 0.01;  // of the table in y
constexpr double tolerance = 1e-14;

/// The wave's equation in y = ln w, from its toe upwards.
class Rise {
 public:
  Rise(double exponent, double cold, double start) : exponent_(exponent), cold_(cold), y_(start) {}
  Rise(Rise const&) = delete;

  /// @param place xi of the toe
  void begin(double place) {
    state_[0] = place;
    // p = xi/2 + cold^n/(2 p), since p hardly changes there.
    state_[1] = 0.25 * place + std::sqrt(0.0625 * place * place + 0.5 * std::pow(cold_, exponent_));
  }

  /// Integrates up to y; false where p has fallen to 0, so that the wave ends before.
  bool go_to(double y) { return gsl_odeiv2_driver_apply(driver_.get(), &y_, y, state_) == GSL_SUCCESS; }

  double level() const { return y_; }
  double place() const { return state_[0]; }
  double steepness() const { return state_[1]; }

 private:
  static int derivatives(double y, double const* state, double* slope, void* data) {
    Rise const& rise = *static_cast<Rise const*>(data);
    if (!(state[1] > 0.0)) return GSL_EDOM;  // a shorter step is tried then
    slope[0] = -std::pow(rise.cold_ + std::exp(y), rise.exponent_) / state[1];
    slope[1] = 0.5 * state[0] - state[1];
    return GSL_SUCCESS;
  }

  using Driver = std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)>;
  Driver allocate() {
    Driver driver(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, 1e-2, tolerance, tolerance),
                  &gsl_odeiv2_driver_free);
    if (!driver) throw std::bad_alloc();
    return driver;
  }

  double exponent_;
  double cold_;
  double y_;
  double state_[2]{};
  gsl_odeiv2_system system_{&Rise::derivatives, nullptr, 2, this};
  Driver driver_ = allocate();
};

struct Target {
  double exponent, cold, lowest, highest;

  /// xi where w has risen to the wall's, if the toe is at `place`; negative too where it never does.
  double miss(double place) const {
    Rise rise(exponent, cold, lowest);
    rise.begin(place);
    return rise.go_to(highest) ? rise.place() : -1.0 - (highest - rise.level());
  }
};

/// xi of the toe from which the wave ends at the wall.
double shoot(Target target) {
  double upper = 1.0;
  while (target.miss(upper) < 0.0) upper *= 2.0;
  double lower = 0.5 * upper;
  while (target.miss(lower) > 0.0) lower *= 0.5;
  gsl_function function;
  function.function = [](double place, void* data) { return static_cast<Target*>(data)->miss(place); };
  function.params = &target;
  std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> const solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (!solver) throw std::bad_alloc();
  gsl_root_fsolver_set(solver.get(), &function, lower, upper);
  constexpr int most_steps = 200;
  constexpr double relative = 2.0 * std::numeric_limits<double>::epsilon();
  for (int step = 0; step < most_steps; ++step) {
    gsl_root_fsolver_iterate(solver.get());
    lower = gsl_root_fsolver_x_lower(solver.get());
    upper = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(lower, upper, 0.0, relative) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

double between_cold_and_hot(double cold) {
  require_positive("cold temperature", cold);
  if (cold < 1.0) return cold;
  throw BadValue("cold temperature", "below the wall's 1", brief(cold));
}

double conducting(double exponent, double cold) {
  require_not_negative("exponent", exponent);
  double const digits = -exponent * std::log10(cold);
  if (digits < 200.0) return exponent;
  throw BadValue("exponent",
                 "at most " + brief(-200.0 / std::log10(cold)) + ", for cold^exponent above 1e-200",
                 brief(exponent));
}

}  // namespace

ColdFront::ColdFront(double exponent, double cold, double conductivity)
    : exponent_(conducting(exponent, between_cold_and_hot(cold))),
      cold_(cold),
      conductivity_(require_positive("conductivity", conductivity)),
      lowest_(std::log(toe * cold)) {
  double const highest = std::log1p(-cold);
  int const intervals = static_cast<int>(std::ceil((highest - lowest_) / spacing));
  step_ = (highest - lowest_) / intervals;
  Rise rise(exponent, cold, lowest_);
  rise.begin(shoot({exponent, cold, lowest_, highest}));
  nodes_.push_back({rise.place(), rise.steepness()});
  for (int k = 1; k <= intervals; ++k) {
    if (!rise.go_to(lowest_ + k * step_)) {
      throw std::invalid_argument("the wave into the cold medium could not be integrated");
    }
    nodes_.push_back({rise.place(), rise.steepness()});
  }
  nodes_.back().place = 0.0;  // but for the rounding of the shooting
}

double ColdFront::excess(double rank) const { return std::exp(lowest_ + rank * step_); }

ColdFront::Jet ColdFront::place_jet(std::size_t k) const {
  auto const [place, p] = nodes_[k];
  double const w = excess(static_cast<double>(k));
  double const slope = -std::pow(cold_ + w, exponent_) / p;
  double const curvature = slope * (exponent_ * w / (cold_ + w) - (0.5 * place - p) / p);
  return {place, slope * step_, curvature * step_ * step_};
}

ColdFront::Jet ColdFront::steepness_jet(std::size_t k) const {
  auto const [place, p] = nodes_[k];
  double const slope = (0.5 * place - p) * step_;
  return {p, slope, (0.5 * place_jet(k).first - slope) * step_};
}

/// The quintic that has both jets, at s = 0 and 1.
double ColdFront::between(double s, Jet const& low, Jet const& high) {
  double const jump = high.value - low.value - low.first - 0.5 * low.second;
  double const slope = high.first - low.first - low.second;
  double const curve = high.second - low.second;
  double const a = 10.0 * jump - 4.0 * slope + 0.5 * curve;
  double const b = -15.0 * jump + 7.0 * slope - curve;
  double const c = 6.0 * jump - 3.0 * slope + 0.5 * curve;
  return low.value + s * (low.first + s * (0.5 * low.second + s * (a + s * (b + s * c))));
}

double ColdFront::rank_of(double place) const {
  auto const after = std::lower_bound(nodes_.begin(), nodes_.end(), place,
                                      [](Node const& node, double xi) { return node.place > xi; });
  if (after == nodes_.begin()) return -1.0;
  auto const k = static_cast<std::size_t>(after - nodes_.begin()) - 1;
  Jet const low = place_jet(k);
  Jet const high = place_jet(k + 1);
  auto const beyond = [&](double s) { return between(s, low, high) - place; };
  std::uintmax_t steps = 100;
  auto const [from, to] =
      boost::math::tools::toms748_solve(beyond, 0.0, 1.0, low.value - place, high.value - place,
                                        boost::math::tools::eps_tolerance<double>(), steps);
  return static_cast<double>(k) + 0.5 * (from + to);
}

double ColdFront::temperature(double x, double t) const {
  require_not_negative("time", t);
  if (x <= 0.0) return 1.0;
  if (t == 0.0) return cold_;
  double const rank = rank_of(x / std::sqrt(conductivity_ * t));
  return rank < 0.0 ? cold_ : std::min(cold_ + excess(rank), 1.0);
}

double ColdFront::gradient(double x, double t) const {
  require_not_negative("time", t);
  if (t == 0.0) return x > 0.0 ? 0.0 : -std::numeric_limits<double>::infinity();
  double const length = std::sqrt(conductivity_ * t);
  double const rank = rank_of(std::max(x, 0.0) / length);
  if (rank < 0.0) return 0.0;
  auto const k = std::min(static_cast<std::size_t>(rank), nodes_.size() - 2);
  double const p = between(rank - static_cast<double>(k), steepness_jet(k), steepness_jet(k + 1));
  double const w = excess(rank);
  return -p * w / std::pow(cold_ + w, exponent_) / length;
}

double ColdFront::conductivity(double temperature) const {
  return exponent_ == 0.0 ? conductivity_ : conductivity_ * std::pow(std::max(temperature, 0.0), exponent_);
}

double ColdFront::place_of(double excess) const {
  double const rank = (std::log(excess) - lowest_) / step_;
  auto const k = std::min(static_cast<std::size_t>(rank), nodes_.size() - 2);
  return between(rank - static_cast<double>(k), place_jet(k), place_jet(k + 1));
}

double ColdFront::front(double t) const {
  return place_of(0.5 * (1.0 - cold_)) * std::sqrt(conductivity_ * require_not_negative("time", t));
}

double ColdFront::foot(double t) const {
  return place_of(std::min(cold_, 1.0 - cold_)) * std::sqrt(conductivity_ * require_not_negative("time", t));
}

double ColdFront::foot_width(double t) const {
  auto const k = static_cast<std::size_t>((std::log(std::min(cold_, 1.0 - cold_)) - lowest_) / step_);
  return std::abs(place_jet(k).first) / step_ * std::sqrt(conductivity_ * require_not_negative("time", t));
}

double ColdFront::heat(double t) const {
  // The wall's flux falls as 1/sqrt(t), so that twice what it would bring by now has come.
  return 2.0 * nodes_.back().steepness * (1.0 - cold_) *
         std::sqrt(conductivity_ * require_not_negative("time", t));
}

double ColdFront::accuracy() const { return 1e-11; }

}  // namespace sphverify::exact
