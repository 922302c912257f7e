// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace sphverify {

namespace {

/// Below it a table is no table any more.
constexpr std::size_t fewest_columns = 40;

std::string_view environment(char const* name) {
  char const* const value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view{value};
}

/// A whole number that the environment names; 0 where it names none.
std::size_t columns_of_environment() {
  std::string_view const text = environment("COLUMNS");
  std::size_t columns = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  return error == std::errc{} && end == text.data() + text.size() ? columns : 0;
}

std::size_t columns_of_terminal(int stream) {
  winsize size{};
  return ioctl(stream, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

std::optional<std::size_t> known_columns() {
  std::size_t columns = columns_of_environment();
  for (int const stream : {STDOUT_FILENO, STDERR_FILENO, STDIN_FILENO}) {
    if (columns == 0) columns = columns_of_terminal(stream);
  }
  if (columns == 0) return std::nullopt;
  return std::max(columns, fewest_columns);
}

bool can_redraw(int stream) { return isatty(stream) != 0 && environment("TERM") != "dumb"; }

bool takes_colour(int stream) { return can_redraw(stream) && environment("NO_COLOR").empty(); }

}  // namespace sphverify
