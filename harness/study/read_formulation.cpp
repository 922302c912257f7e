// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/read_formulation.hpp"

#include <algorithm>

#include "formulations/rate_operator.hpp"
#include "harness/scene/choices.hpp"
#include "harness/study/load_plugin.hpp"
#include "harness/study/read_case.hpp"

namespace sphverify {

std::string load_plugin_named(Node const& library, std::vector<std::string>& plugins) {
  std::string const path = library.string();
  if (std::find(plugins.begin(), plugins.end(), path) == plugins.end()) plugins.push_back(path);
  return load_plugin_for_user(path, library.file(), library.key());
}

namespace {

/// Those of the schemes that fit.
template <class Fits>
std::vector<std::string> scheme_ids(Fits const& fits) {
  std::vector<std::string> ids;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (fits(scheme->rate)) ids.emplace_back(scheme->id);
  }
  return ids;
}

/// A formulation whose library the same object names.
void load_beside(Node const& object, std::vector<std::string>& plugins) {
  auto const library = object.find("library");
  if (!library) return;
  std::string const found = load_plugin_named(*library, plugins);
  if (object.at("id").string() != found) object.at("id").complain("'" + found + "', as the library calls itself");
}

/// The energy or the heat equation beside a momentum form: an identifier, or a plug-in with its library.
template <class Fits>
std::string read_partner(Node const& node, std::vector<std::string>& plugins, Fits const& fits) {
  if (node.is_string()) return node.word(scheme_ids(fits));
  node.require_keys({"id", "library"});
  load_beside(node, plugins);
  return node.at("id").word(scheme_ids(fits));
}

}  // namespace

FormulationChoice read_study_formulation(Node const& node, std::vector<std::string>& plugins) {
  FormulationChoice f;
  bool const bare = node.is_string();
  if (!bare) {
    node.require_keys({"id", "library", "walls", "work", "conduction"});
    load_beside(node, plugins);
  }
  Node const id = bare ? node : node.at("id");
  std::vector<std::string> const known = scheme_ids([](Rate) { return true; });
  if (id.is_string() && id.string().starts_with("plugin/") &&
      std::find(known.begin(), known.end(), id.string()) == known.end()) {
    id.complain(R"({"id": "plugin/NAME", "library": "PATH"} for a plug-in that no other formulation has named)");
  }
  f.id = read_identifier(id, known, "sphverify list formulations");
  if (bare) return f;
  if (auto const walls = node.find("walls")) f.walls = WallChoice(walls->word(wall_words()));
  bool const is_momentum = find_scheme(f.id)->rate == Rate::acceleration;
  if (auto const work = node.find("work")) {
    if (!is_momentum) work->complain("no partner: only a momentum form has them");
    f.work = read_partner(*work, plugins,
                          [](Rate rate) { return rate == Rate::internal_work || rate == Rate::total_work; });
  }
  if (auto const conduction = node.find("conduction")) {
    if (!is_momentum) conduction->complain("no partner: only a momentum form has them");
    f.conduction = read_partner(*conduction, plugins, [](Rate rate) { return rate == Rate::conduction_heating; });
  }
  return f;
}

}  // namespace sphverify
