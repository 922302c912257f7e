// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sphverify::fuzz {

/// A way by which input comes into the program: one of its readers, with what is made of what was read.
struct Target {
  std::string_view name;
  void (*take)(
      std::string const& file);  ///< what the program does with the file, as far as it carries out no run
};

std::vector<Target> const& targets();

/// Throws std::invalid_argument for a name that there is not.
Target const& target_named(std::string_view name);

/// Goes into an empty folder, in which documents find the files of tests/fuzz/beside. Once per process.
void enter_folder();

/// Hands input to a target. It may be refused, in one line that can be printed (UserError); everything else
/// that it may throw, and every other refusal, is a fault of the program, which is thrown.
void take(Target const& target, std::string_view input);

// The targets, one file each.
void take_study(std::string const& file);
void take_results(std::string const& file);
void take_part(std::string const& file);
void take_journal(std::string const& file);
void take_gates(std::string const& file);
void take_snapshots(std::string const& file);
void take_csv(std::string const& file);
void take_hdf5(std::string const& file);
void take_built_hdf5(std::string const& file);
void take_state(std::string const& file);
void take_rates(std::string const& file);
void take_order(std::string const& file);
void take_plugin(std::string const& file);

}  // namespace sphverify::fuzz
