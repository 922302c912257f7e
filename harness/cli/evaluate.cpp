#include "harness/evaluate/evaluate.hpp"

#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/study/load_plugin.hpp"
#include "reports/json/results_json.hpp"
#include "reports/printable.hpp"

namespace sphverify {

void add_evaluate(CLI::App& app) {
  struct EvaluateCommand {
    std::string state;
    std::string output = "-";
    std::vector<std::string> plugins;
  };
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* sub = app.add_subcommand("evaluate", "Rates of every scheme on particles that you give");
  sub->add_option("STATE.json", command->state, "A state document; - for standard input")->required();
  sub->add_option("-o,--output", command->output, "Where the rates go; standard output by default");
  sub->add_option("--plugin", command->plugins, "Shared libraries whose rates are wanted too (sphverify/plugin.h)")
      ->allow_extra_args(false);
  sub->footer("Example: sphverify evaluate state.json -o rates.json");
  sub->callback([command] {
    for (std::string const& path : command->plugins) load_plugin_for_user(path, path, "");
    require_writable(command->output, command->state);
    Json const state = read_json_file(command->state);
    Json const rates = evaluate_state(Node(state, command->state));
    if (Json const& open = rates.at("open_towards"); !open.is_null()) {
      fmt::print(stderr, "{}: walls: they do not close: nothing bounds the particles towards {}\n",
                 printable(command->state), open.dump());
    }
    for (Json const& remark : rates.at("remarks")) {
      fmt::print(stderr, "{}: particles.smoothing_length: {}\n", printable(command->state),
                 remark.get<std::string>());
    }
    write_document(command->output, document_text(rates));
  });
}

}  // namespace sphverify
