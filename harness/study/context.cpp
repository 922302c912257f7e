#include "harness/study/context.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "sphverify_build.hpp"

namespace sphverify {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

Context current_context() {
  return {.version = build::version,
          .commit = build::commit,
          .compiler = build::compiler,
          .flags = build::flags,
          .processor = processor_name(),
          .date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          .cores = static_cast<int>(std::thread::hardware_concurrency())};
}

}  // namespace sphverify
