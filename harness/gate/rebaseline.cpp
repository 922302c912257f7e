// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/rebaseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "harness/gate/measure.hpp"
#include "harness/gate/select.hpp"
#include "harness/gate/text.hpp"
#include "reports/json/results_json.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

std::string show(Number const& value) { return value ? fmt::format("{:.6g}", *value) : "none"; }

std::string difference(BaselineChange const& change) {
  if (!change.before || !change.after) return change.before ? "lost" : "new";
  double const d = *change.after - *change.before;
  std::string text = fmt::format("{:+.3g}", d);
  if (*change.before != 0.0) text += fmt::format(" ({:+.3g}%)", 100.0 * d / std::abs(*change.before));
  return text;
}

}  // namespace

Rebaseline plan_rebaseline(Gates const& gates, Results const& results, std::string const& results_path) {
  Rebaseline plan;
  std::map<std::string, std::optional<Results>> before;
  for (Gate const& gate : gates.gates) {
    std::string const& path = gate.limit.baseline;
    if (path.empty()) continue;
    if (!before.contains(path)) {
      require_writable(path, results_path);
      plan.paths.push_back(path);
      before[path] = std::filesystem::exists(path) ? std::optional(read_whole_results(path)) : std::nullopt;
    }
    auto const now = measure(gate, results, gates.file);
    if (now.empty()) throw UserError(gates.file, gate.key + ".select", why_empty(gate, results), "a run");
    auto const& old_results = before.at(path);
    auto const old = old_results ? measure_baseline(gate, *old_results) : std::vector<Measured>{};
    for (Measured const& m : now) {
      if (!m.value) {
        throw UserError(results_path, fmt::format("{} ({})", gate.name, describe(m)), m.problem,
                        "a number for every gate that has a baseline");
      }
      auto const found =
          std::find_if(old.begin(), old.end(), [&](Measured const& other) { return same_subject(m, other); });
      plan.changes.push_back({gate.name, describe(m), found == old.end() ? Number() : found->value, m.value});
    }
    for (Measured const& gone : old) {
      if (std::none_of(now.begin(), now.end(), [&](Measured const& m) { return same_subject(m, gone); }))
        plan.changes.push_back({gate.name, describe(gone), gone.value, std::nullopt});
    }
  }
  if (plan.paths.empty())
    throw UserError(gates.file, "gates", "no gate with a baseline", "one that has within and baseline");
  return plan;
}

std::string rebaseline_text(Rebaseline const& plan) {
  std::string text;
  std::size_t changed = 0;
  std::string gate;
  for (BaselineChange const& change : plan.changes) {
    if (change.before == change.after) continue;
    ++changed;
    if (change.gate != gate) text += change.gate + "\n";
    gate = change.gate;
    text += wrapped(fmt::format("{} -> {}, {}: {}", show(change.before), show(change.after),
                                difference(change), change.where));
  }
  return text + fmt::format("{} of {} numbers differ from the baseline\n", changed, plan.changes.size());
}

}  // namespace sphverify
