// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/assess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "harness/codes/assess_snapshot.hpp"
#include "harness/codes/external_code.hpp"
#include "harness/codes/read_snapshot.hpp"
#include "harness/measure/series.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/context.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/read_case.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

constexpr double same_time = 1e-5;  // relative: files may hold single precision

/// One entry of the document.
struct NamedSnapshot {
  Node node;
  std::vector<std::string> files{};
  int resolution = 0;
  std::uint64_t seed = 0;
  Number time{}, seconds{};
};

/// What the runs of one document have in common.
struct Whole {
  StudyCase chosen;
  Discretisation discretisation;
  SnapshotOptions options;
  MeasureSet measure;
  std::string label;
};

/// The choices beside which a code is shown: those of a study of ours that says as much, each a single value.
Discretisation read_choices(Node const& document, StudyCase const& chosen, std::string const& label) {
  Json choices = Json::object();
  if (auto const node = document.find("discretisation")) {
    choices = node->json();
    if (auto const layout = node->find("layout")) {
      // Seeds stand beside the snapshots.
      Json& one = choices["layout"];
      if (one.is_object() && (one.contains("seed") || one.contains("seeds")))
        layout->complain("a layout without its seed, which stands beside each snapshot");
      Json const named = one.is_object() && one.contains("id") ? one.at("id") : one;
      std::string const id = named.is_string() ? named.get<std::string>() : "";
      bool const bare = id == "glass" || id == "random";  // with nothing beside a seed
      if (bare && one.is_string()) one = Json{{"id", id}};
      if (bare || id == "jittered") one["seed"] = 0;
    }
    for (auto const& [key, value] : node->members()) {
      if (value.is_array()) value.complain("a single value: the one that the code is shown beside");
    }
  }
  Json const study = {{"schema", "sphverify-study/1"},
                      {"name", label},
                      {"cases", {{"id", chosen.scene_case->info.id}, {"parameters", parameters_json(chosen.parameters.all())}}},
                      {"formulations", {{"id", label}, {"command", {"-", "{initial}", "{final}"}}}},
                      {"discretisation", choices},
                      {"resolution", 1}};
  Expansion const expansion = expand(read_study(Node(study, document.file())));
  if (expansion.runs.empty())
    throw UserError(document.file(), "discretisation", expansion.skipped.front().reason, "what a run of the case could have");
  return expansion.runs.front().discretisation;
}

MeasureSet read_measures(Node const& document) {
  auto const node = document.find("measure");
  if (!node) return {Measure::error, Measure::conservation};
  MeasureSet set;
  for (Node const& one : node->one_or_many()) {
    std::string const word = one.word({"error", "conservation", "profile", "history"});
    for (MeasureWord const& known : measure_words()) {
      if (known.word != word) continue;
      if (set.contains(known.measure)) one.complain("every measure only once");
      set.insert(known.measure);
    }
  }
  return set;
}

/// Results must not take the place of what they are of.
void require_other_file(std::string const& output, Node const& node, std::string const& file) {
  std::error_code error;
  if (output != "-" && std::filesystem::equivalent(output, file, error)) node.complain("another file than the output");
}

NamedSnapshot read_entry(Node const& node, std::filesystem::path const& folder, std::string const& output,
                         Discretisation const& d) {
  node.require_keys({"file", "resolution", "time", "seconds", "seed"});
  NamedSnapshot one{node};
  for (Node const& file : node.at("file").one_or_many()) {
    if (file.string().empty()) file.complain("the name of a file");
    one.files.push_back((folder / file.string()).lexically_normal().string());
    require_other_file(output, file, one.files.back());
  }
  if (one.files.empty()) node.at("file").complain("a file, or those of one snapshot");
  one.resolution = static_cast<int>(node.at("resolution").integer(1, 100'000'000));
  if (auto const time = node.find("time")) one.time = time->number_between(0.0, 1e100);
  if (auto const seconds = node.find("seconds")) one.seconds = seconds->positive_number();
  if (auto const seed = node.find("seed")) {
    if (!is_drawn(d.layout))
      seed->complain("none, or a layout that is drawn by lot (jittered, glass, random) in discretisation.layout");
    one.seed = static_cast<std::uint64_t>(seed->integer(0, std::numeric_limits<std::int64_t>::max()));
  }
  return one;
}

