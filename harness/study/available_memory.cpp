// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/available_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace sphverify {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// The number in a file; infinite where there is no file, or a word ("max") in it.
double number_in(std::filesystem::path const& file) {
  std::ifstream stream(file);
  double number = none;
  return stream >> number ? number : none;
}

/// The least limit of a group and of those above it.
double least_limit(std::filesystem::path const& mount, std::filesystem::path group, char const* file) {
  double least = number_in(mount / file);
  for (; group.has_relative_path(); group = group.parent_path()) {
    least = std::min(least, number_in(mount / group.relative_path() / file));
  }
  return least;
}

}  // namespace

double control_group_limit(std::filesystem::path const& root) {
  std::filesystem::path const mount = root / "sys/fs/cgroup";
  double least = none;
  std::ifstream groups(root / "proc/self/cgroup");
  // NUMBER:CONTROLLERS:GROUP, without controllers in version 2.
  for (std::string line; std::getline(groups, line);) {
    std::size_t const first = line.find(':');
    std::size_t const second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    std::string const controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    std::string const group = line.substr(second + 1);
    if (controllers == ",,") least = std::min(least, least_limit(mount, group, "memory.max"));
    if (controllers.find(",memory,") != std::string::npos) {
      least = std::min(least, least_limit(mount / "memory", group, "memory.limit_in_bytes"));
    }
  }
  return least;
}

double available_memory() {
  double const physical =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  rlimit of_process{};
  bool const is_limited = getrlimit(RLIMIT_AS, &of_process) == 0 && of_process.rlim_cur != RLIM_INFINITY;
  return std::min(
      {physical, is_limited ? static_cast<double>(of_process.rlim_cur) : none, control_group_limit("/")});
}

}  // namespace sphverify
