// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/sample.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace sphverify::bench {

namespace {

constexpr std::array all_fields{&Sample::x, &Sample::y,   &Sample::z, &Sample::vx, &Sample::vy, &Sample::vz,
                                &Sample::m, &Sample::rho, &Sample::P, &Sample::c,  &Sample::T,  &Sample::K};

/// Uniform in [-1, 1). Unlike std::uniform_real_distribution it is the same with every library.
class Noise {
 public:
  double operator()() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1.0; }

 private:
  std::mt19937_64 engine_{20240229};
};

}  // namespace

Sample make_sample(std::size_t per_side) {
  double const dx = 1.0 / static_cast<double>(per_side);
  Sample sample{.spacing = dx, .h = 1.2 * dx};
  for (auto const field : all_fields) (sample.*field).reserve(per_side * per_side * per_side);
  Noise noise;
  auto const place = [&](std::size_t k) { return (static_cast<double>(k) + 0.5 + 0.1 * noise()) * dx; };
  for (std::size_t a = 0; a < per_side; ++a) {
    for (std::size_t b = 0; b < per_side; ++b) {
      for (std::size_t c = 0; c < per_side; ++c) {
        double const x = place(c);
        double const y = place(b);
        double const z = place(a);
        double const rho = 1.0 + 0.2 * x + 0.01 * noise();
        double const P = 1.0 + 0.5 * y + 0.01 * noise();
        sample.x.push_back(x);
        sample.y.push_back(y);
        sample.z.push_back(z);
        sample.vx.push_back(std::sin(6.0 * x + y) + 0.1 * noise());
        sample.vy.push_back(std::sin(6.0 * y + z) + 0.1 * noise());
        sample.vz.push_back(std::sin(6.0 * z + x) + 0.1 * noise());
        sample.m.push_back(rho * dx * dx * dx * (1.0 + 0.01 * noise()));
        sample.rho.push_back(rho);
        sample.P.push_back(P);
        sample.c.push_back(std::sqrt(5.0 / 3.0 * P / rho));
        sample.T.push_back(1.0 + std::sin(3.0 * x) * std::cos(2.0 * y) + z * z + 0.01 * noise());
        sample.K.push_back(1.0 + 0.3 * z + 0.01 * noise());
      }
    }
  }

  std::vector<std::uint32_t> order(sample.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937_64 engine(7);
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[engine() % k]);
  return reordered(sample, order);
}

Sample reordered(Sample const& sample, std::span<std::uint32_t const> order) {
  Sample result{.spacing = sample.spacing, .h = sample.h};
  for (auto const field : all_fields) {
    (result.*field).reserve(order.size());
    for (std::uint32_t const i : order) (result.*field).push_back((sample.*field)[i]);
  }
  return result;
}

}  // namespace sphverify::bench
