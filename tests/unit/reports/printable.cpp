// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/printable.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_printable)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(plain_text_of_any_script_stays) {
  for (char const* text : {"", "conduction/brookshaw", "größe", "速度", "\U0001F600", "a 'b' \"c\" \\n"})
    BOOST_TEST(printable(text) == text);
}

BOOST_AUTO_TEST_CASE(what_moves_a_cursor_or_a_line_is_written_out) {
  BOOST_TEST(printable("a\nb\r\tc") == "a\\nb\\r\\tc");
  BOOST_TEST(printable("\x1b[31m\x7f") == "\\u001b[31m\\u007f");
  BOOST_TEST(printable(std::string_view("\0", 1)) == "\\u0000");
  BOOST_TEST(printable("\u009b\u2028\u202e\u2066") == "\\u009b\\u2028\\u202e\\u2066");
}

BOOST_AUTO_TEST_CASE(bytes_that_are_no_characters_are_written_out) {
  BOOST_TEST(printable("a\xff") == "a\\xff");
  BOOST_TEST(printable("\xc3") == "\\xc3");                    // cut
  BOOST_TEST(printable("\xc0\x9b") == "\\xc0\\x9b");           // longer than it need be
  BOOST_TEST(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");  // half a surrogate pair
  BOOST_TEST(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
}

BOOST_AUTO_TEST_SUITE_END()
