// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "harness/study/fingerprint.hpp"
#include "harness/study/same_run.hpp"
#include "reports/json/parse.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

constexpr char const* schema = "sphverify-journal/1";

/// Where the last whole line ends; what follows was cut short.
std::size_t whole_lines(std::string const& text) {
  std::size_t const last = text.rfind('\n');
  return last == std::string::npos ? 0 : last + 1;
}

/// Opens a journal for this process alone.
OpenFile open_for_one(std::string const& path) {
  OpenFile file(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (file < 0) {
    throw UserError(path, "", std::string("a place that cannot be written (") + std::strerror(errno) + ")",
                    "room for the journal beside the results");
  }
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    throw UserError(path, "", "a study that is still running", "one study at a time for these results");
  }
  return file;
}

}  // namespace

Journal::Journal(std::string path, Json const& study, bool resume) : path_(std::move(path)) {
  file_ = open_for_one(path_);
  if (!resume && lseek(file_, 0, SEEK_END) > 0) {
    // Starting afresh was asked for, but another run's hours may be in there.
    std::string const kept = path_ + ".old";
    if (std::rename(path_.c_str(), kept.c_str()) != 0)
      throw std::runtime_error(kept + ": " + std::strerror(errno));
    fmt::print(stderr, "{}: starting afresh; the journal found there is kept as {}\n", path_, kept);
    file_ = open_for_one(path_);
  }
  std::string const build = fingerprint(study.value("plugins", std::vector<std::string>()));
  std::string text;
  if (resume) {
    std::ifstream old(path_, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(old), {});
    text.resize(whole_lines(text));
  }
  for (std::size_t start = 0; start < text.size();) {
    std::size_t const end = text.find('\n', start);
    auto const parsed = parse_json(std::string_view(text).substr(start, end - start));
    if (start > 0 && !parsed) throw UserError(path_, "", "a damaged line", "one finished run");
    Json const line = parsed.value_or(Json());
    auto const says = [&](char const* key, Json const& value) { return line.contains(key) && line.at(key) == value; };
    if (start == 0 && !says("schema", schema)) throw UserError(path_, "", "something else", "the journal of a study");
    if (start == 0 && !says("study", study)) {
      throw UserError(path_, "study", "the journal of another study",
                      "this one's: resume with the same document and part, or without --resume to start afresh");
    }
    if (start == 0 && !says("build", build)) {
      throw UserError(path_, "build", "the journal of another build of the program or of a plug-in",
                      "this one's: finish it with the build that began it, or start afresh without --resume");
    }
    if (start > 0) read_line(line);
    start = end + 1;
  }
  if (ftruncate(file_, static_cast<off_t>(text.size())) != 0 || lseek(file_, 0, SEEK_END) < 0) {
    throw std::runtime_error(path_ + ": " + std::strerror(errno));
  }
  if (text.empty()) write_lines(Json{{"schema", schema}, {"build", build}, {"study", study}}.dump() + "\n");
}

void Journal::read_line(Json const& line) {
  Node const node(line, path_);
  auto const index = static_cast<std::size_t>(node.at("run").integer(0, 1'000'000'000));
  if (auto const cost = node.find("cost")) {
    auto const measured = awaiting_.find(index);
    if (measured == awaiting_.end())
      throw UserError(path_, "run", std::to_string(index), "a run that awaits its timing");
    put_cost(measured->second, cost->is_null() ? std::nullopt : std::optional(read_cost(*cost)));
    finished_[index] = measured->second.record;
    awaiting_.erase(measured);
    return;
  }
  RunRecord record = read_run(node.at("record"));
  if (auto const awaits = node.find("awaits_timing"); awaits && awaits->boolean()) {
    awaiting_[index] = {std::move(record), true, node.at("spent_seconds").number_between(0.0, 1e100)};
  } else {
    finished_[index] = std::move(record);
  }
}

void Journal::require_same(std::size_t index, RunSpec const& spec) const {
  auto const finished = finished_.find(index);
  auto const awaits = awaiting_.find(index);
  if (finished == finished_.end() && awaits == awaiting_.end()) return;
  RunRecord const& r = finished == finished_.end() ? awaits->second.record : finished->second;
  if (is_of(r, spec)) return;
  throw UserError(
      path_, fmt::format("run {}", index),
      fmt::format("a record of another run, {} on {} at resolution {}", r.label, r.case_id, r.resolution),
      fmt::format("that of {} on {} at resolution {}, with its parameters and discretisation; without "
                  "--resume the study starts afresh",
                  spec.label, spec.scene_case->info.id, spec.resolution));
}

void Journal::write_lines(std::string const& lines) {
  // Another thread's line must not follow half of one.
  if (is_cut_) throw std::runtime_error(path_ + ": a line could not be written, and none may follow it");
  off_t const before = lseek(file_, 0, SEEK_CUR);
  std::size_t written = 0;
  while (written < lines.size()) {
    ssize_t const n = write(file_, lines.data() + written, lines.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      int const error = errno;
      is_cut_ = before < 0 || ftruncate(file_, before) != 0 || lseek(file_, before, SEEK_SET) < 0;
      throw std::runtime_error(path_ + ": " + std::strerror(error));
    }
    written += static_cast<std::size_t>(n);
  }
}

void Journal::append(std::size_t index, RunRecord const& run) {
  std::string const line = Json{{"run", index}, {"record", to_json(run)}}.dump() + "\n";
  std::scoped_lock const lock(mutex_);
  write_lines(line);
}

void Journal::append(std::map<std::size_t, RunRecord> const& runs) {
  std::string lines;
  for (auto const& [index, run] : runs) lines += Json{{"run", index}, {"record", to_json(run)}}.dump() + "\n";
  std::scoped_lock const lock(mutex_);
  write_lines(lines);
}

void Journal::append(std::size_t index, MeasuredRun const& run) {
  std::string const line = Json{{"run", index},
                                {"record", to_json(run.record)},
                                {"awaits_timing", true},
                                {"spent_seconds", run.spent_seconds}}
                               .dump() +
                           "\n";
  std::scoped_lock const lock(mutex_);
  write_lines(line);
}

void Journal::append(std::map<std::size_t, std::optional<Cost>> const& costs) {
  std::string lines;
  for (auto const& [index, cost] : costs)
    lines += Json{{"run", index}, {"cost", cost ? to_json(*cost) : Json(nullptr)}}.dump() + "\n";
  std::scoped_lock const lock(mutex_);
  write_lines(lines);
}

void Journal::remove() { unlink(path_.c_str()); }

}  // namespace sphverify
