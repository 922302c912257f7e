// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/say.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <map>

#include "reports/printable.hpp"

namespace sphverify {

namespace {

struct Reason {
  std::string example;
  std::size_t runs = 0;
};

/// By what they have in common.
using Reasons = std::map<std::string, Reason>;

void say_outcomes(std::vector<RunRecord> const& runs) {
  std::map<std::string, std::size_t> outcomes;
  for (RunRecord const& run : runs) ++outcomes[run.status];
  if (outcomes["ok"] == runs.size()) return;
  std::vector<std::string> counts;
  for (auto const& [status, count] : outcomes) counts.push_back(fmt::format("{} {}", count, status));
  fmt::print(stderr, "of {} runs {}\n", runs.size(), fmt::join(counts, ", "));
}

void say(char const* what, Reasons const& reasons, std::size_t runs) {
  constexpr std::size_t most = 10;
  std::size_t said = 0;
  for (auto const& [common, reason] : reasons) {
    if (++said > most) {
      fmt::print(stderr, "{}: and {} more reasons\n", what, reasons.size() - most);
      break;
    }
    fmt::print(stderr, "{}: {} of {} runs: {}\n", what, reason.runs, runs, reason.example);
  }
}

void note(Reasons& reasons, std::string const& common, std::string const& example) {
  Reason& reason = reasons[common];
  if (reason.runs++ == 0) reason.example = example;
}

}  // namespace

void say_how_it_went(std::vector<RunRecord> const& runs) {
  Reasons invalid, crashed, failed, remarks, time_errors;
  for (RunRecord const& run : runs) {
    if (run.status == "invalid") note(invalid, run.reason, run.reason);
    if (run.status == "crashed") note(crashed, run.label, run.label + ": " + run.reason);
    if (run.status == "failed") note(failed, run.label, run.label + ": " + printable(run.reason));
    // What stands before a colon is the same where numbers differ.
    for (std::string const& remark : run.remarks) note(remarks, remark.substr(0, remark.find(':')), remark);
    bool const should_be_known = run.status == "ok" && !run.errors.empty() && run.integration.has_value();
    if (should_be_known && !run.integration->time_error_share)
      note(time_errors, run.integration->remark, run.integration->remark);
  }
  say_outcomes(runs);
  say("invalid", invalid, runs.size());
  say("crashed", crashed, runs.size());
  say("failed", failed, runs.size());
  say("remark", remarks, runs.size());
  say("time error not known", time_errors, runs.size());
}

std::string why_nothing_ran(std::vector<Skipped> const& skipped) {
  if (skipped.empty()) return "no combination";
  Skipped const& first = skipped.front();
  std::string const why = fmt::format("{} on {}: {}", first.formulation, first.case_id, first.reason);
  if (skipped.size() == 1) return fmt::format("nothing to run: its one combination is skipped ({})", why);
  return fmt::format("nothing to run: all of its {} combinations are skipped (the first: {})", skipped.size(),
                     why);
}

}  // namespace sphverify
