// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/plugins/crash_guard.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>

namespace sphverify {

namespace {

constexpr int program_failed = 3;
constexpr std::array signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

bool signals_kill = false;

thread_local char const* plugin_inside = nullptr;
thread_local char const* library_inside = nullptr;

char const* name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGBUS:
      return "bus error";
    case SIGFPE:
      return "arithmetic error";
    case SIGILL:
      return "illegal instruction";
    default:
      return "abort";
  }
}

/// Only what a signal handler may call.
void say(char const* text) { [[maybe_unused]] auto const written = write(STDERR_FILENO, text, std::strlen(text)); }

[[noreturn]] void end_with_a_line(char const* how) {
  say("sphverify: ");
  say(plugin_inside);
  say(" (");
  say(library_inside);
  say(") ");
  say(how);
  say("; runs that were finished are in the journal, if there is one\n");
  _exit(program_failed);
}

void on_signal(int signal) {
  if (plugin_inside && !signals_kill) {
    std::array<char, 64> how{};
    std::strcpy(how.data(), "crashed: ");
    std::strcat(how.data(), name_of(signal));
    end_with_a_line(how.data());
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// A routine may end the program on its own, as `stop` of Fortran does.
void on_exit() {
  if (plugin_inside) end_with_a_line("ended the program");
}

void install_once() {
  [[maybe_unused]] static bool const installed = [] {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_ONSTACK;
    for (int const signal : signals) sigaction(signal, &action, nullptr);
    std::atexit(on_exit);
    return true;
  }();
}

}  // namespace

CrashGuard::CrashGuard(char const* plugin, char const* library) {
  install_once();
  // A stack of its own for the handler, in every thread: the ordinary one may be what ran out.
  thread_local std::array<char, 65536> stack;
  thread_local bool const is_set = [] {
    stack_t const alternative{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
    return sigaltstack(&alternative, nullptr) == 0;
  }();
  static_cast<void>(is_set);
  plugin_inside = plugin;
  library_inside = library;
}

void let_signals_kill() { signals_kill = true; }

CrashGuard::~CrashGuard() { plugin_inside = library_inside = nullptr; }

}  // namespace sphverify
