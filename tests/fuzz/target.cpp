// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/target.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "reports/printable.hpp"
#include "reports/user_error.hpp"

namespace sphverify::fuzz {

namespace {

constexpr char const* input_file = "input";

std::filesystem::path& folder() {
  static std::filesystem::path path;
  return path;
}

void remove_folder() {
  std::error_code none;
  std::filesystem::remove_all(folder(), none);
}

/// A refusal that is not one line of printable text would be a second way of going wrong.
void require_one_line(std::string const& message) {
  if (message.empty() || printable(message) != message)
    throw std::logic_error("refused, but not in one line: " + message);
}

}  // namespace

std::vector<Target> const& targets() {
  static std::vector<Target> const all{{"study", take_study}, {"results", take_results},
                                       {"part", take_part},   {"journal", take_journal},
                                       {"gates", take_gates}, {"snapshots", take_snapshots},
                                       {"csv", take_csv},
#ifdef SPHVERIFY_FUZZ_HDF5
                                       {"hdf5", take_hdf5},   {"built-hdf5", take_built_hdf5},
#endif
                                       {"state", take_state}, {"rates", take_rates},
                                       {"order", take_order}, {"plugin", take_plugin}};
  return all;
}

Target const& target_named(std::string_view name) {
  for (Target const& one : targets()) {
    if (one.name == name) return one;
  }
  throw std::invalid_argument("no target '" + std::string(name) + "'");
}

void enter_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "sphverify-fuzz-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
  folder() = name;
  std::atexit(remove_folder);
  for (auto const& file : std::filesystem::directory_iterator(SPHVERIFY_FUZZ_BESIDE))
    std::filesystem::copy(file.path(), folder() / file.path().filename());
  std::filesystem::current_path(folder());
}

void take(Target const& target, std::string_view input) {
  std::ofstream(input_file, std::ios::binary).write(input.data(), static_cast<std::streamsize>(input.size()));
  try {
    target.take(input_file);
  } catch (UserError const& error) {
    require_one_line(error.what());
  }
}

}  // namespace sphverify::fuzz
