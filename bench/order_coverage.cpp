// SPDX-License-Identifier: GPL-3.0-or-later
// How often the intervals of observed orders hold the truth, family by family: the table of
// docs/decisions/0009. Fixed seeds: the same table on every machine. A few minutes of one core.
//
//   sphverify_order_coverage [LADDERS]
//
// LADDERS of each family (80), of 4, 5 and 6 levels, by halving from 1/25.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "harness/measure/order.hpp"

namespace {

using namespace sphverify;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double normal() {
    double const radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  double uniform() { return std::ldexp(static_cast<double>(engine_() >> 11) + 0.5, -53); }
  std::mt19937_64 engine_;
};

/// Ladders of one law with one noise, number of seeds and number of levels.
struct Family {
  double order;
  std::function<double(double spacing)> law;
  double noise;
  int seeds;
  int levels;
};

struct Tally {
  int ladders = 0, told = 0, held = 0;
  std::vector<double> half_widths;
};

Tally tally(Family const& family, int ladders) {
  Random random(20260101);
  Tally found;
  for (int n = 0; n < ladders; ++n) {
    std::vector<LadderLevel> levels;
    double spacing = 0.04;
    for (int k = 0; k < family.levels; ++k, spacing *= 0.5) {
      LadderLevel level{spacing, {}, 0.0};
      for (int s = 0; s < family.seeds; ++s)
        level.errors.push_back(family.law(spacing) * std::exp(family.noise * random.normal()));
      levels.push_back(level);
    }
    ObservedOrder const observed = observed_order(levels);
    ++found.ladders;
    if (!observed.order || !observed.lower) continue;
    ++found.told;
    found.held += *observed.lower <= family.order && family.order <= *observed.upper;
    found.half_widths.push_back(0.5 * (*observed.upper - *observed.lower));
  }
  return found;
}

/// One line of the table.
void print(std::string const& name, std::vector<Family> const& families, int ladders) {
  int told = 0, held = 0;
  double least = 1.0, least_told = 1.0, most_told = 0.0;
  std::vector<std::vector<double>> half_widths(3);
  for (Family const& family : families) {
    // Without noise one ladder is as another.
    Tally const one = tally(family, family.noise > 0.0 ? ladders : 1);
    double const told_part = static_cast<double>(one.told) / one.ladders;
    told += one.told;
    held += one.held;
    least_told = std::min(least_told, told_part);
    most_told = std::max(most_told, told_part);
    if (told_part >= 0.5) least = std::min(least, static_cast<double>(one.held) / one.told);
    auto& widths = half_widths[static_cast<std::size_t>(family.levels - 4)];
    widths.insert(widths.end(), one.half_widths.begin(), one.half_widths.end());
  }
  std::vector<std::string> medians;
  for (auto& widths : half_widths) {
    std::sort(widths.begin(), widths.end());
    medians.push_back(widths.empty() ? "-" : fmt::format("{:.3f}", widths[widths.size() / 2]));
  }
  fmt::print("| {} | {:.1f}% | {:.0f}% | {:.0f}% to {:.0f}% | {} |\n", name, 100.0 * held / std::max(1, told),
             100.0 * least, 100.0 * least_told, 100.0 * most_told, fmt::join(medians, " "));
  std::fflush(stdout);
}

std::vector<Family> powers(double noise) {
  std::vector<Family> all;
  for (double const p : {0.5, 1.0, 2.0, 3.0, 4.0})
    for (int const seeds : {1, 3, 5})
      for (int const levels : {4, 5, 6})
        all.push_back({p, [p](double d) { return std::pow(d, p); }, noise, seeds, levels});
  return all;
}

std::vector<Family> next_terms(double p, double q, std::vector<double> const& noises) {
  std::vector<Family> all;
  for (double const noise : noises)
    for (double c = -4.0; c <= 4.0; c += noise > 0.0 ? 2.0 : 1.0)
      for (int const seeds : noise > 0.0 ? std::vector<int>{1, 5} : std::vector<int>{1})
        for (int const levels : {4, 5, 6})
          all.push_back({p, [p, q, c](double d) { return std::pow(d, p) * (1.0 + c * std::pow(d, q)); },
                         noise, seeds, levels});
  return all;
}

std::vector<Family> floors(std::vector<double> const& orders, std::vector<double> const& sizes,
                           double noise) {
  std::vector<Family> all;
  for (double const p : orders)
    for (double const F : sizes)
      for (int const seeds : noise > 0.0 ? std::vector<int>{1, 5} : std::vector<int>{1})
        for (int const levels : {4, 5, 6})
          all.push_back(
              {p, [p, F](double d) { return F + (1.0 - F) * std::pow(25.0 * d, p); }, noise, seeds, levels});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  int const n = argc > 1 ? std::atoi(argv[1]) : 80;
  fmt::print(
      "| families | hold, of those told | least in a family | told | half width, 4, 5, 6 levels "
      "|\n|---|---|---|---|---|\n");
  for (double const noise : {0.02, 0.2})
    print(fmt::format("powers 0.5 to 4, {:g}% noise", 100 * noise), powers(noise), n);
  for (auto const& [p, q, name] :
       {std::tuple{1.0, 1.0, "h(1 + c h)"}, {2.0, 1.0, "h^2(1 + c h)"}, {2.0, 2.0, "h^2(1 + c h^2)"}}) {
    print(fmt::format("{}, clean", name), next_terms(p, q, {0.0}), n);
    print(fmt::format("{}, 1% and 10% noise", name), next_terms(p, q, {0.01, 0.1}), n);
  }
  std::vector<double> const orders{0.5, 1.0, 1.5, 2.0, 3.0, 4.0}, sizes{1e-4, 1e-3, 1e-2, 0.1, 0.3};
  for (double const noise : {0.0, 0.02, 0.1})
    print(fmt::format("F + A h^p, p 0.5 to 4, F 1e-4 to 0.3, {:g}% noise", 100 * noise),
          floors(orders, sizes, noise), n);
  for (double const noise : {0.03, 0.1})
    print(fmt::format("F + A h, F + A h^2, F 0.03, 0.1, 0.3, {:g}% noise", 100 * noise),
          floors({1.0, 2.0}, {0.03, 0.1, 0.3}, noise), n);
}
