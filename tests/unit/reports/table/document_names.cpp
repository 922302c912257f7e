// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/document_names.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_table_document_names)

using namespace sphverify;

using Names = std::vector<std::string>;

BOOST_AUTO_TEST_CASE(a_file_s_name_will_do_where_it_is_the_only_one) {
  BOOST_TEST(document_names({"some/folder/walls.json", "/other/gas.results.json", "-"}) ==
             (Names{"walls", "gas.results", "-"}));
}

BOOST_AUTO_TEST_CASE(as_many_folders_are_named_as_tell_files_apart) {
  BOOST_TEST(document_names({"old/r.json", "new/r.json", "x.json"}) == (Names{"old/r", "new/r", "x"}));
  BOOST_TEST(document_names({"a/b/r.json", "c/b/r.json"}) == (Names{"a/b/r", "c/b/r"}));
  BOOST_TEST(document_names({"r.json", "new/r.json"}) == (Names{"r", "new/r"}));
}

BOOST_AUTO_TEST_CASE(a_file_given_twice_is_numbered) {
  BOOST_TEST(document_names({"r.json", "r.json", "r.json"}) == (Names{"r", "r (2)", "r (3)"}));
}

BOOST_AUTO_TEST_SUITE_END()
