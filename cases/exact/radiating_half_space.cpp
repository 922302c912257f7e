// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/radiating_half_space.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double half_pi = 0.5 * std::numbers::pi;
constexpr double first_interval = 0.4;  // of z, over the exponent: in it the wall changes by a tenth
constexpr double growth = 1.5;
constexpr double latest = 1e5;       // z
constexpr double negligible = 6.5;   // exp(-6.5^2) = 4e-19
constexpr int most_iterations = 50;  // of Newton's method, which takes about five

using GaussRule = boost::math::quadrature::gauss<double, 20>;

/// v^n, odd in v.
double power(double v, int n) { return std::copysign(std::pow(std::abs(v), n), v); }

/// psi at which a past time z cos(psi) was `end`.
double angle(double end, double z) { return std::atan2(std::sqrt((z - end) * (z + end)), end); }

/// Chebyshev's points on [-1, 1], ascending, ends included.
template <int Degree>
std::array<double, Degree + 1> chebyshev_points() {
  std::array<double, Degree + 1> points;
  for (int j = 0; j <= Degree; ++j) points[j] = -std::cos(std::numbers::pi * j / Degree);
  return points;
}

double larger(double start, double environment) {
  if (start > 0.0 || environment > 0.0) return std::max(start, environment);
  throw BadValue("start", "positive where the environment is at 0", brief(start));
}

int require_exponent(int exponent) {
  if (exponent >= 1 && exponent <= 8) return exponent;
  throw BadValue("exponent", "from 1 to 8", std::to_string(exponent));
}

}  // namespace

RadiatingHalfSpace::RadiatingHalfSpace(double radiation, int exponent, double start, double environment,
                                       double conductivity, double density)
    : radiation_(require_positive("radiation", radiation)),
      exponent_(require_exponent(exponent)),
      start_(require_not_negative("start", start)),
      environment_(require_not_negative("environment", environment)),
      conductivity_(require_positive("conductivity", conductivity)),
      unit_(larger(start, environment)),
      length_(require_positive("the depth that the wall feels",
                               conductivity / (radiation * std::pow(unit_, exponent - 1)))),
      time_(require_positive("the time that the wall takes",
                             length_ * length_ * require_positive("density", density) / conductivity)) {
  solve();
}

double RadiatingHalfSpace::scaled_loss(double v) const {
  return power(v, exponent_) - power(environment_ / unit_, exponent_);
}

double RadiatingHalfSpace::lost(double wall_temperature) const {
  return radiation_ * (power(wall_temperature, exponent_) - power(environment_, exponent_));
}

/// Polynomial through values at an interval's Chebyshev points, by the barycentric formula.
double RadiatingHalfSpace::at_nodes(std::size_t interval, Values const& values, double z) const {
  static Values const points = chebyshev_points<degree>();
  double const middle = 0.5 * (ends_[interval] + ends_[interval + 1]);
  double const half = 0.5 * (ends_[interval + 1] - ends_[interval]);
  double above = 0.0;
  double below = 0.0;
  for (int j = 0; j <= degree; ++j) {
    double const distance = (z - middle) / half - points[j];
    if (distance == 0.0) return values[j];
    double const weight = (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 || j == degree ? 0.5 : 1.0) / distance;
    above += weight * values[j];
    below += weight;
  }
  return above / below;
}

/// Integral over psi of loss(T_w(z cos psi)) z cos(psi) kernel(sin psi), over the time of the first
/// intervals.
/// @param depth x in units over 2 z: where the kernel falls as exp(-depth^2/sin^2(psi)); 0 where it is smooth
template <class Kernel>
double RadiatingHalfSpace::memory(double z, std::size_t intervals, double depth, Kernel const& kernel) const {
  double sum = 0.0;
  double upper = half_pi;
  for (std::size_t k = 0; k < intervals; ++k) {
    auto const integrand = [&](double psi) {
      double const past = z * std::cos(psi);
      return at_nodes(k, loss_[k], past) * past * kernel(std::sin(psi));
    };
    double const end = angle(std::min(ends_[k + 1], z), z);
    while (upper > end) {
      if (depth > negligible * std::sin(upper)) return sum;
      double const lower = depth > 0.0 ? std::max(end, 0.5 * upper) : end;
      sum += GaussRule::integrate(integrand, lower, upper);
      upper = lower;
    }
  }
  return sum;
}

