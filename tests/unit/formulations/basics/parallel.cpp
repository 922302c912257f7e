// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "formulations/basics/parallel.hpp"

BOOST_AUTO_TEST_SUITE(formulations_basics_parallel)

using namespace sphverify;
using boost::test_tools::tolerance;

std::vector<double> some_numbers(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<double> values(count);
  // Of sizes so different that the order of a sum shows.
  for (double& value : values) value = std::exp(30.0 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5));
  return values;
}

BOOST_AUTO_TEST_CASE(blocks_cover_everything_once) {
  for (std::size_t const count :
       {std::size_t{0}, std::size_t{1}, std::size_t{1024}, std::size_t{1025}, std::size_t{100'000}}) {
    for (int const threads : {1, 2, 5}) {
      std::vector<int> visits(count);
      for_each_block(count, threads, [&](std::size_t begin, std::size_t end) {
        BOOST_TEST_REQUIRE(begin < end);
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      BOOST_TEST((visits == std::vector<int>(count, 1)));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_sum_is_the_same_bit_for_bit_at_any_number_of_threads) {
  for (std::size_t const count :
       {std::size_t{0}, std::size_t{3}, std::size_t{4096}, std::size_t{4097}, std::size_t{100'001}}) {
    std::vector<double> const values = some_numbers(count);
    auto const sum = [&](int threads) {
      return sum_of_rows(count, threads, 0.0, [&](std::size_t i) { return values[i]; });
    };
    double const one = sum(1);
    BOOST_TEST(one == std::accumulate(values.begin(), values.end(), 0.0), tolerance(1e-12));
    for (int const threads : {2, 3, 8}) BOOST_TEST(sum(threads) == one, tolerance(0.0));
  }
}

BOOST_AUTO_TEST_CASE(blocks_are_joined_in_their_order) {
  std::size_t const count = 50'000;
  for (int const threads : {1, 4}) {
    auto const all = joined_blocks(
        count, threads, std::vector<std::size_t>(),
        [](std::size_t begin, std::size_t end) {
          std::vector<std::size_t> part(end - begin);
          std::iota(part.begin(), part.end(), begin);
          return part;
        },
        [](std::vector<std::size_t>& joined, std::vector<std::size_t> const& part) {
          joined.insert(joined.end(), part.begin(), part.end());
        });
    BOOST_TEST(all.size() == count);
    BOOST_TEST(std::is_sorted(all.begin(), all.end()));
  }
}

BOOST_AUTO_TEST_CASE(the_first_row_of_several_is_found) {
  for (int const threads : {1, 2, 8}) {
    auto const first = [&](std::size_t a, std::size_t b) {
      return first_row(30'000, threads, [&](std::size_t i) { return i == a || i == b; });
    };
    BOOST_TEST(first(29'999, 5'000).value() == 5'000u);
    BOOST_TEST(first(4'096, 4'095).value() == 4'095u);
    BOOST_TEST(!first(30'000, 30'001).has_value());
  }
  BOOST_TEST(!first_row(0, 2, [](std::size_t) { return true; }).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
