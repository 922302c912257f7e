// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

// What a source with generated mutants is compiled with (docs/generated-mutants.md): whether the process runs one of them. Chosen by
// SPHVERIFY_MUTANT before any constructor runs; const here so that loops need not read it again.
extern "C" int const sphverify_mutant;
extern "C" bool sphverify_mutant_reached(int number);

namespace mutation {

/// Whether this mutant runs. With SPHVERIFY_MUTANT=record:FILE none does, and the file tells which were asked for.
[[gnu::always_inline]] inline bool on(int number) {
  return sphverify_mutant == number || (sphverify_mutant < 0 && sphverify_mutant_reached(number));
}

/// The same where the compiler may have to evaluate it: never there.
[[gnu::always_inline]] constexpr bool on_or_constant(int number) {
  return !std::is_constant_evaluated() && on(number);
}

/// A neighbour of an index, which is one as well unless there is but one.
template <typename Index>
constexpr Index beside(Index index) {
  return index == Index{0} ? Index{1} : static_cast<Index>(index - Index{1});
}

}  // namespace mutation
