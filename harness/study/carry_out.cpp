// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/carry_out.hpp"

#include "harness/study/pending_runs.hpp"

namespace sphverify {

namespace {

/// Which value is tried next depends on what became of the one before.
void search(EnvelopeChoice const& choice, RunSpec const& spec, std::size_t place, RunOptions const& options,
            RunsTold const& told) {
  find_envelope(spec, choice, [&](RunSpec const& one, int step) {
    std::size_t const at = place + static_cast<std::size_t>(step);
    if (auto const known = told.known(at, one)) return *known;
    if (options.interrupted && *options.interrupted) throw Interrupted();
    told.started(at);
    RunRecord record = execute(one, options);
    told.finished(at, record);
    return record;
  });
}

}  // namespace

void carry_out(Study const& study, std::vector<RunSpec> const& specs, StudyUnit const& unit, RunOptions const& options,
               RunsTold const& told) {
  if (study.envelope) {
    for (std::size_t const k : unit.runs) search(*study.envelope, specs[k], journal_place(study, k), options, told);
    return;
  }
  std::vector<RunSpec> own;
  for (std::size_t const k : unit.runs) own.push_back(specs[k]);
  PendingRuns pending(own, options, nullptr);
  for (std::size_t n = 0; n < own.size(); ++n) pending.add(n);
  for (std::size_t n = 0; n < own.size(); ++n) {
    told.started(unit.runs[n]);
    for (auto& [index, run] : pending.carry_out(n)) told.finished(unit.runs[index], std::move(run.record));
  }
}

}  // namespace sphverify
