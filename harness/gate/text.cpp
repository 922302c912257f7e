// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/text.hpp"

#include <algorithm>

namespace sphverify {

namespace {

bool starts_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

std::size_t width_of(std::string const& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_a_character));
}

std::string fitted(std::string const& text, std::size_t width) {
  std::size_t const own = width_of(text);
  if (own <= width) return text + std::string(width - own, ' ');
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    if (starts_a_character(text[end]) && characters++ == width - 2) break;
  }
  return text.substr(0, end) + "..";
}

std::string without_control(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7F) c = ' ';
  }
  return text;
}

std::string wrapped(std::string const& text, std::size_t columns) {
  std::string all;
  std::string line = "  ";
  bool fresh = true;
  for (std::size_t start = 0; start < text.size();) {
    std::size_t const end = std::min(text.find(' ', start), text.size());
    std::string const one = text.substr(start, end - start);
    if (!fresh && width_of(line) + 1 + width_of(one) > columns) {
      all += line + "\n";
      line = "    ";
      fresh = true;
    }
    line += (fresh ? "" : " ") + one;
    fresh = false;
    start = end + 1;
  }
  return all + line + "\n";
}

}  // namespace sphverify
