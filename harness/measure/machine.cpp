// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/machine.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <fstream>

namespace sphverify {

namespace {

std::string first_line(char const* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

int own_cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

std::string const& machine_name() {
  // Machines made of one image share the first, those of one rack the last: all of them tell enough apart.
  static std::string const name = [] {
    std::string const all = first_line("/etc/machine-id") + " " + host_name() + " " + processor_name();
    boost::crc_32_type crc;
    crc.process_bytes(all.data(), all.size());
    return fmt::format("{:08x}", crc.checksum());
  }();
  return name;
}

}  // namespace sphverify
