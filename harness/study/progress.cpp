#include "harness/study/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sphverify {

namespace {
constexpr std::size_t bar_width = 30;
constexpr std::chrono::seconds line_interval{5};
}  // namespace

Progress::Progress(std::size_t total, std::size_t done)
    : total_(total),
      done_(done),
      done_before_(done),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_line_(start_) {
  fmt::print(stderr, "{} runs{}\n", total, done > 0 ? fmt::format(", {} of them done before", done) : "");
}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::finished(std::string const& what) {
  std::scoped_lock const lock(mutex_);
  ++done_;
  auto const now = std::chrono::steady_clock::now();
  // A terminal is redrawn ten times a second at most: thousands of short runs must not wait for it.
  auto const interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(line_interval);
  if (done_ < total_ && now - last_line_ < interval) return;
  last_line_ = now;
  draw(what);
}

void Progress::draw(std::string const& what) {
  double const elapsed = std::chrono::duration<double>(last_line_ - start_).count();
  double const left =
      elapsed / static_cast<double>(done_ - done_before_) * static_cast<double>(total_ - done_);
  if (terminal_) {
    std::size_t const filled = bar_width * done_ / std::max<std::size_t>(total_, 1);
    fmt::print(stderr, "\r[{:=<{}}{: <{}}] {}/{}  {:.0f} s left  {:.50}\x1b[K", "", filled, "",
               bar_width - filled, done_, total_, left, what);
  } else {
    fmt::print(stderr, "{}/{} runs, {:.0f} s, about {:.0f} s left\n", done_, total_, elapsed, left);
  }
  std::fflush(stderr);
}

}  // namespace sphverify
