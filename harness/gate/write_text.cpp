// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/gate/text.hpp"
#include "harness/gate/write_verdicts.hpp"

namespace sphverify {

namespace {

constexpr std::size_t usual_name = 32;
constexpr std::size_t narrowest_name = 12;

char const* colour_of(Verdict verdict) {
  if (verdict == Verdict::passed) return "\x1b[32m";
  return holds(verdict) ? "\x1b[33m" : "\x1b[1;31m";
}

}  // namespace

std::string verdicts_summary(std::vector<GateVerdict> const& verdicts) {
  std::vector<std::string> parts;
  for (Verdict const verdict :
       {Verdict::passed, Verdict::within_noise, Verdict::expected_failure, Verdict::failed,
        Verdict::undecided, Verdict::unexpected_pass, Verdict::selects_nothing}) {
    auto const count = std::count_if(verdicts.begin(), verdicts.end(),
                                     [&](GateVerdict const& one) { return one.verdict == verdict; });
    if (count > 0) parts.push_back(fmt::format("{} {}", count, word(verdict)));
  }
  return fmt::format("{} gate{}: {}", verdicts.size(), verdicts.size() == 1 ? "" : "s",
                     fmt::join(parts, ", "));
}

std::vector<std::string> remarks(GateVerdict const& verdict) {
  std::vector<std::string> all;
  if (verdict.verdict == Verdict::passed) return all;
  if (verdict.verdict == Verdict::unexpected_pass)
    all.emplace_back("it holds now: remove \"expect\": \"fail\" from the gate");
  if (!verdict.reason.empty()) all.push_back("expected to fail: " + without_control(verdict.reason));
  if (!verdict.detail.empty()) all.push_back(without_control(verdict.detail));
  if (!verdict.where.empty()) {
    std::string const count =
        verdict.failing > 0 ? fmt::format("{} of {} fail, the worst", verdict.failing, verdict.looked_at)
                            : fmt::format("the nearest of {}", verdict.looked_at);
    all.push_back((verdict.looked_at > 1 ? count : std::string("on")) + ": " +
                  without_control(verdict.where));
  }
  return all;
}

std::string verdicts_text(std::vector<GateVerdict> const& verdicts, bool colour, std::size_t columns) {
  auto const numbers = [](GateVerdict const& one) { return one.measured + "  " + one.limit; };
  std::size_t longest_name = 0;
  std::size_t longest_numbers = 0;
  std::size_t verdict_width = 0;
  for (GateVerdict const& one : verdicts) {
    longest_name = std::max(longest_name, width_of(one.name));
    longest_numbers = std::max(longest_numbers, width_of(numbers(one)));
    verdict_width = std::max(verdict_width, word(one.verdict).size());
  }
  // A name gives way where a line would be too long; it stands in full below if the gate does not hold.
  auto const room_beside = [&](std::size_t width) {
    return columns - std::min(columns, verdict_width + width + 4);
  };
  std::size_t const column = std::min(longest_name, std::max(room_beside(longest_numbers), usual_name));
  std::string text;
  for (GateVerdict const& one : verdicts) {
    std::size_t const room = std::max(room_beside(width_of(numbers(one))), narrowest_name);
    std::string const verdict = fitted(std::string(word(one.verdict)), verdict_width);
    text += colour ? colour_of(one.verdict) + verdict + "\x1b[0m" : verdict;
    text += fmt::format("  {}  {}\n", fitted(one.name, std::min(column, room)), numbers(one));
  }
  for (GateVerdict const& one : verdicts) {
    auto const lines = remarks(one);
    if (lines.empty()) continue;
    text += fmt::format("\n{}: {}\n", one.name, word(one.verdict));
    for (std::string const& line : lines) text += wrapped(line, columns);
  }
  return text + "\n" + verdicts_summary(verdicts) + "\n";
}

}  // namespace sphverify
