// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace sphverify {

// Exit status of the program (contract).
inline constexpr int exit_done = 0;
inline constexpr int exit_gate_failed = 1;
inline constexpr int exit_user_error = 2;
inline constexpr int exit_program_error = 3;

// Each adds one command with its options to the program.
void add_study(CLI::App& app);
void add_compare(CLI::App& app);
void add_report(CLI::App& app);
void add_gate(CLI::App& app);
void add_list(CLI::App& app);
void add_describe(CLI::App& app);
void add_merge(CLI::App& app);
void add_repeat(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_exact(CLI::App& app);
void add_order(CLI::App& app);
void add_claims(CLI::App& app);
void add_particles(CLI::App& app);
void add_assess(CLI::App& app);

/// The program of this name with all commands, those first that are used most.
std::unique_ptr<CLI::App> command_line(std::string_view program);

/// What --version prints: version, build, what this machine and this build can do, licence.
std::string version_text();

}  // namespace sphverify
