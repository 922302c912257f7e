// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/listed_identifiers.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_listed_identifiers)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(the_nearest_three_are_named_the_very_nearest_first) {
  std::vector<std::string> const known{"a/bear", "a/beard", "a/beat", "a/boat", "a/crocodile"};
  BOOST_TEST(one_listed_by("list", "a/bear", known) ==
             "one of `list` (did you mean 'a/bear'? or a/beard, a/beat)");
  BOOST_TEST(one_listed_by("list", "a/crocodil", known) == "one of `list` (did you mean 'a/crocodile'?)");
}

BOOST_AUTO_TEST_CASE(where_nothing_is_near_only_the_list_is_named) {
  BOOST_TEST(one_listed_by("list", "something else", {"a/bear", "a/beat"}) == "one of `list`");
  BOOST_TEST(one_listed_by("list", "", {"a/bear"}) == "one of `list`");
}

BOOST_AUTO_TEST_SUITE_END()
