// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/meeting_place.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <thread>

#include "harness/measure/machine.hpp"
#include "harness/run/run.hpp"

namespace sphverify {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds patience{60};
constexpr std::chrono::milliseconds between_tries{100};
constexpr int answer_ms = 5000;

std::string path_of(std::string const& results) { return results + ".ranks"; }

/// Of this machine, the one that only it knows among them.
Json own_addresses() {
  Json all = Json::array();
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return all;
  for (ifaddrs const* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<sockaddr_in const*>(one->ifa_addr)->sin_addr, text, sizeof text);
    all.push_back(text);
  }
  freeifaddrs(list);
  return all;
}

/// A node that is switched off says nothing: it is noticed within a minute.
void notice_death(int socket) {
  int const on = 1, idle = 30, interval = 10, probes = 3;
  setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  setsockopt(socket, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
  setsockopt(socket, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
  setsockopt(socket, IPPROTO_TCP, TCP_KEEPCNT, &probes, sizeof probes);
  // What was sent and nobody confirms is not waited for any longer.
  int const milliseconds = 60000;
  setsockopt(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, &milliseconds, sizeof milliseconds);
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// Whether something can be done with a file within a time.
bool is_ready(int file, short what, int milliseconds) {
  pollfd wait{file, what, 0};
  return poll(&wait, 1, milliseconds) == 1 && (wait.revents & what) != 0;
}

std::optional<OpenFile> connect_to(std::string const& address, int port) {
  OpenFile file(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  if (file < 0 || inet_pton(AF_INET, address.c_str(), &to.sin_addr) != 1) return std::nullopt;
  if (connect(file, reinterpret_cast<sockaddr const*>(&to), sizeof to) != 0) {
    int error = 0;
    socklen_t size = sizeof error;
    bool const is_under_way = errno == EINPROGRESS && is_ready(file, POLLOUT, answer_ms);
    if (!is_under_way || getsockopt(file, SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0) return std::nullopt;
  }
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  notice_death(file);
  return file;
}

/// One try at every address.
std::optional<LineChannel> try_once(Json const& place, Json const& greeting) {
  for (Json const& address : place.at("addresses")) {
    // Every machine has one of these of its own: another's user might listen there.
    if (address.get<std::string>().starts_with("127.") && place.value("machine", "") != machine_name()) continue;
    auto file = connect_to(address.get<std::string>(), place.at("port").get<int>());
    if (!file) continue;
    LineChannel channel(std::move(*file));
    // Whoever else listens there now says something else, or nothing.
    if (!channel.send(greeting) || !is_ready(channel.file(), POLLIN, answer_ms)) continue;
    auto const answer = channel.wait();
    if (answer && answer->contains("welcome")) return channel;
    if (answer && answer->contains("refused")) throw std::runtime_error("rank 0 has another study, build or plug-in");
  }
  return std::nullopt;
}

}  // namespace

MeetingPlace::MeetingPlace(std::string const& results, Rank const& rank)
    : path_(path_of(results)), job_(rank.job), listens_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  auto const fail = [](char const* what) { throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno))); };
  if (listens_ < 0) fail("no socket for other ranks");
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_addr.s_addr = htonl(INADDR_ANY);
  socklen_t size = sizeof any;
  if (bind(listens_, reinterpret_cast<sockaddr const*>(&any), size) != 0 || listen(listens_, SOMAXCONN) != 0 ||
      getsockname(listens_, reinterpret_cast<sockaddr*>(&any), &size) != 0)
    fail("no port for other ranks");
  std::random_device source;
  key_ = fmt::format("{:08x}{:08x}{:08x}{:08x}", source(), source(), source(), source());
  Json const place{{"addresses", own_addresses()}, {"port", ntohs(any.sin_port)}, {"key", key_}, {"machine", machine_name()}};
  std::string const made = path_ + ".new";
  unlink(made.c_str());
  OpenFile file(open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  std::string const text = place.dump() + "\n";
  bool const is_written = file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (!is_written || std::rename(made.c_str(), path_.c_str()) != 0)
    throw UserError(path_, "", std::string("a place that cannot be written (") + std::strerror(errno) + ")",
                    "room beside the results for other ranks to find rank 0");
}

MeetingPlace::~MeetingPlace() { unlink(path_.c_str()); }

std::optional<LineChannel> MeetingPlace::accept() const {
  OpenFile file(accept4(listens_, nullptr, nullptr, SOCK_CLOEXEC));
  if (file < 0) return std::nullopt;
  notice_death(file);
  return LineChannel(std::move(file));
}

bool MeetingPlace::is_ours(Json const& greeting) const {
  auto const is = [&](char const* name, std::string const& expected) {
    auto const found = greeting.find(name);
    return found != greeting.end() && found->is_string() && found->get<std::string>() == expected;
  };
  return is("key", key_) && is("job", job_);
}

std::optional<LineChannel> find_rank_0(std::string const& results, Rank const& rank, Json greeting,
                                       std::atomic<bool> const* interrupted) {
  auto const start = Clock::now();
  while (Clock::now() - start < patience) {
    if (interrupted && *interrupted) throw Interrupted();
    std::ifstream file(path_of(results));
    Json const place = Json::parse(file, nullptr, false);
    if (place.is_object() && place.contains("addresses") && place.contains("port") && place.contains("key")) {
      greeting["key"] = place.at("key");
      greeting["job"] = rank.job;
      if (auto channel = try_once(place, greeting)) return channel;
    }
    std::this_thread::sleep_for(between_tries);
  }
  return std::nullopt;
}

}  // namespace sphverify
