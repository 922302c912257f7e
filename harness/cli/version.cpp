// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "formulations/simd/instruction_set.hpp"
#include "harness/cli/commands.hpp"
#include "harness/codes/hdf5.hpp"
#include "harness/study/context.hpp"
#include "reports/html/report.hpp"

namespace sphverify {

namespace {

/// In their order in a build: every machine has the first.
std::string instruction_sets() {
  if (!architecture_may_have_avx2) return "baseline";
  return fmt::format("baseline, avx2; this processor takes {}", processor_has_avx2() ? "avx2" : "baseline");
}

}  // namespace

std::string version_text() {
  Context const build = build_context();
  std::string const ours = fmt::format("sphverify {} ({})", build.version, build.commit);
  std::string const name =
      build.program == "sphverify" ? ours : fmt::format("{}, made with {}", build.program, ours);
  auto const yes_or_no = [](bool yes) { return yes ? "yes" : "no"; };
  return fmt::format(
      "{}\n"
      "compiler: {}\n"
      "build type: {}; flags:{}{}\n"
      "instruction sets: {}\n"
      "HDF5 snapshots: {}\n"
      "page of report: {}\n"
      "Licence GPL-3.0-or-later: free software, which you may change and pass on.\n"
      "There is NO WARRANTY, to the extent that the law permits.",
      name, build.compiler, build_type(), build.flags.starts_with(' ') ? "" : " ", build.flags,
      instruction_sets(), yes_or_no(can_read_hdf5()), yes_or_no(can_write_page()));
}

}  // namespace sphverify
