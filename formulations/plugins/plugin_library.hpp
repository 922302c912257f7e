// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <stdexcept>
#include <string>

#include "formulations/scheme.hpp"
#include "sphverify/plugin.h"

namespace sphverify {

/// A shared library that is no plug-in, or not one for this program: what was found and what was expected.
class BadPlugin : public std::runtime_error {
 public:
  BadPlugin(std::string found, std::string expected)
      : std::runtime_error("found " + found + ", expected " + expected),
        found_(std::move(found)),
        expected_(std::move(expected)) {}
  std::string const& found() const { return found_; }
  std::string const& expected() const { return expected_; }

 private:
  std::string found_, expected_;
};

/// A formulation in a shared library (include/sphverify/plugin.h). Loaded once, and never unloaded: what it has made may live
/// as long as the program.
class PluginLibrary {
 public:
  /// Throws BadPlugin.
  explicit PluginLibrary(std::string path);

  std::string const& path() const { return path_; }
  SchemeInfo const& info() const { return info_; }
  /// What it reads of particles; info().reads has what closures at walls look at beside.
  FieldSet asked() const { return asked_; }
  bool wants_neighbours() const { return description_.wants_neighbours != 0; }

  /// Calls the library's function; one thread at a time unless it says that it can do more. A crash inside ends the program
  /// with one line that names the plug-in, and exit status 3. Throws
  /// std::invalid_argument where the function says that it failed.
  void rates(sphverify_state const& state, sphverify_rates& rates);

 private:
  void describe();

  std::string path_, id_;
  FieldSet asked_;
  sphverify_description description_{};
  int (*rates_)(sphverify_state const*, sphverify_rates*) = nullptr;
  void (*describe_)(sphverify_description*) = nullptr;
  SchemeInfo info_{};
  std::mutex one_at_a_time_;
};

/// Loads a plug-in and adds it to the schemes that there are (add_scheme), unless it is there already. Not while anything
/// runs. Returns its identifier, plugin/NAME. Throws BadPlugin.
std::string const& load_plugin(std::string const& path);

}  // namespace sphverify
