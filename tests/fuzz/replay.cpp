// SPDX-License-Identifier: GPL-3.0-or-later
// Hands a target every file of its corpus, without a fuzzer: what it found once is not found again.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/target.hpp"

namespace {

constexpr double patience = 10.0;  // no answer to a small file may take as long [s of processor time]

std::string contents(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Whether the target took or refused it as it should.
bool replay(sphverify::fuzz::Target const& target, std::filesystem::path const& path) {
  std::string const input = contents(path);
  fmt::print("{} {}\n", target.name, path.filename().string());
  std::fflush(stdout);  // before it, should it crash
  std::clock_t const start = std::clock();
  try {
    sphverify::fuzz::take(target, input);
  } catch (std::exception const& error) {
    fmt::print("  failed: {}\n", error.what());
    return false;
  }
  double const taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (taken > patience) fmt::print("  failed: it took {:.1f} s\n", taken);
  return taken <= patience;
}

}  // namespace

/// replay TARGET FILE-OR-FOLDER...
int main(int argc, char** argv) {
  if (argc < 3) {
    for (auto const& target : sphverify::fuzz::targets()) fmt::print("{}\n", target.name);
    return 2;
  }
  auto const& target = sphverify::fuzz::target_named(argv[1]);
  std::vector<std::filesystem::path> files;
  for (int k = 2; k < argc; ++k) {
    auto const path = std::filesystem::absolute(argv[k]);
    if (!std::filesystem::is_directory(path)) files.push_back(path);
    if (!std::filesystem::is_directory(path)) continue;
    for (auto const& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  sphverify::fuzz::enter_folder();
  std::size_t failed = 0;
  for (auto const& file : files) failed += replay(target, file) ? 0 : 1;
  fmt::print("{}: {} files, {} failed\n", target.name, files.size(), failed);
  return failed == 0 && !files.empty() ? 0 : 1;
}
