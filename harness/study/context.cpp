// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/context.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "harness/measure/machine.hpp"
#include "reports/user_error.hpp"
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

/// reproducible-builds.org: who sets the variable wants that date wherever one is written.
std::time_t now() {
  char const* const said = std::getenv("SOURCE_DATE_EPOCH");
  if (said == nullptr || *said == '\0') return std::time(nullptr);
  constexpr std::int64_t end_of_9999 = 253402300799;
  std::string_view const text = said;
  std::int64_t seconds = -1;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc{} || end != text.data() + text.size() || seconds < 0 || seconds > end_of_9999)
    throw UserError("SOURCE_DATE_EPOCH", "", fmt::format("'{}'", text), "whole seconds since 1970-01-01, before the year 10000");
  return static_cast<std::time_t>(seconds);
}

}  // namespace

std::string const& program_name() { return identity().program; }
void set_program_name(std::string_view name) { identity().program = name; }
void note_added_part(std::string_view id) {
  auto& added = identity().added;
  if (std::find(added.begin(), added.end(), id) == added.end()) added.emplace_back(id);
}

Context build_context() {
  Context context;
  context.version = build::version;
  context.commit = build::commit;
  context.compiler = build::compiler;
  context.flags = build::flags;
  context.program = identity().program;
  context.added = identity().added;
  return context;
}

std::string_view build_type() { return build::type; }
std::string_view build_date() { return build::date; }

Context current_context() {
  Context context = build_context();
  context.processor = processor_name();
  context.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now()));
  context.cores = static_cast<int>(std::thread::hardware_concurrency());
  context.machine = machine_name();
  return context;
}

}  // namespace sphverify
