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
#include "harness/scene/choices.hpp"
#include "harness/study/context.hpp"
#include "harness/study/read_case.hpp"
#include "harness/study/read_envelope.hpp"
#include "harness/study/read_layout.hpp"
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

/// The choices beside which a code is shown: those of our own runs that leave everything open.
Discretisation open_choices(CaseInfo const& info) {
  Discretisation d;
  if (!moves(info.kind)) return d;
  d.density = "continuity";
  d.integrator = info.discontinuous ? "leapfrog" : "runge-kutta";
  if (info.discontinuous) d.viscosity = {1.0, 2.0};
  return d;
}

Discretisation read_choices(Node const& document, StudyCase const& chosen) {
  Discretisation d = open_choices(chosen.scene_case->info);
  auto const node = document.find("discretisation");
  if (!node) return d;
  node->require_keys({"kernel", "smoothing_ratio", "layout"});
  if (auto const kernel = node->find("kernel")) d.kernel = kernel->word(kernel_words());
  if (auto const ratio = node->find("smoothing_ratio")) d.smoothing_ratio = read_smoothing_ratio(*ratio);
  if (auto const layout = node->find("layout")) {
    // Its seeds stand beside the snapshots.
    Json without = layout->json();
    if (without.is_object() && (without.contains("seed") || without.contains("seeds")))
      layout->complain("a layout without its seed, which stands beside each snapshot");
    bool const is_drawn = without.is_string() ? without == "glass" : without.value("id", "") == "jittered" || without.value("id", "") == "glass";
    if (is_drawn && without.is_string()) without = Json{{"id", without}};
    if (is_drawn) without["seed"] = 0;
    d.layout = read_layout(Node(without, layout->file(), layout->key())).front();
  }
  return d;
}

MeasureSet read_measures(Node const& document) {
  auto const node = document.find("measure");
  if (!node) return {Measure::error, Measure::conservation};
  MeasureSet set;
  for (Node const& one : node->one_or_many()) {
    std::string const word = one.word({"error", "conservation", "profile", "history"});
    for (MeasureWord const& known : measure_words()) {
      if (known.word == word) set.insert(known.measure);
    }
  }
  return set;
}

NamedSnapshot read_entry(Node const& node, std::filesystem::path const& folder, Discretisation const& d) {
  node.require_keys({"file", "resolution", "time", "seconds", "seed"});
  NamedSnapshot one{node};
  for (Node const& file : node.at("file").one_or_many()) one.files.push_back((folder / file.string()).lexically_normal().string());
  if (one.files.empty()) node.at("file").complain("a file, or those of one snapshot");
  one.resolution = static_cast<int>(node.at("resolution").integer(1, 100'000'000));
  if (auto const time = node.find("time")) one.time = time->number_between(0.0, 1e100);
  if (auto const seconds = node.find("seconds")) one.seconds = seconds->positive_number();
  if (auto const seed = node.find("seed")) {
    if (d.layout.id != "jittered" && d.layout.id != "glass")
      seed->complain("none, or a layout that is drawn by lot (jittered, glass) in discretisation.layout");
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
  AssessedCase const one{whole.chosen.scene_case, whole.chosen.parameters, problem,
                         record.discretisation,   judged.resolution,       whole.discretisation.smoothing_ratio};
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

Results assess(Node const& document) {
  std::vector<std::string> keys{"schema", "name", "case", "discretisation", "measure", "snapshots"};
  keys.insert(keys.end(), snapshot_option_keys.begin(), snapshot_option_keys.end());
  document.require_document("sphverify-snapshots/1", keys);
  StudyCase const chosen = read_case(document.at("case"));
  CaseInfo const& info = chosen.scene_case->info;
  if (info.kind == CaseKind::rates) document.at("case").complain("a case in which time passes: `evaluate` compares rates");
  require_external_name(document.at("name"), document.at("name").string());
  Whole const whole{chosen, read_choices(document, chosen), read_snapshot_options(document), read_measures(document),
                    external_prefix + document.at("name").string()};

  auto const folder = std::filesystem::path(document.file()).parent_path();
  std::map<std::pair<int, std::uint64_t>, std::vector<NamedSnapshot const*>> runs;
  std::vector<NamedSnapshot> entries;
  for (Node const& node : document.at("snapshots").elements())
    entries.push_back(read_entry(node, folder, whole.discretisation));
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
