// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/child_process.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "harness/run/clock.hpp"

extern char** environ;

namespace sphverify {

namespace {

constexpr char const* mark_name = "SPHVERIFY_RUN";
constexpr int patience_ms = 50;            // between looks at budgets
constexpr int rounds_between_sizes = 10;   // of those, until what was written is counted again

std::string new_mark() {
  std::random_device source;
  return fmt::format("{}-{:08x}{:08x}", getpid(), source(), source());
}

std::string text_of(pid_t pid, char const* file) {
  std::ifstream stream(fmt::format("/proc/{}/{}", pid, file), std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

/// All processes but ours that fit.
std::vector<pid_t> processes(auto const& fits) {
  std::vector<pid_t> found;
  DIR* const folder = opendir("/proc");
  if (folder == nullptr) return found;
  while (dirent const* const one = readdir(folder)) {
    char* end = nullptr;
    auto const pid = static_cast<pid_t>(std::strtol(one->d_name, &end, 10));
    if (end == one->d_name || *end != '\0' || pid == getpid()) continue;
    if (fits(pid)) found.push_back(pid);
  }
  closedir(folder);
  return found;
}

/// Those whose environment has the mark.
std::vector<pid_t> marked(std::string const& mark) {
  std::string const entry = fmt::format("{}={}", mark_name, mark);
  return processes([&](pid_t pid) { return text_of(pid, "environ").find(entry) != std::string::npos; });
}

/// "pid (name) state parent ...", whatever the name holds.
pid_t parent_of(pid_t pid) {
  std::string const text = text_of(pid, "stat");
  std::size_t const name = text.rfind(')');
  if (name == std::string::npos || name + 4 >= text.size()) return 0;
  return static_cast<pid_t>(std::strtol(text.c_str() + name + 4, nullptr, 10));
}

/// Commands under way. The system hands us what they leave behind: when none of them is left, whatever then is a child of ours
/// is an orphan of one of them, even if it has given up its group and its environment.
class Commands {
 public:
  /// Children that we have had from the start, of a shell that became this program, are nobody's orphans.
  Commands() : before_(children()) {}

  std::mutex& mutex() { return mutex_; }
  void add(pid_t pid) { running_.insert(pid); }

  void remove(pid_t pid) {
    std::scoped_lock const lock(mutex_);
    running_.erase(pid);
    if (!running_.empty()) return;
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<pid_t> orphans = children();
      std::erase_if(orphans, [&](pid_t one) { return std::find(before_.begin(), before_.end(), one) != before_.end(); });
      if (orphans.empty()) return;
      for (pid_t const orphan : orphans) {
        kill(orphan, SIGKILL);
        waitpid(orphan, nullptr, 0);
      }
    }
  }

 private:
  static std::vector<pid_t> children() {
    return processes([](pid_t one) { return parent_of(one) == getpid(); });
  }

  static constexpr int most_rounds = 100;
  std::vector<pid_t> before_;
  std::mutex mutex_;
  std::set<pid_t> running_;
};

Commands& commands() {
  static Commands all;
  return all;
}

/// Ends a group and all that has left it; looks again, since what is looked for may be multiplying.
void end_all(pid_t group, std::string const& mark) {
  kill(-group, SIGKILL);
  for (int round = 0; round < 100; ++round) {
    auto const left = marked(mark);
    if (left.empty()) return;
    for (pid_t const pid : left) kill(pid, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std::uint64_t bytes_in(std::string const& folder) {
  std::uint64_t sum = 0;
  std::error_code ignored;
  using Walk = std::filesystem::recursive_directory_iterator;
  for (Walk at(folder, ignored), end; at != end; at.increment(ignored)) {
    if (at->is_regular_file(ignored) && !at->is_symlink(ignored)) {
      std::uintmax_t const size = at->file_size(ignored);
      if (size != static_cast<std::uintmax_t>(-1)) sum += size;
    }
  }
  return sum;
}

/// Texts as the system wants them: pointers, and none at the end.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::vector<std::string> environment_of(ChildCommand const& command, std::string const& mark) {
  std::map<std::string, std::string> all;
  for (char** one = environ; *one != nullptr; ++one) {
    std::string const text = *one;
    std::size_t const equals = text.find('=');
    if (equals != std::string::npos) all[text.substr(0, equals)] = text.substr(equals + 1);
  }
  for (auto const& [name, value] : command.environment) all[name] = value;
  all[mark_name] = mark;
  std::vector<std::string> texts;
  for (auto const& [name, value] : all) texts.push_back(name + "=" + value);
  return texts;
}

/// Of everything that is open beside the three usual ones: files that other threads had open would stay so in the command, and
/// locked.
void close_on_exec() {
  constexpr unsigned first = 3;
  constexpr unsigned cloexec = 4;  // CLOSE_RANGE_CLOEXEC, which old headers lack
  if (syscall(SYS_close_range, first, ~0U, cloexec) == 0) return;
  rlimit most{};
  getrlimit(RLIMIT_NOFILE, &most);
  for (rlim_t k = first; k < std::min<rlim_t>(most.rlim_cur, 65536); ++k) fcntl(static_cast<int>(k), F_SETFD, FD_CLOEXEC);
}

/// In the child, between fork and exec, where only system calls are safe: other threads may have held any lock.
[[noreturn]] void become(char* const* words, char* const* environment, char const* folder, int output, int failure,
                         rlim_t file_size, pid_t parent) {
  int error = 0;
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  int const nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  rlimit const limit{file_size, file_size};
  if (file_size > 0) setrlimit(RLIMIT_FSIZE, &limit);
  if (chdir(folder) == 0 && dup2(nothing, 0) >= 0 && dup2(output, 1) >= 0 && dup2(output, 2) >= 0) {
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    close_on_exec();
    for (int const signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaction(signal, &usual, nullptr);
    execvpe(words[0], words, environment);
  }
  error = errno;
  [[maybe_unused]] ssize_t const told = write(failure, &error, sizeof error);
  _exit(127);
}

/// A descriptor that can be read once the process has ended; -1 where the system has none.
int ending_of(pid_t pid) { return static_cast<int>(syscall(SYS_pidfd_open, pid, 0)); }

/// Waits for the end, or the time until the next look at the budgets.
void wait_a_moment(int ending) {
  if (ending < 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return;
  }
  pollfd one{ending, POLLIN, 0};
  poll(&one, 1, patience_ms);
}

}  // namespace

ChildOutcome run_child(ChildCommand const& command) {
  using End = ChildOutcome::End;
  // Whoever started us may have told the system to forget children at once: their status would be lost.
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &usual, nullptr);
    commands();  // notes whose children there are
    prctl(PR_SET_CHILD_SUBREAPER, 1);
  });
  std::string const mark = new_mark();
  std::vector<std::string> words = command.words;
  std::vector<std::string> environment = environment_of(command, mark);
  std::vector<char*> const word_pointers = pointers(words);
  std::vector<char*> const environment_pointers = pointers(environment);
  int failure[2];
  if (pipe2(failure, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
  int const output = open(command.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (output < 0) {
    std::string const why = std::strerror(errno);
    close(failure[0]);
    close(failure[1]);
    throw std::runtime_error(fmt::format("{}: {}", command.output, why));
  }

  Clock const clock;
  pid_t const parent = getpid();
  pid_t pid = -1;
  {
    std::scoped_lock const lock(commands().mutex());
    pid = fork();
    if (pid == 0)
      become(word_pointers.data(), environment_pointers.data(), command.folder.c_str(), output, failure[1],
             static_cast<rlim_t>(command.bytes), parent);
    if (pid > 0) commands().add(pid);
  }
  close(failure[1]);
  close(output);
  if (pid < 0) {
    close(failure[0]);
    throw std::runtime_error("no process can be made");
  }
  setpgid(pid, pid);  // whoever of the two comes first
  int error = 0;
  bool const has_started = read(failure[0], &error, sizeof error) != static_cast<ssize_t>(sizeof error);
  close(failure[0]);

  int const ending = ending_of(pid);
  ChildOutcome outcome;
  rusage used{};
  int status = 0;
  End cut = End::exited;
  for (int round = 1;; ++round) {
    pid_t const ended = wait4(pid, &status, WNOHANG, &used);
    if (ended == pid || (ended < 0 && errno != EINTR)) break;
    wait_a_moment(ending);
    if (cut != End::exited) continue;
    if (command.interrupted && *command.interrupted) cut = End::interrupted;
    if (command.seconds > 0.0 && clock.seconds() > command.seconds) cut = End::out_of_time;
    if (command.bytes > 0 && round % rounds_between_sizes == 0 && bytes_in(command.folder) > command.bytes)
      cut = End::out_of_space;
    if (cut != End::exited) end_all(pid, mark);
  }
  outcome.seconds = clock.seconds();
  if (ending >= 0) close(ending);
  end_all(pid, mark);
  commands().remove(pid);
  auto const seconds_of = [](timeval const& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  outcome.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  outcome.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  outcome.end = cut;
  if (cut == End::exited && WIFSIGNALED(status)) {
    outcome.end = WTERMSIG(status) == SIGXFSZ ? End::out_of_space : End::signalled;
    outcome.status = WTERMSIG(status);
  } else if (cut == End::exited) {
    outcome.status = WEXITSTATUS(status);
    if (outcome.status == 128 + SIGXFSZ) outcome.end = End::out_of_space;  // as shells tell of their children
  }
  if (!has_started) {
    outcome.end = End::not_started;
    outcome.status = error;
  }
  return outcome;
}

}  // namespace sphverify
