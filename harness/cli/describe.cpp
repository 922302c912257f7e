#include <fmt/format.h>

#include <memory>

#include "harness/cli/catalogue.hpp"
#include "harness/cli/commands.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct DescribeOptions {
  std::string id;
  bool json = false;
};

std::string indented(std::string const& text) {
  std::string out = "  ";
  for (char const c : text) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out;
}

void describe(DescribeOptions const& options) {
  std::vector<std::string> ids;
  CatalogueEntry const* found = nullptr;
  for (CatalogueEntry const& entry : catalogue()) {
    ids.push_back(entry.id);
    if (entry.id == options.id && found == nullptr) found = &entry;
  }
  if (found == nullptr) throw UserError("describe", "ID", "'" + options.id + "'", one_of(options.id, ids));
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
  std::string text = fmt::format("{}\n  {}\n", found->id, found->title);
  for (auto const& [label, value] : details.items()) {
    if (value.is_null() || value.empty() || (value.is_string() && value.get<std::string>().empty())) continue;
    text += fmt::format("\n{}\n", label);
    if (value.is_string()) {
      text += indented(value.get<std::string>()) + "\n";
    } else {
      for (Json const& line : value) text += fmt::format("  {}\n", line.get<std::string>());
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
