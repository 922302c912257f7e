// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/write_results.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "reports/hdf5.hpp"
#include "reports/json/results_json.hpp"
#include "tests/support/documents.hpp"
#include "tests/support/full_results.hpp"
#include "tests/support/random_json.hpp"

BOOST_AUTO_TEST_SUITE(reports_write_results, *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
  return boost::test_tools::assertion_result(sphverify::can_use_hdf5());
}))

using namespace sphverify;
using namespace sphverify::tests;

namespace {

/// Runs of all sorts, some of which are not there, whose numbers are the hardest to keep.
Results hard_results() {
  Results results = full_results();
  RunRecord failed = full_run();
  failed.profile.reset();
  failed.stability.reset();
  failed.second_law.reset();
  failed.output = "said\nmuch";
  failed.parameters["phase"] = std::string("not a number");
  RunRecord hard = full_run();
  hard.discretisation.layout = {"lattice"};
  hard.discretisation.viscosity = {};
  hard.spacing = std::numeric_limits<double>::denorm_min();
  hard.smoothing_length = std::numeric_limits<double>::max();
  hard.smoothing_exponent = -0.0;
  hard.history->energy = {std::numeric_limits<double>::quiet_NaN(), 0.1, -0.0};
  hard.profile->position = {{0.1}};
  hard.errors.erase("flux");
  results.runs.insert(results.runs.begin() + 1, {failed, hard});
  results.study = R"({"schema":"sphverify-study/1","name":"s","b":1.0,"a":[1,"x",null]})";
  results.part = {3, 1, 2, 0};
  results.shares = {{results.context, 4}};
  results.shares.front().context.machine = "m";
  results.envelopes = {Envelope{}};
  results.envelopes.front().status = "unstable";
  results.envelopes.front().points = {{1.5, "ok"}, {2.5, "unstable"}};
  return results;
}

std::string text_of(Results const& results) { return document_text(to_json(results)); }

}  // namespace

BOOST_AUTO_TEST_CASE(results_are_the_same_document_through_hdf5) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results");
  Results empty;
  empty.study = "{}";
  for (Results const& results : {full_results(), hard_results(), empty}) {
    write_results(path, results, ResultsFormat::hdf5);
    BOOST_TEST((format_of_file(path) == ResultsFormat::hdf5));
    BOOST_TEST(text_of(read_results(path)) == text_of(results));
    write_results(path, results, ResultsFormat::json);
    BOOST_TEST((format_of_file(path) == ResultsFormat::json));
    BOOST_TEST(text_of(read_results(path)) == text_of(results));
  }
}

BOOST_AUTO_TEST_CASE(the_same_results_are_the_same_bytes) {
  TemporaryFolder const folder;
  for (char const* name : {"a", "b"}) write_results(folder.file(name), hard_results(), ResultsFormat::hdf5);
  BOOST_TEST(tests::text_of(folder.file("a")) == tests::text_of(folder.file("b")));
}

BOOST_AUTO_TEST_CASE(documents_drawn_by_lot_come_back_from_hdf5_as_they_were) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    RandomJson random(seed);
    Json list = Json::array();
    for (unsigned k = 0; k < 3 + seed % 40; ++k) list.push_back(random.object());
    Json const document = {{"schema", "s"}, {"list", list}, {"one", random.object()}};
    Column column;
    column.append(document);
    Column const read = read_hdf5_file(hdf5_file(column), "f");
    BOOST_TEST((unordered(read.row(0)) == unordered(document)), "seed " << seed);
  }
}

BOOST_AUTO_TEST_CASE(large_columns_come_back_as_they_were) {
  std::mt19937_64 generator(1);
  Json list = Json::array();
  for (int k = 0; k < 600; ++k) {
    Json numbers = Json::array(), vectors = Json::array();
    for (unsigned n = generator() % 200; n > 0; --n) {
      numbers.push_back(std::ldexp(static_cast<double>(generator()), -64));
      vectors.push_back({numbers.back(), n});
    }
    list.push_back({{"numbers", numbers}, {"vectors", vectors}, {"text", std::string(generator() % 2000, 'a')}});
  }
  Column column;
  column.append({{"schema", "s"}, {"list", list}});
  Column const read = read_hdf5_file(hdf5_file(column), "f");
  BOOST_TEST((unordered(read.row(0).at("list")) == unordered(list)));
}

