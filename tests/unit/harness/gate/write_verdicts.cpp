// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/write_verdicts.hpp"

#include <boost/test/unit_test.hpp>
#include <sstream>

#include "harness/gate/text.hpp"
#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_write_verdicts)

using namespace sphverify;
using namespace sphverify::tests;

GateVerdict verdict(Verdict what, std::string const& name) {
  GateVerdict one;
  one.name = name;
  one.verdict = what;
  one.measured = "l2 error 0.5 K";
  one.limit = "<= 1";
  one.where = "conduction/slab-dirichlet, N = 25";
  one.looked_at = 3;
  one.failing = what == Verdict::passed || what == Verdict::unexpected_pass ? 0 : 2;
  if (what == Verdict::expected_failure || what == Verdict::unexpected_pass) one.reason = "known";
  if (what == Verdict::failed) one.detail = "unstable: a < b & \"c\"\x01\nnext";
  return one;
}

std::vector<GateVerdict> const& all() {
  static std::vector<GateVerdict> const verdicts{
      verdict(Verdict::passed, "first"),          verdict(Verdict::failed, "second, 100%: <b> | \"x\" & 'y'"),
      verdict(Verdict::undecided, "third"),       verdict(Verdict::expected_failure, "fourth"),
      verdict(Verdict::unexpected_pass, "fifth"), verdict(Verdict::selects_nothing, "sixth")};
  return verdicts;
}

Gates const& gates() {
  static Gates const document{"dir/gates,1.json", "mine & yours", {}};
  return document;
}

std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

BOOST_AUTO_TEST_CASE(noise_holds_and_says_so_in_every_report) {
  std::vector<GateVerdict> noise{verdict(Verdict::within_noise, "ratio")};
  noise[0].failing = 0;
  noise[0].detail = "too noisy to tell";
  BOOST_TEST(verdicts_text(noise, false).starts_with("within-noise  ratio  l2 error 0.5 K  <= 1\n"));
  BOOST_TEST(says(verdicts_text(noise, false), "too noisy to tell"));
  BOOST_TEST(says(verdicts_text(noise, false), "1 gate: 1 within-noise"));
  BOOST_TEST(says(verdicts_junit(gates(), noise), "failures=\"0\""));
  BOOST_TEST(says(verdicts_junit(gates(), noise), "<system-out>"));
  BOOST_TEST(says(verdicts_junit(gates(), noise), "too noisy to tell"));
  BOOST_TEST(verdicts_annotations(gates(), noise).starts_with("::notice "));
  BOOST_TEST(says(verdicts_markdown(gates(), noise), "| within-noise |"));
}

BOOST_AUTO_TEST_CASE(one_line_per_gate_comes_first_and_the_summary_last) {
  auto const lines = lines_of(verdicts_text(all(), false));
  BOOST_TEST(lines[0].starts_with("passed            first"), lines[0]);
  BOOST_TEST(lines[0].ends_with("  l2 error 0.5 K  <= 1"), lines[0]);
  BOOST_TEST(lines[2].starts_with("undecided         third"));
  BOOST_TEST(lines[3].starts_with("expected-failure  fourth"));
  BOOST_TEST(lines[6] == "");
  BOOST_TEST(lines.back() ==
             "6 gates: 1 passed, 1 expected-failure, 1 failed, 1 undecided, 1 unexpected-pass, "
             "1 selects-nothing");
  BOOST_TEST(verdicts_summary({verdict(Verdict::passed, "x")}) == "1 gate: 1 passed");
}

BOOST_AUTO_TEST_CASE(what_does_not_simply_pass_is_explained) {
  std::string const text = verdicts_text(all(), false);
  BOOST_TEST(says(text, "\nsecond, 100%: <b> | \"x\" & 'y': failed\n  unstable: a < b & \"c\"  next\n"),
             text);
  BOOST_TEST(says(text, "  2 of 3 fail, the worst: conduction/slab-dirichlet, N = 25\n"), text);
  BOOST_TEST(says(text, "\nfourth: expected-failure\n  expected to fail: known\n"), text);
  BOOST_TEST(says(text, "\nfifth: unexpected-pass\n  it holds now: remove \"expect\": \"fail\""), text);
  BOOST_TEST(!says(text, "first: passed"), text);
}

BOOST_AUTO_TEST_CASE(lines_stay_within_100_columns_whatever_the_names) {
  std::vector<GateVerdict> verdicts = all();
  verdicts.push_back(verdict(Verdict::expected_failure,
                             "a name in umlauts, \xc3\xa4\xc3\xb6\xc3\xbc " + std::string(80, 'x')));
  verdicts.back().where = "a b " + std::string(90, 'y') + " c";
  verdicts.push_back(verdict(Verdict::passed, std::string(90, 'z')));
  verdicts.back().measured = "rel. momentum wall_budget_defect 1.23e-05 kg m/s";
  for (std::string const& line : lines_of(verdicts_text(verdicts, false)))
    if (!line.starts_with("a name")) BOOST_TEST(width_of(line) <= widest_line, line);
}