/// What the loss at an interval's node b takes from the wall at its node a > 0: (a - 1, b).
RadiatingHalfSpace::OwnWeights RadiatingHalfSpace::own_weights(std::size_t interval) const {
  Values const points = chebyshev_points<degree>();
  double const middle = 0.5 * (ends_[interval] + ends_[interval + 1]);
  double const half = 0.5 * (ends_[interval + 1] - ends_[interval]);
  OwnWeights weight;
  for (int b = 0; b <= degree; ++b) {
    Values one{};
    one[b] = 1.0;
    for (int a = 1; a <= degree; ++a) {
      double const z = middle + half * points[a];
      auto const share = [&](double psi) {
        double const past = z * std::cos(psi);
        return at_nodes(interval, one, past) * past;
      };
      weight(a - 1, b) =
          2.0 * std::numbers::inv_sqrtpi * GaussRule::integrate(share, 0.0, angle(ends_[interval], z));
    }
  }
  return weight;
}

void RadiatingHalfSpace::solve() {
  using Vector = Eigen::Matrix<double, degree, 1>;
  using Matrix = Eigen::Matrix<double, degree, degree>;
  Values const points = chebyshev_points<degree>();
  OwnWeights weight;
  ends_ = {0.0, first_interval / exponent_};
  double before = start_ / unit_;
  for (std::size_t k = 0;; ++k) {
    double const middle = 0.5 * (ends_[k] + ends_[k + 1]);
    double const half = 0.5 * (ends_[k + 1] - ends_[k]);
    Vector known;
    for (int a = 1; a <= degree; ++a) {
      double const z = middle + half * points[a];
      known[a - 1] =
          start_ / unit_ - 2.0 * std::numbers::inv_sqrtpi * memory(z, k, 0.0, [](double) { return 1.0; });
    }
    if (k < 2) {
      weight = own_weights(k);
    } else {
      weight *= growth;  // the intervals but the first are alike
    }
    Vector v = Vector::Constant(before);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      Vector residual = v - known + weight.col(0) * scaled_loss(before);
      Matrix slope = Matrix::Identity();
      for (int b = 0; b < degree; ++b) {
        residual += weight.col(b + 1) * scaled_loss(v[b]);
        slope.col(b) += weight.col(b + 1) * exponent_ * std::pow(std::abs(v[b]), exponent_ - 1);
      }
      Vector const step = slope.partialPivLu().solve(residual);
      v -= step;
      if (step.cwiseAbs().maxCoeff() < 4.0 * std::numeric_limits<double>::epsilon()) break;
    }
    Values& wall = wall_.emplace_back();
    Values& loss = loss_.emplace_back();
    wall[0] = before;
    for (int b = 0; b < degree; ++b) wall[b + 1] = v[b];
    std::transform(wall.begin(), wall.end(), loss.begin(), [&](double T) { return scaled_loss(T); });
    before = wall.back();
    if (ends_.back() >= latest) return;
    ends_.push_back(growth * ends_.back());
  }
}

double RadiatingHalfSpace::scaled_time(double t) const {
  double const z = std::sqrt(require_not_negative("time", t) / time_);
  if (z <= latest) return z;
  throw BadValue("time", "at most " + brief(latest * latest * time_), brief(t));
}

/// Index of the interval that holds z.
std::size_t RadiatingHalfSpace::interval_of(double z) const {
  auto const after = std::lower_bound(ends_.begin() + 1, ends_.end() - 1, z);
  return static_cast<std::size_t>(after - ends_.begin()) - 1;
}

double RadiatingHalfSpace::wall_temperature(double t) const {
  double const z = scaled_time(t);
  std::size_t const k = interval_of(z);
  return unit_ * at_nodes(k, wall_[k], z);
}

double RadiatingHalfSpace::temperature(double x, double t) const {
  if (x <= 0.0) return wall_temperature(t);
  double const z = scaled_time(t);
  if (z == 0.0) return start_;
  double const depth = 0.5 * x / length_ / z;
  double const taken = memory(z, interval_of(z) + 1, depth,
                              [depth](double sine) { return std::exp(-depth * depth / (sine * sine)); });
  return start_ - unit_ * 2.0 * std::numbers::inv_sqrtpi * taken;
}

double RadiatingHalfSpace::gradient(double x, double t) const {
  if (x <= 0.0) return lost(wall_temperature(t)) / conductivity_;
  double const z = scaled_time(t);
  if (z == 0.0) return 0.0;
  double const depth = 0.5 * x / length_ / z;
  // d/dX of -X^2/(4 z^2 sin^2(psi)) is -depth/(z sin^2(psi)).
  double const taken = memory(z, interval_of(z) + 1, depth, [depth](double sine) {
    return std::exp(-depth * depth / (sine * sine)) / (sine * sine);
  });
  return unit_ / length_ * 2.0 * std::numbers::inv_sqrtpi * depth / z * taken;
}

double RadiatingHalfSpace::accuracy() const { return 1e-11 * unit_; }

}  // namespace sphverify::exact
