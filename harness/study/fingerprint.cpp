// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/fingerprint.hpp"

#include <fmt/format.h>

#include <array>
#include <boost/crc.hpp>
#include <fstream>

namespace sphverify {

namespace {

std::string fingerprint_of(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  boost::crc_32_type crc;
  std::size_t length = 0;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    crc.process_bytes(block.data(), static_cast<std::size_t>(file.gcount()));
    length += static_cast<std::size_t>(file.gcount());
  }
  return length > 0 ? fmt::format("{:08x}-{}", crc.checksum(), length) : "";
}

}  // namespace

std::string fingerprint(std::vector<std::string> const& plugins) {
  // The running program does not change while it runs; what lies in its place may.
  static std::string const own = fingerprint_of("/proc/self/exe");
  std::string all = own;
  for (std::string const& path : plugins) all += fmt::format(" {}", fingerprint_of(path));
  return all;
}

}  // namespace sphverify
