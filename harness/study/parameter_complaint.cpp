// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/parameter_complaint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sphverify {

std::string parameter_of(BadValue const& error, CaseInfo const& info) {
  // A case that is asked for its time is asked until its end.
  std::string const name =
      error.quantity == "time" ? "final_time" : error.quantity.substr(0, error.quantity.find('['));
  bool const is_known = std::any_of(info.parameters.begin(), info.parameters.end(),
                                    [&](ParameterSpec const& spec) { return spec.name == name; });
  return is_known ? name : "";
}

UserError parameter_complaint(BadValue const& error, CaseInfo const& info, std::string const& file,
                              std::string const& prefix, Json const* given) {
  std::string const name = parameter_of(error, info);
  if (name.empty()) {
    std::string const found = fmt::format("values that make the {} {}", error.quantity, error.found);
    return {file, prefix.substr(0, prefix.size() - 1), found,
            fmt::format("{} to be {}", error.quantity, error.expected)};
  }
  std::string const place = error.quantity == "time" ? name : error.quantity;
  std::string found = error.found;
  if (found.empty()) {
    bool const is_there = given != nullptr && given->contains(name);
    found = is_there ? Node(given->at(name), file).describe() : "a value";
  }
  return {file, prefix + place, found, error.expected};
}

}  // namespace sphverify
