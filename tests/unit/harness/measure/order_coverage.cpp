// SPDX-License-Identifier: GPL-3.0-or-later
// How often the intervals hold the truth, over families of ladders whose truth is known. Fixed seeds: the
// same ladders on every machine.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "harness/measure/order.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_order_coverage)

using namespace sphverify;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return std::ldexp(static_cast<double>(engine_() >> 11) + 0.5, -53); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {
    double const radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

/// What came of the ladders of one family.
struct Tally {
  int ladders = 0, told = 0, covered = 0, floors_told = 0, floors_covered = 0, asymptotic = 0;
  std::vector<double> half_widths;

  void add(ObservedOrder const& observed, double order, double floor = 0.0) {
    ++ladders;
    asymptotic += observed.verdict == "asymptotic";
    if (observed.order) {
      ++told;
      covered += *observed.lower <= order && order <= *observed.upper;
      half_widths.push_back(0.5 * (*observed.upper - *observed.lower));
    }
    if (observed.floor) {
      ++floors_told;
      floors_covered += observed.floor->lower <= floor && floor <= observed.floor->upper;
    }
  }
  void add(Tally const& other) {
    ladders += other.ladders;
    told += other.told;
    covered += other.covered;
    floors_told += other.floors_told;
    floors_covered += other.floors_covered;
    half_widths.insert(half_widths.end(), other.half_widths.begin(), other.half_widths.end());
  }
  /// A null interval leaves nothing out, but a method that never answers would be none: `told` is looked at
  /// too.
  double coverage() const { return static_cast<double>(covered + ladders - told) / ladders; }
  double floor_coverage() const { return static_cast<double>(floors_covered) / std::max(1, floors_told); }
  double median_half_width() {
    std::sort(half_widths.begin(), half_widths.end());
    return half_widths.empty() ? INFINITY : half_widths[half_widths.size() / 2];
  }
  std::string text() {
    return std::to_string(told) + " of " + std::to_string(ladders) + " told, " + std::to_string(covered) +
           " hold the order, median half width " + std::to_string(median_half_width()) + ", floors " +
           std::to_string(floors_covered) + " of " + std::to_string(floors_told);
  }
};

/// A ladder by halving from 1/25, with lognormal noise on each replicate.
template <class Error>
std::vector<LadderLevel> ladder(Random& random, std::size_t levels, int replicates, double noise,
                                Error const& error) {
  std::vector<LadderLevel> all;
  double spacing = 0.04;
  for (std::size_t k = 0; k < levels; ++k) {
    LadderLevel level{spacing, {}, 0.0};
    for (int r = 0; r < replicates; ++r)
      level.errors.push_back(error(spacing) * (noise > 0.0 ? std::exp(noise * random.normal()) : 1.0));
    all.push_back(level);
    spacing *= 0.5;
  }
  return all;
}

BOOST_AUTO_TEST_CASE(intervals_of_noisy_powers_hold_the_order) {
  Random random(1);
  for (int const replicates : {1, 3, 5}) {
    Tally tally;
    for (int k = 0; k < 150; ++k) {
      double const p = random.between(0.5, 4.0);
      double const noise = 0.02 * std::pow(10.0, random.uniform());
      tally.add(observed_order(
                    ladder(random, 4 + k % 3, replicates, noise, [p](double d) { return std::pow(d, p); })),
                p);
    }
    BOOST_TEST_MESSAGE(replicates << " seeds: " << tally.text());
    BOOST_TEST(tally.coverage() >= 0.95, tally.text());
    BOOST_TEST(tally.told > 0.85 * tally.ladders);
  }
}

struct NextTerm {
  double p, q;
};
constexpr NextTerm next_terms[] = {{1.0, 1.0}, {2.0, 2.0}, {2.0, 1.0}};

BOOST_AUTO_TEST_CASE(clean_ladders_with_a_next_term_have_narrow_intervals_that_hold_the_order) {
  Random random(2);
  Tally four;
  for (auto const& [p, q] : next_terms) {
    for (std::size_t const levels : {4u, 5u, 6u}) {
      Tally tally;
      for (double c = -4.0; c <= 4.0; c += 1.0) {
        auto const law = [p = p, q = q, c](double d) { return std::pow(d, p) * (1.0 + c * std::pow(d, q)); };
        ObservedOrder const observed = observed_order(ladder(random, levels, 1, 0.0, law));
        tally.add(observed, p);
        BOOST_TEST(observed.verdict == "asymptotic",
                   "p " << p << " q " << q << " c " << c << ": " << observed.reason);
      }
      BOOST_TEST(tally.coverage() == 1.0, "p " << p << " q " << q << ": " << tally.text());
      BOOST_TEST(tally.told == tally.ladders);
      if (levels == 4) four.add(tally);
    }
  }
  BOOST_TEST(four.median_half_width() < 0.15, four.text());
}

BOOST_AUTO_TEST_CASE(intervals_of_noisy_ladders_with_a_next_term_hold_the_order) {
  Random random(3);
  for (auto const& [p, q] : next_terms) {
    Tally tally;
    for (int k = 0; k < 150; ++k) {
      double const c = random.between(-4.0, 4.0);
      double const noise = 0.01 * std::pow(20.0, random.uniform());
      auto const law = [p = p, q = q, c](double d) { return std::pow(d, p) * (1.0 + c * std::pow(d, q)); };
      tally.add(observed_order(ladder(random, 4 + k % 3, 1 + 4 * (k % 2), noise, law)), p);
    }
    BOOST_TEST_MESSAGE("order " << p << ", next " << q << ": " << tally.text());
    BOOST_TEST(tally.coverage() >= 0.95, tally.text());
    BOOST_TEST(tally.told > 0.8 * tally.ladders);
  }
}

BOOST_AUTO_TEST_CASE(intervals_of_ladders_on_a_floor_hold_order_and_floor) {
  Random random(4);
  for (double const noise : {0.0, 0.03, 0.1}) {
    Tally tally;
    for (int k = 0; k < 150; ++k) {
      double const p = random.between(0.5, 4.0);
      double const floor = 1e-4 * std::pow(3000.0, random.uniform());
      auto const law = [p, floor](double d) { return floor + (1.0 - floor) * std::pow(25.0 * d, p); };
      tally.add(observed_order(ladder(random, 4 + k % 3, noise > 0.0 ? 1 + 4 * (k % 2) : 1, noise, law)), p,
                floor);
    }
    BOOST_TEST_MESSAGE("noise " << noise << ": " << tally.text());
    BOOST_TEST(tally.coverage() >= 0.95, tally.text());
    BOOST_TEST(tally.floor_coverage() >= 0.95, tally.text());
    BOOST_TEST(tally.floors_told > (noise == 0.0 ? 0.8 : 0.3) * tally.ladders);
  }
}

BOOST_AUTO_TEST_CASE(more_levels_and_more_seeds_make_verdicts_surer) {
  auto const asymptotic = [](std::size_t levels, int replicates) {
    Random random(5);
    Tally tally;
    for (int k = 0; k < 60; ++k)
      tally.add(observed_order(ladder(random, levels, replicates, 0.2, [](double d) { return d; })), 1.0);
    return tally.asymptotic;
  };
  int const few = asymptotic(4, 2), more_seeds = asymptotic(4, 10), more_levels = asymptotic(6, 5);
  BOOST_TEST_MESSAGE("asymptotic of 60: " << few << ", " << more_seeds << ", " << more_levels);
  BOOST_TEST(few < more_seeds);
  BOOST_TEST(more_levels > 48);
}

BOOST_AUTO_TEST_SUITE_END()
