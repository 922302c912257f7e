// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <thread>

#include "formulations/basics/expects.hpp"
#include "formulations/plugins/crash_guard.hpp"
#include "harness/study/carry_out.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

bool is_interrupted(SharedStudy const& shared) { return shared.options.interrupted && *shared.options.interrupted; }

/// In the process that is made for it.
void carry_out_asked(Json const& asked, SharedStudy const& shared, LineChannel& out) {
  StudyUnit unit;
  for (Json const& run : asked.at("unit")) {
    unit.runs.push_back(run.get<std::size_t>());
    expects(unit.runs.back() < shared.specs.size());
  }
  std::map<std::size_t, RunRecord> known;
  for (Json const& entry : asked.at("known")) known[entry.at(0).get<std::size_t>()] = read_run(Node(entry.at(1), "known"));
  RunOptions options = shared.options;
  options.threads = asked.at("threads").get<int>();
  RunsTold const told{[&](std::size_t place, RunSpec const&) -> std::optional<RunRecord> {
                        auto const found = known.find(place);
                        return found == known.end() ? std::nullopt : std::optional(found->second);
                      },
                      [&](std::size_t place) { out.send({{"started", place}}); },
                      [&](std::size_t place, RunRecord const& record) {
                        out.send({{"run", place}, {"record", to_json(record)}});
                      }};
  try {
    carry_out(shared.study, shared.specs, unit, options, told);
    out.send({{"done", true}});
  } catch (Interrupted const&) {
    out.send({{"leaving", true}});
  } catch (std::bad_alloc const&) {
    out.send({{"crashed", "out of memory"}});
  } catch (std::exception const& error) {
    out.send({{"crashed", error.what()}});
  }
}

std::string signal_text(int signal) {
  char const* const name = sigabbrev_np(signal);
  return fmt::format("SIG{} ({})", name ? name : std::to_string(signal), sigdescr_np(signal) ? sigdescr_np(signal) : "unknown");
}

/// A process that carries out a unit, and the end of the pipe that it tells of it.
struct UnitProcess {
  pid_t pid;
  LineChannel told;
};

UnitProcess start(Json const& asked, SharedStudy const& shared) {
  std::array<int, 2> ends{};
  // A code that the run starts must not keep it open.
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe to a run: ") + std::strerror(errno));
  OpenFile from(ends[0]);
  OpenFile to(ends[1]);
  pid_t const parent = getpid();
  pid_t const pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("no process for a run: ") + std::strerror(errno));
  if (pid > 0) return {pid, LineChannel(std::move(from))};
  // A run whose worker is gone works for nobody.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  let_signals_kill();
  LineChannel out(std::move(to));
  carry_out_asked(asked, shared, out);
  _exit(0);
}

/// Passes on what a unit's process tells. False if nobody wants to know it any more.
bool pass_on(UnitProcess& process, LineChannel& channel, SharedStudy const& shared) {
  // Rank 0 answers the last word with the next unit: it is passed on when the process is gone.
  std::optional<Json> last;
  while (true) {
    // While a unit is at work rank 0 says nothing but that it is over.
    std::array<pollfd, 2> waits{{{process.told.file(), POLLIN, 0}, {channel.file(), POLLIN | POLLRDHUP, 0}}};
    bool const is_told = poll(waits.data(), waits.size(), -1) >= 0;
    if (is_interrupted(shared) || (!is_told && errno != EINTR)) return false;
    if (!is_told) continue;
    if (waits[1].revents != 0) return false;
    if (!process.told.receive()) break;
    while (auto const line = process.told.next()) {
      if (!line->contains("started") && !line->contains("run")) {
        last = line;
      } else if (!channel.send(*line)) {
        return false;
      }
    }
  }
  int status = 0;
  waitpid(process.pid, &status, 0);
  process.pid = -1;
  if (last) return channel.send(*last);
  std::string const why = WIFSIGNALED(status) ? "its process ended by " + signal_text(WTERMSIG(status))
                                              : fmt::format("its process ended with status {}", WEXITSTATUS(status));
  return channel.send({{"crashed", why}});
}

/// Ends a process in time for it to put away what it began: at once by a signal, unless that has reached it anyway.
void end(UnitProcess const& process, bool has_been_told) {
  using namespace std::chrono_literals;
  auto const is_gone = [&](std::chrono::milliseconds patience) {
    for (auto const start = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - start < patience;) {
      if (waitpid(process.pid, nullptr, WNOHANG) != 0) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  };
  // A second signal of one kind kills: who heard the first is given time.
  if (has_been_told && is_gone(3000ms)) return;
  kill(process.pid, SIGTERM);
  if (is_gone(3000ms)) return;
  kill(process.pid, SIGKILL);
  waitpid(process.pid, nullptr, 0);
}

}  // namespace

void work(LineChannel& channel, SharedStudy const& shared) {
  while (!is_interrupted(shared)) {
    auto const asked = channel.wait();
    if (!asked || !asked->contains("unit")) break;
    UnitProcess process = start(*asked, shared);
    bool const goes_on = pass_on(process, channel, shared);
    if (process.pid > 0) end(process, is_interrupted(shared));
    if (!goes_on) break;
  }
  if (is_interrupted(shared)) {
    channel.send({{"leaving", true}});
    throw Interrupted();
  }
}

}  // namespace sphverify
