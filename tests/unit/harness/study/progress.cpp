// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/progress.hpp"

#include <boost/test/unit_test.hpp>

using namespace sphverify;

BOOST_AUTO_TEST_SUITE(harness_study_progress)

BOOST_AUTO_TEST_CASE(a_log_is_told_soon_and_then_ever_more_rarely) {
  BOOST_TEST(seconds_between_lines(0.0) == 5.0);
  BOOST_TEST(seconds_between_lines(60.0) == 5.0);
  BOOST_TEST(seconds_between_lines(3600.0) == 180.0);
  BOOST_TEST(seconds_between_lines(86400.0) == 600.0);
}

// A line per run of a study of a day would be a log that nobody reads.
BOOST_AUTO_TEST_CASE(a_day_is_some_hundred_lines) {
  int lines = 0;
  for (double seconds = 0.0; seconds < 86400.0; seconds += seconds_between_lines(seconds)) ++lines;
  BOOST_TEST(lines > 100);
  BOOST_TEST(lines < 300);
}

BOOST_AUTO_TEST_SUITE_END()
