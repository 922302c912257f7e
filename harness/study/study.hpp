// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/codes/external_code.hpp"
#include "harness/run/run.hpp"
#include "harness/study/envelope.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

struct StudyCase {
  Case const* scene_case;
  Parameters parameters;
};

/// A study document, read and checked, defaults filled in. Lists hold every value to combine.
struct Study {
  std::string name;
  std::vector<StudyCase> cases;
  std::vector<std::string> plugins;  ///< paths of the shared libraries that it takes formulations from
  std::vector<FormulationChoice> formulations;
  std::vector<std::shared_ptr<ExternalCode const>> codes;  ///< those of the formulations that are not ours
  std::vector<std::string> kernels, pair_weights, densities, face_weights, closures, integrators, smoothings, wall_motions;
  std::vector<std::optional<ViscosityChoice>> viscosities;  ///< empty: as the case needs
  std::vector<double> smoothing_ratios;
  std::vector<LayoutChoice> layouts;  ///< one entry per seed
  std::vector<double> smoothing_exponents;
  std::vector<int> resolutions;  ///< ascending
  MeasureSet measure;
  int threads = 1;
  RepeatRule repeat;
  double time_budget = 0.0;

  /// Null for a formulation of ours.
  std::shared_ptr<ExternalCode const> code_of(std::string const& formulation) const;

  std::optional<EnvelopeChoice> envelope;  ///< instead of single runs, how far each can be driven

  /// Which of its runs (of an envelope: searches) are carried out, ascending, as `expand` counts all of them.
  std::optional<std::vector<std::size_t>> runs;
};

struct MeasureWord {
  std::string_view word;
  Measure measure;
  std::string_view title;
};

/// The measures a study may ask for.
std::vector<MeasureWord> const& measure_words();

/// Reads a study document. Throws UserError.
Study read_study(Node const& document);

/// Refuses what cannot fit into memory, before hours are spent on the runs before it; who only reads what others ran needs no
/// room for it. Throws UserError.
void require_memory(Study const& study, Node const& document);

/// The study as a document that `read_study` reads back as the same.
Json to_json(Study const& study);

}  // namespace sphverify
