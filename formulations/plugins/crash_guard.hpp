// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// While one of these lives, a signal by which a process dies, or an exit, ends the program with one line on standard error
/// that says which plug-in, or which library of others, this thread was in, and exit status 3. What it names must live longer.
class CrashGuard {
 public:
  /// @param plugin, library as the line names them
  CrashGuard(char const* plugin, char const* library);
  ~CrashGuard();
  CrashGuard(CrashGuard const&) = delete;
  CrashGuard& operator=(CrashGuard const&) = delete;
};

/// In a process that was made for one run: a signal kills it as any other, for the process that waits for it to see.
void let_signals_kill();

}  // namespace sphverify
