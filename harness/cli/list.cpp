// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "harness/cli/catalogue.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

struct ListOptions {
  std::string kind;
  bool json = false;
};

void list(ListOptions const& options) {
  if (options.json) {
    Json document = {{"schema", "sphverify-list/1"}};
    for (std::string const& kind : catalogue_kinds()) {
      if (!options.kind.empty() && options.kind != kind) continue;
      document[kind] = Json::array();
      for (CatalogueEntry const& entry : catalogue()) {
        if (entry.kind != kind) continue;
        document[kind].push_back({{"id", entry.id}, {"title", entry.title}, {"source", entry.source}});
      }
    }
    write_document("-", document_text(document));
    return;
  }
  // Off a terminal an entry is one line, for grep.
  bool const is_terminal = isatty(STDOUT_FILENO) != 0;
  std::size_t const columns = known_columns().value_or(usual_columns);
  std::string text;
  for (std::string const& kind : catalogue_kinds()) {
    if (!options.kind.empty() && options.kind != kind) continue;
    if (options.kind.empty()) text += kind + "\n";
    for (CatalogueEntry const& entry : catalogue()) {
      if (entry.kind != kind) continue;
      std::string const source = entry.source.empty() ? "" : fmt::format(" ({})", entry.source);
      std::string const head = fmt::format("{}{:<29} ", options.kind.empty() ? "  " : "", entry.id);
      std::string const words = entry.title + source;
      text += is_terminal ? hanging_lines(head, words, head.size(), columns) : head + words + "\n";
    }
  }
  write_document("-", text);
}

}  // namespace

void add_list(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "What there is, one line each: identifier, title, source");
  take_one_of(command->add_option("KIND", options->kind,
                                  "formulations, cases, kernels, walls, viscosities, layouts or measures; all by default"),
              catalogue_kinds());
  command->add_flag("--json", options->json, "As a JSON document");
  command->footer("Example: sphverify list cases --json");
  command->callback([options] { list(*options); });
}

}  // namespace sphverify