BOOST_AUTO_TEST_CASE(a_text_is_cut_between_characters) {
  BOOST_TEST(fitted("abc", 5) == "abc  ");
  BOOST_TEST(fitted("abcdef", 5) == "abc..");
  BOOST_TEST(fitted("\xc3\xa4\xc3\xb6\xc3\xbc\xc3\x9f", 3) == "\xc3\xa4..");
  BOOST_TEST(width_of("\xc3\xa4\xc3\xb6") == 2u);
}

BOOST_AUTO_TEST_CASE(colour_is_used_only_if_asked_for) {
  BOOST_TEST(!says(verdicts_text(all(), false), "\x1b"));
  std::string const coloured = verdicts_text(all(), true);
  BOOST_TEST(says(coloured, "\x1b[32mpassed"));
  BOOST_TEST(says(coloured, "\x1b[1;31mfailed"));
  BOOST_TEST(says(coloured, "\x1b[33mexpected-failure"));
}

BOOST_AUTO_TEST_CASE(junit_escapes_what_xml_cannot_hold) {
  std::string const text = verdicts_junit(gates(), all());
  BOOST_TEST(says(text, R"(tests="6" failures="4" errors="0" skipped="1")"), text);
  BOOST_TEST(says(text, R"(name="second, 100%: &lt;b&gt; | &quot;x&quot; &amp; 'y'")"), text);
  BOOST_TEST(says(text, R"(<failure type="undecided")"), text);
  BOOST_TEST(says(text, R"(<skipped message="expected failure: known"/>)"), text);
  BOOST_TEST(!says(text, "\x01"));
  // What is skipped is what was expected to fail and did, nothing else.
  std::vector<GateVerdict> some = all();
  std::erase_if(some, [](GateVerdict const& one) { return one.verdict != Verdict::expected_failure; });
  BOOST_TEST(says(verdicts_junit(gates(), some), R"(tests="1" failures="0" errors="0" skipped="1")"));
  some = all();
  std::erase_if(some, [](GateVerdict const& one) { return one.verdict != Verdict::unexpected_pass; });
  BOOST_TEST(says(verdicts_junit(gates(), some), R"(tests="1" failures="1" errors="0" skipped="0")"));
}

BOOST_AUTO_TEST_CASE(control_characters_become_blanks_and_no_others) {
  BOOST_TEST(without_control("a\x01\x1f ~\x7f\xc3\xa4") == "a   ~ \xc3\xa4");
}

BOOST_AUTO_TEST_CASE(annotations_escape_as_the_runner_decodes) {
  auto const lines = lines_of(verdicts_annotations(gates(), all()));
  BOOST_TEST_REQUIRE(lines.size() == 5u, "a pass is no news");
  BOOST_TEST(lines[0].starts_with("::error file=dir/gates%2C1.json,title=second%2C 100%25%3A <b> | \"x\" & "
                                  "'y'::failed: l2 error 0.5 K, limit <= 1%0A"),
             lines[0]);
  BOOST_TEST(lines[2].starts_with("::notice file="), lines[2]);
  BOOST_TEST(lines[3].starts_with("::error file="), lines[3]);
}

BOOST_AUTO_TEST_CASE(markdown_has_one_row_per_gate_and_its_cells_hold) {
  auto const lines = lines_of(verdicts_markdown(gates(), all()));
  BOOST_TEST(lines[0] == "### Gates: mine &amp; yours");
  std::size_t rows = 0;
  for (std::string const& line : lines) {
    if (!line.starts_with("|")) continue;
    ++rows;
    std::size_t cells = 0;
    for (std::size_t k = 0; k < line.size(); ++k)
      cells += line[k] == '|' && (k == 0 || line[k - 1] != '\\') ? 1 : 0;
    BOOST_TEST(cells == 6u, line);
  }
  BOOST_TEST(rows == 8u);
  BOOST_TEST(lines[8].starts_with("| **undecided** | third |"), lines[8]);
}

BOOST_AUTO_TEST_CASE(what_xml_cannot_hold_is_replaced_in_junit) {
  std::string const replacement = "\xEF\xBF\xBD";
  GateVerdict one = verdict(Verdict::failed,
                            "a\xEF\xBF\xBE\xEF\xBF\xBF"
                            "b\xED\xA0\x80"
                            "c\xFF"
                            "d\x0B"
                            "e\xC3\xA4\xF0\x9F\x98\x80");
  std::string const junit = verdicts_junit(gates(), {one});
  // A half of a surrogate pair is three bytes, none of which begins a character.
  BOOST_TEST(says(junit, "name=\"a" + replacement + replacement + "b" + replacement + replacement +
                             replacement + "c" + replacement + "d e\xC3\xA4\xF0\x9F\x98\x80\""));
}

BOOST_AUTO_TEST_SUITE_END()
