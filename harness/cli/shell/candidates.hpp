// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/cli/option_facts.hpp"

namespace sphverify {

/// What a shell may offer where an option's value is typed.
struct Candidates {
  enum class Kind {
    nothing,     ///< a number, a formula
    words,       ///< `words`
    files,       ///< whose names end with .`of`; all where it is empty
    listed,      ///< identifiers that `list` shows of the kind `of`; all where it is empty
    parameters,  ///< names of the parameters of the case that stands in the command
  };
  Kind kind = Kind::nothing;
  std::string of{};
  std::vector<std::string> words{};
};

/// By what the option says that it takes. Throws std::logic_error, which fails the build, where it says nothing that is
/// known here.
Candidates candidates_of(OptionFacts const& option);

}  // namespace sphverify
