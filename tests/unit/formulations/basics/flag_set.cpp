// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/flag_set.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(formulations_basics_flag_set)

enum class Colour { red, green, blue };
using Colours = sphverify::FlagSet<Colour>;

static_assert(Colours{Colour::red, Colour::blue}.contains(Colour::blue), "usable in constant expressions");

BOOST_AUTO_TEST_CASE(contains_what_was_put_in_and_nothing_else) {
  Colours set{Colour::red};
  BOOST_TEST(set.contains(Colour::red));
  BOOST_TEST(!set.contains(Colour::green));
  set.insert(Colour::blue);
  BOOST_TEST(set.contains(Colour::blue));
  BOOST_TEST(!set.contains(Colour::green));
}

BOOST_AUTO_TEST_CASE(subset_union_equality_and_emptiness) {
  Colours const warm{Colour::red};
  Colours const both{Colour::red, Colour::blue};
  BOOST_TEST(both.contains(warm));
  BOOST_TEST(!warm.contains(both));
  BOOST_TEST(warm.contains(Colours{}));
  BOOST_TEST(((warm | Colours{Colour::blue}) == both));
  BOOST_TEST(Colours{}.empty());
  BOOST_TEST(!warm.empty());
}

BOOST_AUTO_TEST_SUITE_END()
