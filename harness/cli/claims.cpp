// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/claims.hpp"

#include <fmt/format.h>

#include <memory>

#include "formulations/rate_operator.hpp"
#include "harness/cli/commands.hpp"
#include "harness/gate/gates.hpp"
#include "harness/study/load_plugin.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/listed_identifiers.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

struct ClaimsCommand {
  std::vector<std::string> ids, plugins;
  bool json = false;
};

struct Held {
  SchemeInfo const* scheme;
  std::vector<ClaimResult> claims;
};

char const* verdict_of(ClaimResult const& result) {
  if (!result.is_looked_at) return "not looked at";
  if (result.fails()) return "FAILS";
  if (!result.claimed) return result.holds() ? "holds, unclaimed" : "not claimed";
  return "holds";
}

/// Where a claim was kept nobody asks for the kernel.
std::string readable(std::vector<Held> const& all) {
  std::size_t const width = known_columns().value_or(usual_columns);
  std::string text;
  for (Held const& held : all) {
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", held.scheme->id);
    for (ClaimResult const& one : held.claims) {
      bool const seen = one.is_looked_at;
      std::string const head = fmt::format("  {:<16} {:<8} ", verdict_of(one), seen ? scientific(one.found) : "-");
      std::string words = one.claim;
      if (seen && !one.holds()) words += fmt::format(" ({})", one.where);
      if (!one.remark.empty()) words += fmt::format(" [{}]", one.remark);
      text += hanging_lines(head, words, head.size(), width);
    }
  }
  return text;
}

Json json(std::vector<Held> const& all) {
  Json document = {{"schema", "sphverify-claims/1"}, {"formulations", Json::object()}};
  for (Held const& held : all) {
    Json& claims = document["formulations"][std::string(held.scheme->id)] = Json::array();
    for (ClaimResult const& one : held.claims) {
      bool const seen = one.is_looked_at;
      // An infinite defect is no number of JSON.
      bool const is_number = seen && one.found <= 1e300;
      claims.push_back({{"claim", one.claim},
                        {"claimed", one.claimed},
                        {"holds", seen ? Json(one.holds()) : Json(nullptr)},
                        {"found", is_number ? Json(one.found) : Json(nullptr)},
                        {"allowed", one.allowed},
                        {"where", seen ? Json(one.where) : Json(nullptr)},
                        {"remark", one.remark}});
    }
  }
  return document;
}

void claims(ClaimsCommand const& command) {
  std::vector<std::string> ids = command.ids;
  for (std::string const& path : command.plugins) {
    std::string const id = load_plugin_for_user(path, path, "");
    if (command.ids.empty()) ids.push_back(id);
  }
  std::vector<std::string> known;
  for (SchemeInfo const* scheme : all_scheme_infos()) known.emplace_back(scheme->id);
  if (ids.empty()) ids = known;
  std::vector<Held> all;
  bool fails = false;
  for (std::string const& id : ids) {
    SchemeInfo const* const scheme = find_scheme(id);
    if (!scheme)
      throw UserError("claims", "FORMULATION", "'" + id + "'", one_listed_by("sphverify list formulations", id, known));
    all.push_back({scheme, check_claims(*scheme)});
    for (ClaimResult const& one : all.back().claims) fails = fails || one.fails();
  }
  write_document("-", command.json ? document_text(json(all)) : readable(all));
  if (fails) throw GateFailed();
}

}  // namespace

void add_claims(CLI::App& app) {
  auto command = std::make_shared<ClaimsCommand>();
  CLI::App* sub = app.add_subcommand("claims", "Holds formulations to what they claim of themselves");
  sub->add_option("FORMULATION", command->ids, "Identifiers from `sphverify list formulations`; all by default");
  sub->add_option("--plugin", command->plugins, "A shared library to hold to its claims (sphverify/plugin.h)")
      ->allow_extra_args(false)
      ->type_name("LIBRARY");
  sub->add_flag("--json", command->json, "As a JSON document");
  sub->footer(
      "Conservation, exactness, symmetry and continuity, in one to three dimensions with every kernel. What is not "
      "claimed is no failure. Exit status: 0 all claims hold, 1 one fails.\n"
      "Example: sphverify claims momentum/p-rho2");
  sub->callback([command] { claims(*command); });
}

}  // namespace sphverify
