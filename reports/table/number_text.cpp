// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sphverify {

std::string scientific(Number const& value) {
  if (!value) return "-";
  if (!std::isfinite(*value)) return "fails";
  if (*value == 0.0) return "0";
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(*value))));
  double mantissa = *value / std::pow(10.0, exponent);
  if (std::abs(mantissa) >= 9.95) {  // would be rounded to 10.0
    mantissa /= 10.0;
    ++exponent;
  }
  return fmt::format("{:.1f}e{}", mantissa, exponent);
}

std::string percent(Number const& value) {
  if (!value) return "-";
  if (!std::isfinite(*value)) return "fails";
  double const hundredths = 100.0 * *value;
  if (hundredths < 1e-9) return "0%";  // rounding
  if (hundredths >= 10000.0) return scientific(hundredths) + "%";
  return hundredths >= 10.0 ? fmt::format("{:.0f}%", hundredths) : fmt::format("{:.2g}%", hundredths);
}

std::string signed_percent(double value) {
  return std::abs(value) < 0.1 ? fmt::format("{:+.2g}%", 100.0 * value)
                               : fmt::format("{:+.0f}%", 100.0 * value);
}

std::string order_with_interval(double order, double lower, double upper) {
  double const above = upper - order, below = order - lower;
  double const half = std::max(above, below);
  if (half > 0.15 && half > 1.5 * std::min(above, below)) {
    return lower < 0.0 ? fmt::format("{:.1f} ({:.1f} to {:.1f})", order, lower, upper)
                       : fmt::format("{:.1f} ({:.1f}-{:.1f})", order, lower, upper);
  }
  return half < 9.95 ? fmt::format("{:.1f}±{:.1f}", order, half) : fmt::format("{:.1f}±{:.0f}", order, half);
}

std::size_t text_width(std::string const& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> lines_of_words(std::string const& words, std::size_t columns) {
  std::vector<std::string> lines{""};
  for (std::size_t start = 0; start < words.size();) {
    std::size_t const end = std::min(words.find(' ', start), words.size());
    std::string const word = words.substr(start, end - start);
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (text_width(line) + 1 + text_width(word) <= columns) {
      line += " " + word;
    } else {
      lines.push_back(word);
    }
    start = end + 1;
  }
  return lines;
}

std::string hanging_lines(std::string const& head, std::string const& words, std::size_t column,
                          std::size_t columns) {
  std::string text;
  for (std::string const& line : lines_of_words(words, columns - std::min(columns, column)))
    text += (text.empty() ? head : std::string(column, ' ')) + line + "\n";
  return text;
}

std::string indented_lines(std::string const& words, std::size_t columns) {
  std::string text = hanging_lines("  ", words, 2, columns);
  text.pop_back();
  return text;
}

}  // namespace sphverify
