// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/ranks.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace sphverify {

namespace {

std::string text_of(char const* name) {
  char const* const text = std::getenv(name);
  return text == nullptr ? "" : text;
}

std::optional<int> number_of(char const* name) {
  std::string const text = text_of(name);
  int number = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Names of variables that a launcher sets. The innermost comes first: mpirun within a job of Slurm.
struct Launcher {
  char const* rank;
  char const* size;
  std::array<char const*, 3> job;
};
constexpr std::array<Launcher, 3> launchers{{
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", {"PMIX_NAMESPACE", "OMPI_MCA_ess_base_jobid", nullptr}},
    {"PMI_RANK", "PMI_SIZE", {"PMI_JOBID", "SLURM_JOB_ID", "SLURM_RESTART_COUNT"}},
    // Of a step that srun started: a script of sbatch has the first, too, but no tasks of a step.
    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", {"SLURM_JOB_ID", "SLURM_STEP_ID", "SLURM_RESTART_COUNT"}},
}};

}  // namespace

Rank rank_of_process() {
  if (text_of("SPHVERIFY_RANKS") == "off") return {};
  for (Launcher const& launcher : launchers) {
    auto const number = number_of(launcher.rank);
    auto const of = number_of(launcher.size);
    if (!number || !of || *number < 0 || *number >= *of) continue;
    Rank rank{*number, *of, launcher.rank};
    for (char const* name : launcher.job) {
      if (name != nullptr) rank.job += "/" + text_of(name);
    }
    return rank;
  }
  return {};
}

void fall_silent() {
  if (std::freopen("/dev/null", "w", stderr) == nullptr) std::fclose(stderr);
}

}  // namespace sphverify
