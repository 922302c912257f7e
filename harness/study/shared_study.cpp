// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/shared_study.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <list>
#include <set>
#include <stdexcept>
#include <utility>

#include "harness/measure/machine.hpp"
#include "harness/study/meeting_place.hpp"
#include "harness/study/same_run.hpp"
#include "harness/study/worker.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int most_tries = 2;
constexpr int most_early_deaths = 5;
constexpr std::size_t longest_greeting = 1 << 20;
constexpr std::chrono::seconds wait_for_late_ranks{10};
constexpr std::chrono::seconds wait_for_greeting{10};

/// A worker, as rank 0 sees it.
struct Worker {
  LineChannel channel;
  pid_t pid = -1;  ///< of one of rank 0's own; -1: of another rank
  bool is_greeted = false;
  Clock::time_point since = Clock::now();
  int rank = 0;
  std::string machine{};
  int cores = 1;
  std::optional<StudyUnit> unit{};       ///< what it carries out
  std::optional<std::size_t> started{};  ///< the run that it is at, by place
  std::map<std::size_t, RunRecord> held{};  ///< runs of a unit that are kept together or not at all
};

class Coordinator {
 public:
  Coordinator(SharedStudy const& shared, Rank const& rank, Journal& journal, Progress& progress)
      : shared_(shared), rank_(rank), journal_(journal), progress_(progress), meeting_place_(shared.results, rank) {
    finished_ = journal.finished();
    for (StudyUnit unit : study_units(shared.study, shared.specs)) {
      // A search is gone through again, with what is known of it.
      if (!shared.study.envelope) std::erase_if(unit.runs, [&](std::size_t k) { return finished_.contains(k); });
      if (!unit.runs.empty()) waiting_.push_back(std::move(unit));
    }
    std::stable_sort(waiting_.begin(), waiting_.end(), [](StudyUnit const& a, StudyUnit const& b) { return a.work > b.work; });
    ranks_.insert(0);
    // Each worker is an open file.
    rlimit files{};
    if (getrlimit(RLIMIT_NOFILE, &files) == 0) {
      files.rlim_cur = files.rlim_max;
      setrlimit(RLIMIT_NOFILE, &files);
    }
  }

  std::map<std::size_t, RunRecord> run() {
    for (int k = 0; k < shared_.workers; ++k) start_own();
    while (is_open()) {
      require_not_interrupted();
      look_around();
    }
    // A rank that finds nobody would wait for long.
    for (auto const start = Clock::now(); is_late() && Clock::now() - start < wait_for_late_ranks;) {
      require_not_interrupted();
      look_around();
    }
    end_all();
    if (ranks_.size() < static_cast<std::size_t>(rank_.of))
      fmt::print(stderr, "of {} ranks {} took part: the others did not find {}.ranks in time, or ended\n", rank_.of, ranks_.size(),
                 shared_.results);
    return std::move(finished_);
  }

 private:
  bool is_open() const {
    return !waiting_.empty() || std::any_of(workers_.begin(), workers_.end(), [](Worker const& w) { return w.unit.has_value(); });
  }
  bool is_late() const { return greetings_ < (rank_.of - 1) * shared_.workers; }

  void require_not_interrupted() {
    if (!shared_.options.interrupted || !*shared_.options.interrupted) return;
    end_all();
    throw Interrupted();
  }

