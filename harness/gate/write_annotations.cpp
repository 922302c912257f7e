// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/gate/write_verdicts.hpp"

namespace sphverify {

namespace {

/// As GitHub's runner decodes the text of a workflow command; in its properties ':' and ',' end a value.
std::string escaped(std::string const& text, bool property) {
  std::string all;
  for (char const c : text) {
    if (c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','))) {
      all += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      all += c;
    }
  }
  return all;
}

}  // namespace

std::string verdicts_annotations(Gates const& gates, std::vector<GateVerdict> const& verdicts) {
  std::string text;
  for (GateVerdict const& one : verdicts) {
    if (one.verdict == Verdict::passed) continue;
    std::string const said = fmt::format("{}: {}, limit {}\n{}", word(one.verdict), one.measured, one.limit,
                                         fmt::join(remarks(one), "\n"));
    text += fmt::format("::{} file={},title={}::{}\n", holds(one.verdict) ? "notice" : "error",
                        escaped(gates.file, true), escaped(one.name, true), escaped(said, false));
  }
  return text;
}

}  // namespace sphverify
