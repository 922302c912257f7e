// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/line_channel.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace sphverify {

bool LineChannel::send(Json const& document) {
  std::string const text = document.dump() + "\n";
  for (std::size_t sent = 0; sent < text.size();) {
    // Of a socket whose other end is gone no signal is wanted; a pipe knows no such choice.
    ssize_t n = ::send(file_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == ENOTSOCK) n = write(file_, text.data() + sent, text.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

bool LineChannel::receive() {
  std::array<char, 65536> block;
  ssize_t n = 0;
  do {
    n = read(file_, block.data(), block.size());
  } while (n < 0 && errno == EINTR);
  if (n <= 0) return false;
  text_.append(block.data(), static_cast<std::size_t>(n));
  return true;
}

std::optional<Json> LineChannel::next() {
  std::size_t const end = text_.find('\n', seen_);
  if (end == std::string::npos) {
    seen_ = text_.size();
    return std::nullopt;
  }
  Json document = Json::parse(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
  if (!document.is_object()) document = Json::object();
  text_.erase(0, end + 1);
  seen_ = 0;
  return document;
}

std::optional<Json> LineChannel::wait() {
  while (true) {
    if (auto document = next()) return document;
    if (!receive()) return std::nullopt;
  }
}

}  // namespace sphverify
