// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/printable.hpp"

#include <fmt/format.h>

namespace sphverify {

namespace {

unsigned byte_at(std::string_view text, std::size_t k) {
  return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
}

unsigned code_of(std::string_view character) {
  unsigned const lead = byte_at(character, 0);
  unsigned code = character.size() == 1 ? lead : lead & (0x7FU >> character.size());
  for (std::size_t k = 1; k < character.size(); ++k) code = code << 6U | (byte_at(character, k) & 0x3FU);
  return code;
}

bool is_hidden(unsigned code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 || code == 0x200E ||
         code == 0x200F || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::size_t utf8_size(std::string_view text) {
  if (text.empty()) return 0;
  unsigned const lead = byte_at(text, 0);
  if (lead < 0x80) return 1;
  std::size_t const size = lead >= 0xC2 && lead < 0xE0   ? 2
                           : lead >= 0xE0 && lead < 0xF0 ? 3
                           : lead >= 0xF0 && lead < 0xF5 ? 4
                                                         : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte_at(text, k) & 0xC0U) != 0x80U) return 0;
  }
  // Neither longer than it need be, nor half a surrogate pair, nor beyond the last character.
  unsigned const code = code_of(text.substr(0, size));
  bool const is_sensible = size == 2 || (size == 3 && code >= 0x800 && (code < 0xD800 || code > 0xDFFF)) ||
                           (size == 4 && code >= 0x10000 && code <= 0x10FFFF);
  return is_sensible ? size : 0;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    std::size_t const size = utf8_size(text);
    if (size == 0) {
      out += fmt::format("\\x{:02x}", byte_at(text, 0));
      text.remove_prefix(1);
      continue;
    }
    unsigned const code = code_of(text.substr(0, size));
    if (code == '\n') {
      out += "\\n";
    } else if (code == '\r') {
      out += "\\r";
    } else if (code == '\t') {
      out += "\\t";
    } else if (is_hidden(code)) {
      out += fmt::format("\\u{:04x}", code);
    } else {
      out += text.substr(0, size);
    }
    text.remove_prefix(size);
  }
  return out;
}

}  // namespace sphverify
