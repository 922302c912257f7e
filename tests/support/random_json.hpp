// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include "reports/json/node.hpp"

namespace sphverify::tests {

/// Documents drawn by lot, with all that JSON has, and values under one key that are mostly alike.
class RandomJson {
 public:
  explicit RandomJson(unsigned seed) : generator_(seed) {}

  Json object(int depth = 0) {
    Json json = Json::object();
    static std::array<char const*, 9> const keys{"a", "b", "c/d", "e@starts", "", ".", "50%", "ä", "%2f"};
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (below(10) < 7) json[keys[k]] = value(k, depth);
    }
    return json;
  }

 private:
  unsigned below(unsigned n) { return static_cast<unsigned>(generator_() % n); }

  /// Of the kind that a key mostly has.
  Json value(std::size_t kind, int depth) {
    if (below(20) == 0) kind = below(9);
    if (below(10) == 0) return nullptr;
    switch (kind) {
      case 0: return below(2) == 0;
      case 1: return static_cast<std::int64_t>(generator_()) >> below(64);
      case 2: return real();
      case 3: return text();
      case 4: return depth > 2 ? Json(real()) : object(depth + 1);
      case 5: return list(3, depth);
      case 6: return list(5, depth);
      case 7: return list(depth > 2 ? 2 : 4, depth);
      default: return table();
    }
  }

  /// Any double but those that JSON does not have.
  double real() {
    std::uint64_t const bits = generator_();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return std::isfinite(value) ? value : -0.0;
  }

  std::string text() {
    static std::array<char const*, 6> const texts{"", "lattice", "quotes \" and\nlines", "ä\u2028\U0001F600", "trailing  ", "0"};
    std::string text = texts[below(texts.size())];
    if (below(30) == 0) text += std::string(1, '\0') + "behind a zero";
    if (below(30) == 0) text += std::string(3000, 'x');
    return text;
  }

  Json list(std::size_t kind, int depth) {
    Json list = Json::array();
    for (unsigned k = below(4); k > 0; --k) list.push_back(kind == 5 && depth < 4 ? this->list(2, depth + 1) : value(kind, depth + 1));
    return list;
  }

  /// Lists as long as each other, mostly.
  Json table() {
    Json table = Json::array();
    for (unsigned k = below(4); k > 0; --k) {
      Json row = Json::array({real(), real()});
      if (below(40) == 0) row.push_back(nullptr);
      table.push_back(row);
    }
    return table;
  }

  std::mt19937_64 generator_;
};

/// JSON without the order of keys; 2 and 2.0 are equal.
inline nlohmann::json unordered(Json const& json) { return nlohmann::json::parse(json.dump()); }

}  // namespace sphverify::tests
