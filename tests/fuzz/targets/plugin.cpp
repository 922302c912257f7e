// SPDX-License-Identifier: GPL-3.0-or-later
// What a plug-in says of itself and answers, one thing a line: `name p-rho2`, `rate 0`, `rates 1 nan -2`.
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "formulations/plugins/plugin_library.hpp"
#include "formulations/plugins/plugin_operator.hpp"
#include "formulations/rate_operator.hpp"
#include "harness/evaluate/evaluate.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

namespace {

constexpr char const* id = "plugin/of-text";

template <class Value>
Value& variable(char const* name) {
  static void* const library = dlopen(SPHVERIFY_FUZZ_PLUGIN, RTLD_NOW | RTLD_LOCAL);
  void* const found = library ? dlsym(library, name) : nullptr;
  if (!found) throw std::runtime_error(std::string(name) + " is not in " + SPHVERIFY_FUZZ_PLUGIN);
  return *static_cast<Value*>(found);
}

/// As a plug-in would by strncpy: without a zero at its end where it is too long.
template <std::size_t size>
void put(char (&text)[size], std::string const& words) {
  std::memcpy(text, words.data(), std::min(size, words.size()));
}

void read_line(std::string const& line) {
  auto& d = variable<sphverify_description>("fuzz_description");
  std::size_t const space = std::min(line.find(' '), line.size());
  std::string const key = line.substr(0, space);
  std::string const words = line.substr(std::min(space + 1, line.size()));
  auto const number = static_cast<std::int32_t>(std::strtoll(words.c_str(), nullptr, 10));
  if (key == "name") put(d.name, words);
  if (key == "title") put(d.title, words);
  if (key == "source") put(d.source, words);
  if (key == "equation") put(d.equation, words);
  if (key == "work_partner") put(d.work_partner, words);
  if (key == "rate") d.rate = number;
  if (key == "reads") d.reads = number;
  if (key == "reads_at_walls") d.reads_at_walls = number;
  if (key == "conserves") d.conserves = number;
  if (key == "wants_neighbours") d.wants_neighbours = number;
  if (key == "passes") d.passes = number;
  if (key == "thread_safe") d.thread_safe = number;
  if (key == "abi") variable<int>("fuzz_abi") = number;
  if (key == "status") variable<int>("fuzz_status") = number;
  if (key == "walls") variable<int>("fuzz_writes_walls") = number;
  if (key == "rates") {
    auto& rates = variable<double[64]>("fuzz_rates");
    int& count = variable<int>("fuzz_rate_count");
    std::istringstream numbers(words);
    for (std::string one; count < 64 && numbers >> one;) rates[count++] = std::strtod(one.c_str(), nullptr);
  }
}

void read(std::string const& file) {
  variable<sphverify_description>("fuzz_description") = {};
  variable<int>("fuzz_abi") = SPHVERIFY_PLUGIN_ABI;
  variable<int>("fuzz_status") = variable<int>("fuzz_writes_walls") = variable<int>("fuzz_rate_count") = 0;
  std::ifstream input(file, std::ios::binary);
  for (std::string line; std::getline(input, line);) read_line(line);
}

/// The plug-in under study, behind a part that stays: the program takes up parts once, before anything else.
struct Slot {
  SchemeInfo info{};
  PluginLibrary* library = nullptr;
};

Slot& slot() {
  static Slot& one = *[] {
    auto* const made = new Slot;
    made->info.id = id;
    add_scheme({.info = &made->info,
                .in_1d = [made] { return make_plugin_operator<1>(*made->library); },
                .in_2d = [made] { return make_plugin_operator<2>(*made->library); },
                .in_3d = [made] { return make_plugin_operator<3>(*made->library); }});
    return made;
  }();
  return one;
}

}  // namespace

void take_plugin(std::string const& file) {
  read(file);
  Slot& here = slot();
  try {
    PluginLibrary library(SPHVERIFY_FUZZ_PLUGIN);
    here.info = library.info();
    here.info.id = id;
    here.library = &library;
    static std::vector<Json> const states{read_json_file("state.json"), read_json_file("state-2d.json")};
    for (Json const& state : states)
      document_text(evaluate_state(Node(state, "state.json"), {id, std::string(id) + "-no-walls"}));
  } catch (BadPlugin const& error) {
    throw UserError("plug-in", "", error.found(), error.expected());
  }
}

}  // namespace sphverify::fuzz