BOOST_AUTO_TEST_CASE(a_file_cut_short_anywhere_is_refused) {
  Column document;
  document.append(to_json(hard_results()));
  std::string const whole = hdf5_file(document);
  for (std::size_t size = 8; size < whole.size(); size += 1 + whole.size() / 200) {
    BOOST_TEST(complaint([&] { read_hdf5_file(whole.substr(0, size), "f"); }) == "f: found an HDF5 file that cannot be opened (cut short?), expected a whole one");
  }
}

BOOST_AUTO_TEST_CASE(a_damaged_file_is_refused_or_read_but_nothing_else) {
  Column document;
  document.append(to_json(hard_results()));
  std::string const whole = hdf5_file(document);
  std::mt19937 generator(1);
  std::size_t refused = 0;
  constexpr int tries = 150;
  for (int k = 0; k < tries; ++k) {
    std::string damaged = whole;
    damaged[8 + generator() % (damaged.size() - 8)] ^= static_cast<char>(1U << generator() % 8U);
    std::string const said = complaint([&] { read_hdf5_file(damaged, "f").row(0); });
    BOOST_TEST(said.find('\n') == std::string::npos);
    refused += !said.empty();
  }
  BOOST_TEST(refused > tries / 2);  // the rest is free space
}

BOOST_AUTO_TEST_CASE(a_column_of_another_length_than_its_list_is_refused) {
  Column document;
  document.append(Json::parse(R"({"schema":"s","list":[{"a":1.5,"b":2},{"a":2.5,"b":3}]})"));
  auto const said = [&](auto const& change) {
    Column changed = document;
    change(changed.members.at("list"));
    return complaint([&] { read_hdf5_file(hdf5_file(changed), "f"); });
  };
  BOOST_TEST(said([](Column&) {}) == "");
  auto const longer = [](Column& list) {
    Column& a = list.elements.front().members.at("a");
    a.numbers.push_back(3.5);
    a.gaps.push_back(Column::there);
  };
  BOOST_TEST(said(longer) == "f: list/a: found 3 entries, expected 2, one for each row");
  BOOST_TEST(said([](Column& list) { list.starts = {0, 9000}; }) == "f: list/a: found 2 entries, expected 9000, one for each row");
  BOOST_TEST(said([](Column& list) { list.starts = {1, 2}; }) ==
             "f: list@starts: found something else, expected where each list begins, from 0 on, and where the last ends");
  BOOST_TEST(said([](Column& list) { list.starts = {0, 1'000'000'000'000}; }).starts_with("f: list: found 1000000000000 rows, expected"));
}

BOOST_AUTO_TEST_CASE(results_whose_values_are_wrong_are_refused_where_they_stand) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.h5");
  Json document = to_json(full_results());
  auto const said = [&] {
    Column column;
    column.append(document);
    write_document(path, hdf5_file(column));
    return complaint([&] { read_results(path); });
  };
  document["runs"][1]["status"] = "fine";
  BOOST_TEST(said().starts_with(path + ": runs[1].status: found 'fine', expected one of "));
  document = to_json(full_results());
  document.erase("skipped");
  BOOST_TEST(said() == path + ": skipped: found nothing, expected this key");
  document["skipped"] = 3;
  BOOST_TEST(said() == path + ": skipped: found 3, expected a list");
  document["schema"] = "sphverify-gates/1";
  BOOST_TEST(said() == path + ": schema: found 'sphverify-gates/1', expected sphverify-results/1");
}

BOOST_AUTO_TEST_SUITE_END()
