// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "harness/study/parts.hpp"
#include "harness/study/study.hpp"
#include "reports/results.hpp"
#include "reports/write_results.hpp"

namespace sphverify {

struct StudyOptions {
  std::string document = "study";  ///< name of the study's file, for what is said of it
  std::string output = "-";        ///< where the results go
  ResultsFormat format = ResultsFormat::json;
  int jobs = 0;                    ///< runs at a time; 0: as many as cores allow
  bool resume = false;
  std::optional<Part> part;        ///< of its runs; empty: all
  std::atomic<bool> const* interrupted = nullptr;
};

/// Runs every combination of a study, several at a time but never more than there are cores, so that a timed
/// run has a core to itself, and writes the results document: of a part (or of a study that names some of its runs)
/// without series, for `merge`. Beside it a journal keeps every finished run
/// until then. Throws UserError (if nothing makes sense, after the document that says why is written), and
/// Interrupted when asked to stop (the journal then holds what is finished).
void run_study(Study study, StudyOptions const& options);

}  // namespace sphverify
