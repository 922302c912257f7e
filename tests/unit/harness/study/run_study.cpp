// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/run_study.hpp"

#include <boost/test/unit_test.hpp>

#include "harness/study/journal.hpp"
#include "reports/json/results_json.hpp"
#include "tests/support/documents.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_run_study)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

Study small_study() {
  static Json const document = Json::parse(R"({"schema": "sphverify-study/1", "name": "small",
    "cases": ["conduction/slab-dirichlet", "operator/sine"],
    "formulations": ["conduction/brookshaw", {"id": "conduction/campbell-flux", "walls": "off"},
                     "momentum/p-rho2"],
    "discretisation": {"layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}]},
    "resolution": [8, 16, 32], "measure": ["error", "conservation", "stability"]})");
  return read_study(Node(document, "study.json"));
}

std::size_t constexpr small_runs = 3u * 3u * (2u + 3u);

/// What must be the same from run to run: everything but timings and the date.
std::string reproducible(std::string const& path) {
  Json document = read_json_file(path);
  document.erase("context");
  for (Json& run : document.at("runs")) run.erase("cost");
  for (Json& series : document.at("series")) {
    series.erase("time_to_error");
    for (Json& entry : series.at("orders")) {
      for (Json& level : entry.at("levels")) {
        for (char const* time : {"seconds", "median_seconds", "low_seconds", "high_seconds"})
          level.erase(time);
      }
    }
  }
  return document.dump();
}

StudyOptions to(std::string const& output) {
  StudyOptions options;
  options.output = output;
  return options;
}

BOOST_AUTO_TEST_CASE(a_study_leaves_its_results_and_no_journal) {
  TemporaryFolder const folder;
  std::string const output = folder.file("results.json");
  run_study(small_study(), to(output));
  BOOST_TEST(!std::filesystem::exists(output + ".journal"));
  Results const results = read_results(output);
  BOOST_TEST(results.runs.size() == small_runs);
  BOOST_TEST(results.series.size() == 2u * 5u);  // two layouts each
  BOOST_TEST(results.skipped.size() == 1u);
  for (RunRecord const& run : results.runs) BOOST_TEST(run.status == "ok", run.reason);
  for (Series const& series : results.series) {
    BOOST_TEST(series.runs.size() == (series.discretisation.layout.id == "jittered" ? 6u : 3u));
    BOOST_TEST(!series.orders.empty());
    for (std::size_t const index : series.runs) BOOST_TEST(results.runs[index].label == series.label);
  }
  std::size_t files = 0;
  for ([[maybe_unused]] auto const& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  BOOST_TEST(files == 1u);
}

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_how_many_runs_go_at_a_time) {
  TemporaryFolder const folder;
  StudyOptions options = to(folder.file("one.json"));
  options.jobs = 1;
  run_study(small_study(), options);
  run_study(small_study(), to(folder.file("many.json")));
  BOOST_TEST(reproducible(folder.file("one.json")) == reproducible(folder.file("many.json")));
}

BOOST_AUTO_TEST_CASE(an_interrupted_study_goes_on_where_it_was_and_ends_the_same) {
  TemporaryFolder const folder;
  std::string const whole = folder.file("whole.json");
  run_study(small_study(), to(whole));

  // A journal as a kill leaves it: some runs, out of order, the last line cut short. One of them is marked,
  // to see that it is taken over and not run again.
  Results const results = read_results(whole);
  std::string const output = folder.file("resumed.json");
  {
    Journal journal(output + ".journal", to_json(small_study()), false);
    RunRecord marked = results.runs[12];
    marked.label = "taken over";
    journal.append(12, marked);
    journal.append(3, results.runs[3]);
    journal.append(7, results.runs[7]);
  }
  std::string const text = text_of(output + ".journal");
  write_text(output + ".journal", text.substr(0, text.size() - 30));
  StudyOptions options = to(output);
  options.resume = true;
  run_study(small_study(), options);
  Results resumed = read_results(output);
  BOOST_TEST(resumed.runs[12].label == "taken over");
  BOOST_TEST(!std::filesystem::exists(output + ".journal"));

  std::string unmarked = text_of(output);  // the run, and the series that it opens
  for (std::size_t at; (at = unmarked.find("taken over")) != std::string::npos;)
    unmarked.replace(at, 10, results.runs[12].label);
  write_text(output, unmarked);
  BOOST_TEST(reproducible(output) == reproducible(whole));
}

BOOST_AUTO_TEST_CASE(without_resume_the_journal_of_before_is_not_taken_over) {
  TemporaryFolder const folder;
  std::string const output = folder.file("results.json");
  {
    Journal journal(output + ".journal", to_json(small_study()), false);
    RunRecord stale;
    stale.label = "stale";
    journal.append(0, stale);
  }
  run_study(small_study(), to(output));
  BOOST_TEST(read_results(output).runs[0].label == "conduction/brookshaw");
}

BOOST_AUTO_TEST_CASE(an_interrupt_leaves_a_journal_and_no_results) {
  TemporaryFolder const folder;
  std::atomic<bool> const interrupted{true};
  StudyOptions options = to(folder.file("results.json"));
  options.interrupted = &interrupted;
  BOOST_CHECK_THROW(run_study(small_study(), options), Interrupted);
  BOOST_TEST(!std::filesystem::exists(options.output));
  BOOST_TEST(std::filesystem::exists(options.output + ".journal"));
  options.interrupted = nullptr;
  options.resume = true;
  run_study(small_study(), options);
  BOOST_TEST(read_results(options.output).runs.size() == small_runs);
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_refused_before_anything_runs) {
  BOOST_CHECK_THROW(run_study(small_study(), to("/no/such/folder/results.json")), UserError);
  StudyOptions options;
  options.resume = true;
  BOOST_CHECK_THROW(run_study(small_study(), options), UserError);
}

BOOST_AUTO_TEST_CASE(the_document_holds_the_study_with_its_defaults) {
  TemporaryFolder const folder;
  std::string const output = folder.file("results.json");
  run_study(small_study(), to(output));
  Json const study = read_json_file(output).at("study");
  BOOST_TEST(study.dump() == to_json(small_study()).dump());
}

BOOST_AUTO_TEST_SUITE_END()
