// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/journal.hpp"

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <sys/resource.h>
#include <thread>

#include "reports/json/results_json.hpp"
#include "tests/support/documents.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_journal)

using namespace sphverify;
using namespace sphverify::tests;

Json const study{{"name", "one"}, {"resolution", {25, 50}}};

RunRecord record(std::string const& label) {
  RunRecord run;
  run.case_id = "conduction/slab-dirichlet";
  run.formulation.id = "conduction/brookshaw";
  run.label = label;
  run.resolution = 25;
  run.spacing = 0.04;
  run.errors["temperature"]["all"] = {{0.1, 0.2, 1.0 / 3.0}, {1.0, 1.0, 1.0}, 1e-14};
  return run;
}

BOOST_AUTO_TEST_CASE(what_was_appended_is_there_when_resumed) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  {
    Journal journal(path, study, false);
    BOOST_TEST(journal.finished().empty());
    journal.append(4, record("four"));
    journal.append(0, record("nought"));
  }
  Journal const resumed(path, study, true);
  BOOST_TEST(resumed.finished().size() == 2u);
  BOOST_TEST(resumed.finished().at(4).label == "four");
  BOOST_TEST(to_json(resumed.finished().at(0)).dump() == to_json(record("nought")).dump());
}

BOOST_AUTO_TEST_CASE(a_run_that_awaits_its_timing_is_finished_once_its_cost_is_there) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  Cost cost;
  cost.seconds = 2.0;
  cost.occasion = "here";
  cost.round_seconds = {2.0, 3.0};
  RunRecord once = record("two");
  once.cost.emplace().seconds = 9.0;  // of the measured run itself
  {
    Journal journal(path, study, false);
    journal.append(0, MeasuredRun{record("nought"), true, 0.5});
    journal.append(1, MeasuredRun{record("one"), true, 0.25});
    journal.append(2, MeasuredRun{once, true, 0.0});
    journal.append(3, record("three"));
    journal.append({{0, cost}, {2, std::nullopt}});
  }
  Journal const resumed(path, study, true);
  BOOST_TEST(resumed.finished().size() == 3u);
  BOOST_TEST((resumed.finished().at(0).cost->round_seconds == cost.round_seconds));
  BOOST_TEST(resumed.finished().at(0).cost->occasion == "here");
  BOOST_TEST(resumed.finished().at(2).cost->seconds == 9.0, "no repeat came to an end");
  BOOST_TEST_REQUIRE(resumed.awaiting().size() == 1u);
  BOOST_TEST(resumed.awaiting().at(1).record.label == "one");
  BOOST_TEST(resumed.awaiting().at(1).spent_seconds == 0.25);
  BOOST_TEST(resumed.awaiting().at(1).awaits_timing);
  // A cost of a run that is not there is no journal of ours.
  write_text(path, text_of(path) + "{\"run\": 7, \"cost\": null}\n");
  BOOST_CHECK_THROW((Journal{path, study, true}), UserError);
}

/// A file that may grow no further stands for a full disk: it, too, takes half of a line.
BOOST_AUTO_TEST_CASE(a_line_that_did_not_fit_is_taken_back_and_others_follow) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  {
    Journal journal(path, study, false);
    journal.append(0, record("nought"));
    rlimit const little{text_of(path).size() + 100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
    std::string const whole = text_of(path);
    BOOST_CHECK_THROW(journal.append(1, record("one")), std::runtime_error);
    setrlimit(RLIMIT_FSIZE, &before);
    BOOST_TEST(text_of(path) == whole);
    journal.append(2, record("two"));
  }
  Journal const resumed(path, study, true);
  BOOST_TEST(resumed.finished().size() == 2u);
  BOOST_TEST(resumed.finished().at(2).label == "two");
}

BOOST_AUTO_TEST_CASE(a_resumed_journal_goes_on) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  for (std::size_t index = 0; index < 4; ++index) {
    Journal journal(path, study, true);
    BOOST_TEST(journal.finished().size() == index);
    journal.append(index, record(std::to_string(index)));
  }
  BOOST_TEST(Journal(path, study, true).finished().at(2).label == "2");
}

