// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "harness/terminal.hpp"

namespace sphverify {

namespace {
constexpr std::size_t bar_width = 30;
constexpr double shortest_silence = 5.0, longest_silence = 600.0;  // of a log [s]
constexpr double part_of_all = 0.05;                               // a day is some 250 lines
// A terminal is redrawn ten times a second at most: thousands of short runs must not wait for it.
constexpr double shortest_frame = 0.1, longest_frame = 1.0;

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

double seconds_between_lines(double seconds_so_far) {
  return std::clamp(part_of_all * seconds_so_far, shortest_silence, longest_silence);
}

Progress::Progress(std::vector<RunProgress> runs, int at_a_time)
    : runs_(std::move(runs)),
      started_(runs_.size()),
      at_a_time_(at_a_time),
      done_(static_cast<std::size_t>(std::count_if(
          runs_.begin(), runs_.end(),
          [](RunProgress const& run) { return run.state == RunProgress::State::finished_before; }))),
      terminal_(can_redraw(STDERR_FILENO)),
      start_(std::chrono::steady_clock::now()),
      last_line_(start_) {
  fmt::print(stderr, "{} runs{}\n", runs_.size(),
             done_ > 0 ? fmt::format(", {} of them done before", done_) : "");
}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::started(std::size_t run) {
  std::scoped_lock const lock(mutex_);
  runs_[run].state = RunProgress::State::running;
  started_[run] = std::chrono::steady_clock::now();
}

void Progress::paused(std::size_t run) {
  std::scoped_lock const lock(mutex_);
  if (runs_[run].state != RunProgress::State::running) return;  // the others were there already
  runs_[run].state = RunProgress::State::paused;
  runs_[run].seconds = seconds_between(started_[run], std::chrono::steady_clock::now());
}

void Progress::finished(std::size_t run, std::string const& what, double more_seconds) {
  std::scoped_lock const lock(mutex_);
  ++done_;
  auto const now = std::chrono::steady_clock::now();
  bool const was_paused = runs_[run].state == RunProgress::State::paused;
  runs_[run].state = RunProgress::State::finished;
  runs_[run].seconds = was_paused ? runs_[run].seconds + more_seconds : seconds_between(started_[run], now);
  last_ = what;
  double const silence = terminal_ ? shortest_frame : seconds_between_lines(seconds_between(start_, now));
  if (done_ < runs_.size() && seconds_between(last_line_, now) < silence) return;
  last_line_ = now;
  draw();
}

void Progress::passed() {
  std::scoped_lock const lock(mutex_);
  auto const now = std::chrono::steady_clock::now();
  double const silence = terminal_ ? longest_frame : seconds_between_lines(seconds_between(start_, now));
  if (done_ == runs_.size() || seconds_between(last_line_, now) < silence) return;
  last_line_ = now;
  draw();
}

void Progress::draw() {
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    if (runs_[k].state == RunProgress::State::running)
      runs_[k].seconds = seconds_between(started_[k], last_line_);
  }
  std::optional<double> const left = seconds_left(runs_, at_a_time_);
  std::string const rest = left && done_ < runs_.size() ? duration_text(*left) + " left" : "";
  if (terminal_) {
    std::size_t const filled = bar_width * done_ / std::max<std::size_t>(runs_.size(), 1);
    std::string const line = fmt::format("[{:=<{}}{: <{}}] {}/{}  {}  {:.50}", "", filled, "",
                                         bar_width - filled, done_, runs_.size(), rest, last_);
    // A line that is broken cannot be drawn over.
    fmt::print(stderr, "\r{:.{}}\x1b[K", line, known_columns().value_or(usual_columns) - 1);
  } else {
    fmt::print(stderr, "{}/{} runs ({}%), {}{}\n", done_, runs_.size(), 100 * done_ / std::max<std::size_t>(runs_.size(), 1),
               duration_text(seconds_between(start_, last_line_)), rest.empty() ? "" : ", about " + rest);
  }
  std::fflush(stderr);
}

}  // namespace sphverify
