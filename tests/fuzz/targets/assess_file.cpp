// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/targets/assess_file.hpp"

#include <optional>

#include "harness/codes/assess.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify::fuzz {

namespace {

struct Scene {
  char const* scene_case;
  double final_time;
  int resolution;
  Json options;
};

Json document_of(Scene const& scene, std::string const& file, std::string const& format) {
  Json document = {{"schema", "sphverify-snapshots/1"},
                   {"name", "theirs"},
                   {"case", {{"id", scene.scene_case}, {"parameters", {{"final_time", scene.final_time}}}}},
                   {"measure", {"error", "conservation", "profile", "history"}},
                   {"format", format},
                   {"snapshots", Json::array({{{"file", file}, {"resolution", scene.resolution}}})}};
  document.update(scene.options);
  return document;
}

}  // namespace

void assess_file(std::string const& file, std::string const& format) {
  static std::vector<Scene> const scenes{
      {"conduction/slab-dirichlet", 0.01, 16, {{"outside", "drop"}}},
      {"hydro/riemann", 0.01, 16, {{"density", "summation"}, {"smoothing_length", "support"}}},
      {"hydro/gresho",
       0.01,
       4,
       {{"density", {{"eta", 1.2}}}, {"shift", {0.5, 0.5}}, {"precision", "single"}}}};
  std::optional<UserError> refusal;
  for (Scene const& scene : scenes) {
    Json const document = document_of(scene, file, format);
    try {
      document_text(to_json(assess(Node(document, "snapshots.json"), "-")));
    } catch (UserError const& error) {
      refusal = error;
    }
  }
  if (refusal) throw UserError(*refusal);
}

}  // namespace sphverify::fuzz
