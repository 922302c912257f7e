// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/context.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "harness/measure/machine.hpp"
#include "sphverify_build.hpp"

namespace sphverify {

namespace {

struct Identity {
  std::string program = "sphverify";
  std::vector<std::string> added;
};
Identity& identity() {
  static Identity one;
  return one;
}

}  // namespace

std::string const& program_name() { return identity().program; }
void set_program_name(std::string_view name) { identity().program = name; }
void note_added_part(std::string_view id) {
  auto& added = identity().added;
  if (std::find(added.begin(), added.end(), id) == added.end()) added.emplace_back(id);
}

Context current_context() {
  return {.version = build::version,
          .commit = build::commit,
          .compiler = build::compiler,
          .flags = build::flags,
          .processor = processor_name(),
          .date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .program = identity().program,
          .added = identity().added,
          .machine = machine_name()};
}

}  // namespace sphverify
