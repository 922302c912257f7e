// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "harness/cli/catalogue.hpp"
#include "harness/cli/commands.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/listed_identifiers.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

struct DescribeOptions {
  std::string id;
  bool json = false;
};

/// Lines of text, indented; on a terminal broken where they do not fit, the rest a little further in.
std::string indented(std::string const& text) {
  bool const is_terminal = isatty(STDOUT_FILENO) != 0;
  std::size_t const columns = known_columns().value_or(usual_columns);
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::size_t const blanks = std::min(line.find_first_not_of(' '), line.size());
    std::string const head(2 + blanks, ' ');
    out +=
        is_terminal ? hanging_lines(head, line.substr(blanks), head.size() + 2, columns) : "  " + line + "\n";
  }
  return out;
}

void describe(DescribeOptions const& options) {
  std::vector<std::string> ids;
  CatalogueEntry const* found = nullptr;
  for (CatalogueEntry const& entry : catalogue()) {
    ids.push_back(entry.id);
    if (entry.id == options.id && found == nullptr) found = &entry;
  }
  if (found == nullptr)
    throw UserError("describe", "ID", "'" + options.id + "'",
                    one_listed_by("sphverify list", options.id, ids));
  Json const details = found->details();
  if (options.json) {
    Json document = {{"schema", "sphverify-description/1"},
                     {"kind", found->kind},
                     {"id", found->id},
                     {"title", found->title}};
    document.update(details);
    write_document("-", document_text(document));
    return;
  }
  std::string text = found->id + "\n" + indented(found->title);
  for (auto const& [label, value] : details.items()) {
    if (value.is_null() || value.empty() || (value.is_string() && value.get<std::string>().empty())) continue;
    text += fmt::format("\n{}\n", label);
    if (value.is_string()) {
      text += indented(value.get<std::string>());
    } else {
      for (Json const& line : value) text += indented(line.get<std::string>());
    }
  }
  write_document("-", text);
}

}  // namespace

void add_describe(CLI::App& app) {
  auto options = std::make_shared<DescribeOptions>();
  CLI::App* command =
      app.add_subcommand("describe", "Equations, citation, parameters, fields and passes of one entry");
  command->add_option("ID", options->id, "An identifier from `sphverify list`")->required();
  command->add_flag("--json", options->json, "As a JSON document");
  command->footer("Example: sphverify describe conduction/brookshaw");
  command->callback([options] { describe(*options); });
}

}  // namespace sphverify