/// The time by the file, the document, or both.
void settle_time(Snapshot& snapshot, NamedSnapshot const& entry) {
  if (snapshot.time && entry.time && std::abs(*snapshot.time - *entry.time) > same_time * std::max(*entry.time, 1e-300))
    throw UserError(entry.node.file(), entry.node.key() + ".time", fmt::format("{}", *entry.time),
                    fmt::format("{}, as {} says", *snapshot.time, snapshot.file));
  if (!snapshot.time) snapshot.time = entry.time;
  if (!snapshot.time) throw UserError(entry.node.file(), entry.node.key() + ".time", "nothing, and no time in " + snapshot.file, "its time");
}

RunRecord assess_run(Whole const& whole, std::vector<NamedSnapshot const*> const& entries) {
  std::vector<std::pair<Snapshot, NamedSnapshot const*>> read;
  for (NamedSnapshot const* entry : entries) {
    read.emplace_back(read_snapshot(entry->files, whole.options), entry);
    settle_time(read.back().first, *entry);
  }
  std::stable_sort(read.begin(), read.end(), [](auto const& a, auto const& b) { return *a.first.time < *b.first.time; });
  for (std::size_t k = 1; k < read.size(); ++k) {
    if (*read[k].first.time - *read[k - 1].first.time > same_time * *read[k].first.time) continue;
    throw UserError(read[k].second->node.file(), read[k].second->node.key(),
                    fmt::format("a second snapshot of N = {} at t = {}", entries.front()->resolution, *read[k].first.time),
                    "every resolution, seed and time once");
  }
  NamedSnapshot const& judged = *read.back().second;
  for (std::size_t k = 0; k + 1 < read.size(); ++k) {
    if (read[k].second->seconds)
      read[k].second->node.at("seconds").complain("none: the time of a run stands beside its last snapshot");
  }
  RunRecord record;
  record.case_id = whole.chosen.scene_case->info.id;
  record.parameters = whole.chosen.parameters.all();
  record.formulation.id = record.label = whole.label;
  record.discretisation = whole.discretisation;
  record.discretisation.layout.seed = judged.seed;
  record.resolution = judged.resolution;
  std::vector<Snapshot> history;
  for (auto& [snapshot, entry] : read) history.push_back(std::move(snapshot));
  AnyProblem const problem = whole.chosen.scene_case->problem(whole.chosen.parameters);
  AssessedCase const one{whole.chosen.scene_case, problem, record.discretisation, judged.resolution,
                         whole.discretisation.smoothing_ratio};
  assess_snapshots(one, std::move(history), whole.options, whole.measure, record);
  if (judged.seconds) {
    Cost& cost = record.cost.emplace();
    cost.seconds = *judged.seconds;
    cost.repeats = 1;
    cost.median.median = *judged.seconds;
  }
  return record;
}

}  // namespace

Results assess(Node const& document, std::string const& output) {
  std::vector<std::string> keys{"schema", "name", "case", "discretisation", "measure", "snapshots"};
  keys.insert(keys.end(), snapshot_option_keys.begin(), snapshot_option_keys.end());
  document.require_document("sphverify-snapshots/1", keys);
  StudyCase const chosen = read_case(document.at("case"));
  CaseInfo const& info = chosen.scene_case->info;
  if (info.kind == CaseKind::rates) document.at("case").complain("a case in which time passes: `evaluate` compares rates");
  require_external_name(document.at("name"), document.at("name").string());
  std::string const label = external_prefix + document.at("name").string();
  Whole const whole{chosen, read_choices(document, chosen, label), read_snapshot_options(document), read_measures(document),
                    label};

  auto const folder = std::filesystem::path(document.file()).parent_path();
  std::map<std::pair<int, std::uint64_t>, std::vector<NamedSnapshot const*>> runs;
  std::vector<NamedSnapshot> entries;
  for (Node const& node : document.at("snapshots").elements())
    entries.push_back(read_entry(node, folder, output, whole.discretisation));
  if (entries.empty()) document.at("snapshots").complain("one or more snapshots");
  for (NamedSnapshot const& entry : entries) runs[{entry.resolution, entry.seed}].push_back(&entry);

  Results results;
  results.context = current_context();
  results.study = document.json().dump();
  for (auto const& [key, members] : runs) results.runs.push_back(assess_run(whole, members));
  results.series = build_series(results.runs);
  results.surfaces = build_surfaces(results.runs);
  return results;
}

}  // namespace sphverify
