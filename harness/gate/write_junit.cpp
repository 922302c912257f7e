// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/gate/write_verdicts.hpp"
#include "reports/printable.hpp"

namespace sphverify {

namespace {

/// For text and attributes of XML 1.0, which cannot hold most control characters at all, nor U+FFFE, U+FFFF
/// and bytes that are not UTF-8.
std::string xml(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    std::size_t const size = std::max<std::size_t>(1, utf8_size(text));
    std::string_view const character = text.substr(0, size);
    char const c = text.front();
    text.remove_prefix(size);
    if (character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF" || utf8_size(character) == 0) {
      escaped += "\xEF\xBF\xBD";  // U+FFFD, which stands for what cannot be shown
    } else if (size > 1) {
      escaped += character;
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\n') {
      escaped += "&#10;";
    } else {
      escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

std::string outcome(GateVerdict const& one) {
  std::string const numbers = fmt::format("{}, limit {}", one.measured, one.limit);
  std::string const text = fmt::format("{}\n{}", numbers, fmt::join(remarks(one), "\n"));
  if (one.verdict == Verdict::passed)
    return fmt::format("<system-out>{}</system-out>", xml(numbers + "\n" + one.where));
  if (one.verdict == Verdict::within_noise) return fmt::format("<system-out>{}</system-out>", xml(text));
  if (one.verdict == Verdict::expected_failure) {
    return fmt::format(R"(<skipped message="{}"/><system-out>{}</system-out>)",
                       xml("expected failure: " + one.reason), xml(text));
  }
  return fmt::format(R"(<failure type="{}" message="{}">{}</failure>)", word(one.verdict),
                     xml(fmt::format("{}: {}", word(one.verdict), numbers)), xml(text));
}

}  // namespace

std::string verdicts_junit(Gates const& gates, std::vector<GateVerdict> const& verdicts) {
  auto const failures = std::count_if(verdicts.begin(), verdicts.end(),
                                      [](GateVerdict const& one) { return !holds(one.verdict); });
  auto const skipped = std::count_if(verdicts.begin(), verdicts.end(), [](GateVerdict const& one) {
    return one.verdict == Verdict::expected_failure;
  });
  std::string const counts = fmt::format(R"(tests="{}" failures="{}" errors="0" skipped="{}" time="0")",
                                         verdicts.size(), failures, skipped);
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"sphverify\" {}>\n"
      " <testsuite name=\"{}\" {}>\n",
      counts, xml(gates.name), counts);
  for (GateVerdict const& one : verdicts) {
    text += fmt::format("  <testcase classname=\"sphverify.{}\" name=\"{}\" time=\"0\">{}</testcase>\n",
                        xml(gates.name), xml(one.name), outcome(one));
  }
  return text + " </testsuite>\n</testsuites>\n";
}

}  // namespace sphverify