  /// Makes a process that works as those of other ranks do. This one has a single thread till then.
  void start_own() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error(std::string("no socket to a worker: ") + std::strerror(errno));
    OpenFile ours(ends[0]);
    OpenFile theirs(ends[1]);
    pid_t const parent = getpid();
    pid_t const pid = fork();
    if (pid < 0) throw std::runtime_error(std::string("no process for a worker: ") + std::strerror(errno));
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(1);
      // Nothing but its own end: what it held of the journal and of others would stay open after rank 0.
      constexpr int kept = 3;
      // A code that a run starts must not keep it open.
      if (dup2(theirs, kept) != kept || fcntl(kept, F_SETFD, FD_CLOEXEC) != 0) _exit(1);
      closefrom(kept + 1);
      LineChannel channel{OpenFile(kept)};
      try {
        work(channel, shared_);
      } catch (...) {
        _exit(1);
      }
      _exit(0);
    }
    workers_.push_back({.channel = LineChannel(std::move(ours)), .pid = pid, .is_greeted = true, .machine = machine_name(), .cores = own_cores()});
    give(workers_.back());
  }

  /// Waits for whatever comes next, at most a second.
  void look_around() {
    progress_.passed();
    std::vector<pollfd> waits{{meeting_place_.file(), POLLIN, 0}};
    for (Worker const& worker : workers_) waits.push_back({worker.channel.file(), POLLIN, 0});
    if (poll(waits.data(), waits.size(), 1000) < 0) return;
    auto worker = workers_.begin();
    for (std::size_t n = 1; n < waits.size(); ++n) {
      auto const here = worker++;
      bool const is_silent = !here->is_greeted && Clock::now() - here->since > wait_for_greeting;
      if (!is_silent && (waits[n].revents == 0 || hear(*here))) continue;
      if (here->pid > 0) waitpid(here->pid, nullptr, 0);
      workers_.erase(here);
    }
    while (!waiting_.empty() && std::count_if(workers_.begin(), workers_.end(), [](Worker const& w) { return w.pid > 0; }) < shared_.workers)
      start_own();
    if (waits[0].revents & POLLIN) {
      if (auto channel = meeting_place_.accept()) workers_.push_back({.channel = std::move(*channel)});
    }
    for (Worker& idle : workers_) give(idle);
  }

  /// Everything that a worker says. False: it is gone, or is none of ours.
  bool hear(Worker& worker) {
    bool const is_there = worker.channel.receive();
    if (!worker.is_greeted && worker.channel.unread() > longest_greeting) return false;
    while (auto const line = worker.channel.next()) {
      if (!worker.is_greeted) {
        if (!meeting_place_.is_ours(*line) || !greet(worker, *line)) return false;
      } else if (line->contains("leaving")) {
        give_back(worker);
        return false;
      } else {
        note(worker, *line);
      }
    }
    if (is_there) return true;
    if (worker.unit && worker.started) {
      crashed(worker, worker.pid > 0 ? "the process that worked for rank 0 was lost" : "the rank that ran it was lost");
    } else if (worker.unit) {
      // It had not begun: no run is to blame.
      give_back(worker);
      if (worker.pid > 0 && ++early_deaths_ > most_early_deaths)
        throw std::runtime_error("workers of rank 0 end before they begin a run");
    }
    return false;
  }

  /// Who knows the key is one of ours, but may have been made otherwise.
  bool greet(Worker& worker, Json const& greeting) {
    worker.rank = greeting.value("rank", 0);
    if (greeting.value("identity", "") != shared_.identity) {
      worker.channel.send({{"refused", true}});
      return false;
    }
    worker.is_greeted = true;
    worker.machine = greeting.value("machine", "");
    worker.cores = std::max(1, greeting.value("cores", 1));
    ranks_.insert(worker.rank);
    ++greetings_;
    worker.channel.send({{"welcome", true}});
    return true;
  }

  void note(Worker& worker, Json const& line) {
    if (!worker.unit) return;
    if (line.contains("started")) {
      worker.started = line.at("started").get<std::size_t>();
      if (!shared_.study.envelope) progress_.started(*worker.started);
    } else if (line.contains("run")) {
      take(worker, line.at("run").get<std::size_t>(), read_run(Node(line.at("record"), "a run of another rank")));
    } else if (line.contains("done")) {
      if (!worker.held.empty()) {
        journal_.append(worker.held);
        for (auto& [place, record] : std::exchange(worker.held, {})) put(place, std::move(record));
      }
      done(*worker.unit);
      worker.unit.reset();
      worker.started.reset();
    } else if (line.contains("crashed")) {
      crashed(worker, line.at("crashed").get<std::string>());
    }
  }

  /// Runs that were timed in turn are finished together or not at all.
  void take(Worker& worker, std::size_t place, RunRecord record) {
    if (!shared_.study.envelope && !is_of(record, shared_.specs.at(place)))
      throw std::runtime_error(fmt::format("rank {} told of another run than it was given", worker.rank));
    if (!shared_.study.envelope && worker.unit->runs.size() > 1) {
      worker.held[place] = std::move(record);
    } else {
      finish(place, std::move(record));
    }
  }

  void finish(std::size_t place, RunRecord record) {
    journal_.append(place, record);
    put(place, std::move(record));
  }

  void put(std::size_t place, RunRecord record) {
    if (!shared_.study.envelope) progress_.finished(place, record.label);
    finished_[place] = std::move(record);
  }

  void done(StudyUnit const& unit) {
    if (!shared_.study.envelope) return;
    for (std::size_t const k : unit.runs) progress_.finished(k, shared_.specs[k].label);
  }

  /// What a unit is left with when the process or the rank that was at it is gone.
  void crashed(Worker& worker, std::string const& why) {
    StudyUnit unit = std::move(*worker.unit);
    std::size_t const place = worker.started ? *worker.started : first_open(unit);
    worker.unit.reset();
    worker.started.reset();
    worker.held.clear();
    if (++tries_[place] >= most_tries) {
      RunRecord record = begun_record(next_of(unit, place));
      record.status = "crashed";
      record.reason = fmt::format("{}, {} times", why, most_tries);
      finish(place, std::move(record));
    }
    if (!shared_.study.envelope) std::erase_if(unit.runs, [&](std::size_t k) { return finished_.contains(k); });
    if (!unit.runs.empty()) waiting_.push_front(std::move(unit));
  }

  /// The place of the first run of a unit that is not there yet.
  std::size_t first_open(StudyUnit const& unit) const {
    if (!shared_.study.envelope) return unit.runs.front();
    std::size_t place = journal_place(shared_.study, unit.runs.front());
    while (finished_.contains(place)) ++place;
    return place;
  }

  /// The run that a unit is at: of a search, at the first value that was not tried; those before must be its own.
  RunSpec next_of(StudyUnit const& unit, std::size_t place) const {
    if (!shared_.study.envelope) return shared_.specs[place];
    std::size_t const first = journal_place(shared_.study, unit.runs.front());
    RunSpec const& spec = shared_.specs[unit.runs.front()];
    std::optional<RunSpec> next;
    struct Reached {};
    try {
      find_envelope(spec, *shared_.study.envelope, [&](RunSpec const& one, int step) -> RunRecord {
        std::size_t const at = first + static_cast<std::size_t>(step);
        journal_.require_same(at, one);
        if (finished_.contains(at)) return finished_.at(at);
        next = one;
        throw Reached();
      });
    } catch (Reached const&) {
    }
    return next.value_or(spec);
  }

  /// A worker that was asked to stop has not failed.
  void give_back(Worker& worker) {
    if (!worker.unit) return;
    StudyUnit unit = std::move(*worker.unit);
    worker.unit.reset();
    worker.held.clear();
    if (!shared_.study.envelope) std::erase_if(unit.runs, [&](std::size_t k) { return finished_.contains(k); });
    if (!unit.runs.empty()) waiting_.push_front(std::move(unit));
  }

  void give(Worker& worker) {
    if (!worker.is_greeted || worker.unit || waiting_.empty()) return;
    StudyUnit unit = std::move(waiting_.front());
    waiting_.pop_front();
    Json known = Json::array();
    if (shared_.study.envelope) {
      std::size_t const first = journal_place(shared_.study, unit.runs.front());
      std::size_t const end = journal_place(shared_.study, unit.runs.front() + 1);
      next_of(unit, first);
      for (auto one = finished_.lower_bound(first); one != finished_.end() && one->first < end; ++one)
        known.push_back({one->first, to_json(one->second)});
      progress_.started(unit.runs.front());
    }
    int const threads = threads_for(worker);
    bool const is_sent = worker.channel.send({{"unit", unit.runs}, {"threads", threads}, {"known", known}});
    worker.unit = std::move(unit);
    if (!is_sent) give_back(worker);  // its end is noticed next
  }

  /// Of a machine with more workers than there are units left each unit has its share of the cores.
  int threads_for(Worker const& worker) const {
    int const asked = shared_.options.threads;
    if (shared_.options.measure.contains(Measure::cost)) return asked;
    auto const at_work = static_cast<std::size_t>(
        std::count_if(workers_.begin(), workers_.end(), [](Worker const& w) { return w.unit.has_value(); }));
    std::size_t const left = waiting_.size() + at_work + 1;
    auto const here = static_cast<std::size_t>(
        std::count_if(workers_.begin(), workers_.end(), [&](Worker const& w) { return w.machine == worker.machine; }));
    return std::max(asked, std::min(worker.cores, asked * static_cast<int>(here / left)));
  }

  void end_all() {
    for (Worker& worker : workers_) {
      worker.channel.send({{"end", true}});
    }
    for (Worker& worker : workers_) {
      if (worker.pid > 0) waitpid(worker.pid, nullptr, 0);
    }
    workers_.clear();
  }

  SharedStudy const& shared_;
  Rank const& rank_;
  Journal& journal_;
  Progress& progress_;
  MeetingPlace meeting_place_;
  std::deque<StudyUnit> waiting_;  ///< the next first
  std::list<Worker> workers_;
  std::set<int> ranks_;  ///< that took part
  int greetings_ = 0;    ///< of workers of other ranks
  int early_deaths_ = 0;
  std::map<std::size_t, int> tries_;
  std::map<std::size_t, RunRecord> finished_;
};

}  // namespace

std::map<std::size_t, RunRecord> share_study(SharedStudy const& shared, Rank const& rank, Journal& journal, Progress& progress) {
  return Coordinator(shared, rank, journal, progress).run();
}

void work_for_rank_0(SharedStudy const& shared, Rank const& rank) {
  // Each worker of the rank is a process with a channel of its own.
  std::vector<pid_t> others;
  for (int k = 1; k < shared.workers; ++k) {
    pid_t const pid = fork();
    if (pid < 0) throw std::runtime_error(std::string("no process for a worker: ") + std::strerror(errno));
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      others.clear();
      break;
    }
    others.push_back(pid);
  }
  Json const greeting{{"rank", rank.number}, {"machine", machine_name()}, {"cores", own_cores()}, {"identity", shared.identity}};
  auto channel = find_rank_0(shared.results, rank, greeting, shared.options.interrupted);
  if (channel) work(*channel, shared);
  // Who has not found rank 0 by now never will.
  for (pid_t const pid : others) kill(pid, SIGTERM);
  for (pid_t const pid : others) waitpid(pid, nullptr, 0);
  if (!channel) throw std::runtime_error(fmt::format("rank {} did not find rank 0 by {}.ranks", rank.number, shared.results));
}

}  // namespace sphverify