BOOST_AUTO_TEST_CASE(a_line_cut_short_anywhere_is_dropped_and_the_journal_is_whole_again) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  {
    Journal journal(path, study, false);
    journal.append(0, record("first"));
    journal.append(1, record("second"));
  }
  std::string const whole = text_of(path);
  std::size_t const header = whole.find('\n') + 1;
  std::size_t const first = whole.find('\n', header) + 1;
  for (std::size_t cut = 0; cut < whole.size(); cut += cut + 40 < whole.size() ? 23 : 1) {
    write_text(path, whole.substr(0, cut));
    std::size_t const expected = cut < first ? 0 : 1;
    {
      Journal journal(path, study, true);
      BOOST_TEST_REQUIRE(journal.finished().size() == expected);
      journal.append(7, record("after"));
    }
    Journal const again(path, study, true);
    BOOST_TEST_REQUIRE(again.finished().size() == expected + 1);
    BOOST_TEST_REQUIRE(again.finished().at(7).label == "after");
  }
}

BOOST_AUTO_TEST_CASE(the_journal_of_another_study_is_refused_and_left_alone) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  { Journal(path, study, false).append(0, record("kept")); }
  std::string const before = text_of(path);
  Json const other{{"name", "two"}};
  std::string const said = complaint([&] { Journal(path, other, true); });
  BOOST_TEST(said.find(path) != std::string::npos, said);
  BOOST_TEST(said.find("another study") != std::string::npos, said);
  BOOST_TEST(text_of(path) == before);
}

BOOST_AUTO_TEST_CASE(a_file_that_is_no_journal_is_refused_and_left_alone) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  for (std::string const text : {"my notes\n", "[]\n", "{\"schema\": \"sphverify-results/1\"}\n"}) {
    write_text(path, text);
    BOOST_CHECK_THROW((Journal{path, study, true}), UserError);
    BOOST_TEST(text_of(path) == text);
  }
}

BOOST_AUTO_TEST_CASE(a_damaged_line_in_the_middle_is_refused) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  {
    Journal journal(path, study, false);
    journal.append(0, record("first"));
  }
  write_text(path, text_of(path) + "{\"run\": 1, \"rec\n");
  BOOST_CHECK_THROW((Journal{path, study, true}), UserError);
  std::string damaged = text_of(path);
  damaged.resize(damaged.find('\n') + 1);
  write_text(path, damaged + "{\"run\": -1, \"record\": {}}\n");
  BOOST_CHECK_THROW((Journal{path, study, true}), UserError);
}

BOOST_AUTO_TEST_CASE(without_resume_a_journal_starts_afresh) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  { Journal(path, study, false).append(0, record("old")); }
  {
    Journal journal(path, study, false);
    BOOST_TEST(journal.finished().empty());
    journal.append(1, record("new"));
  }
  Journal const resumed(path, study, true);
  BOOST_TEST(resumed.finished().size() == 1u);
  BOOST_TEST(resumed.finished().at(1).label == "new");
  Journal const kept(path + ".old", study, true);
  BOOST_TEST(kept.finished().size() == 1u);
  BOOST_TEST(kept.finished().at(0).label == "old");
}

BOOST_AUTO_TEST_CASE(two_studies_cannot_share_a_journal_at_the_same_time) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  Journal journal(path, study, false);
  for (bool const resume : {true, false}) BOOST_CHECK_THROW((Journal{path, study, resume}), UserError);
  journal.append(0, record("undisturbed"));
  BOOST_TEST(text_of(path).find("undisturbed") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(resuming_without_a_journal_starts_afresh) {
  TemporaryFolder const folder;
  Journal journal(folder.file("j"), study, true);
  BOOST_TEST(journal.finished().empty());
  journal.append(0, record("first"));
  journal.remove();
  BOOST_TEST(!std::filesystem::exists(folder.file("j")));
}

BOOST_AUTO_TEST_CASE(several_threads_append_whole_lines) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  {
    Journal journal(path, study, false);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
      threads.emplace_back([&journal, t] {
        for (std::size_t k = 0; k < 50; ++k) journal.append(100 * t + k, record("run"));
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  BOOST_TEST(Journal(path, study, true).finished().size() == 200u);
}

// A number that does not exist is null in the journal as anywhere; it must not end the study.
BOOST_AUTO_TEST_CASE(a_run_with_a_number_that_does_not_exist_can_be_resumed) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  RunRecord run = record("odd");
  run.errors["flux"]["all"].error.linf = std::numeric_limits<double>::quiet_NaN();
  { Journal(path, study, false).append(0, run); }
  BOOST_CHECK_NO_THROW((Journal{path, study, true}));
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_the_user_s_error) {
  BOOST_CHECK_THROW((Journal{"/no/such/folder/j", study, false}), UserError);
}

BOOST_AUTO_TEST_SUITE_END()
