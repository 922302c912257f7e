// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/shell/candidates.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

namespace sphverify {

namespace {

using Kind = Candidates::Kind;

std::map<std::string, Candidates> const& known() {
  static std::map<std::string, Candidates> const all{{"FILE", {Kind::files}},
                                                     {"LIBRARY", {Kind::files, "so"}},
                                                     {"ID", {Kind::listed}},
                                                     {"CASE", {Kind::listed, "cases"}},
                                                     {"FORMULATION", {Kind::listed, "formulations"}},
                                                     {"KERNEL", {Kind::listed, "kernels"}},
                                                     {"LAYOUT", {Kind::listed, "layouts"}},
                                                     {"NAME=VALUE", {Kind::parameters}},
                                                     {"N", {}},
                                                     {"K/M", {}},
                                                     {"RUN", {}},
                                                     {"TIME", {}},
                                                     {"POINTS", {}},
                                                     {"LIMIT", {}},
                                                     {"ERROR", {}},
                                                     {"ORDER", {}},
                                                     {"RATIO", {}}};
  return all;
}

}  // namespace

Candidates candidates_of(OptionFacts const& option) {
  if (auto const words = words_of(option); !words.empty()) return {Kind::words, "", words};
  for (std::string const ending : {"json", "csv"}) {
    if (option.takes.ends_with("." + ending)) return {Kind::files, ending};
  }
  auto const found = known().find(option.takes);
  if (found == known().end())
    throw std::logic_error(fmt::format(
        "{} takes {}: name what it takes with type_name, and say in harness/cli/shell/candidates.cpp "
        "how a shell completes that",
        option.names.front(), option.takes));
  return found->second;
}

}  // namespace sphverify
