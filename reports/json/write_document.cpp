// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

constexpr char const* temporary_mark = ".tmp";

/// Beside the target, so that the rename stays within one file system.
std::string temporary_path(std::string const& path) { return path + temporary_mark + std::to_string(getpid()); }

[[noreturn]] void cannot_write(std::string const& path) {
  throw UserError(path, "", std::string("a place that cannot be written (") + std::strerror(errno) + ")",
                  "a writable file");
}

void write_all(int file, std::string const& text, std::string const& path) {
  std::size_t written = 0;
  while (written < text.size()) {
    ssize_t const n = write(file, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
    written += static_cast<std::size_t>(n);
  }
}

/// What a device or a pipe is: it can be written to, but not replaced.
bool is_special(std::string const& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

/// Small objects and lists stay on one line.
void write_value(Json const& value, int indent, std::string& text) {
  constexpr std::size_t widest = 110;
  std::string const flat = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!value.is_structured() || flat.size() + static_cast<std::size_t>(indent) <= widest) {
    text += flat;
    return;
  }
  bool const is_object = value.is_object();
  text += is_object ? '{' : '[';
  bool first = true;
  for (auto const& item : value.items()) {
    text += first ? "\n" : ",\n";
    first = false;
    text.append(static_cast<std::size_t>(indent) + 1, ' ');
    if (is_object) text += Json(item.key()).dump() + ": ";
    write_value(item.value(), indent + 1, text);
  }
  text += '\n';
  text.append(static_cast<std::size_t>(indent), ' ');
  text += is_object ? '}' : ']';
}

}  // namespace

std::string document_text(Json const& document) {
  std::string text;
  write_value(document, 0, text);
  return text + "\n";
}

void require_writable(std::string const& path, std::string const& input) {
  if (path == "-") return;
  std::error_code none;
  if (!input.empty() && std::filesystem::equivalent(path, input, none)) {
    throw UserError(path, "", "the input itself", "another file for the output");
  }
  if (path.empty())
    throw UserError("output", "", "an empty name", "a writable file, or - for standard output");
  if (is_special(path)) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
      errno = EISDIR;
      cannot_write(path);
    }
    if (access(path.c_str(), W_OK) != 0) cannot_write(path);
    return;
  }
  std::string const probe = temporary_path(path);
  int const file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) cannot_write(path);
  close(file);
  unlink(probe.c_str());
}

void remove_unfinished(std::string const& path) {
  std::filesystem::path const target(path);
  std::string const prefix = target.filename().string() + temporary_mark;
  std::error_code none;
  auto const folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  for (auto const& entry : std::filesystem::directory_iterator(folder, none)) {
    std::string const name = entry.path().filename().string();
    bool const is_left = name.size() > prefix.size() && name.starts_with(prefix) &&
                         name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_left) std::filesystem::remove(entry.path(), none);
  }
}

void write_document(std::string const& path, std::string const& text) {
  if (path == "-") {
    std::cout << text << std::flush;
    if (!std::cout) throw std::runtime_error("standard output cannot be written");
    return;
  }
  bool const in_place = is_special(path);
  std::string const target = in_place ? path : temporary_path(path);
  int const file = open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) cannot_write(path);
  try {
    write_all(file, text, path);
    if (!in_place && fsync(file) != 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  } catch (...) {
    close(file);
    if (!in_place) unlink(target.c_str());
    throw;
  }
  close(file);
  if (!in_place && std::rename(target.c_str(), path.c_str()) != 0) {
    int const error = errno;
    unlink(target.c_str());
    errno = error;
    cannot_write(path);
  }
}

}  // namespace sphverify
