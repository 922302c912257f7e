// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

namespace sphverify {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view space = " \t\r\n";

/// Walks through JSON. It was read before, so that nothing is checked but that the text goes on.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  }

  /// The innermost place on the way to a key; npos where the text ends too soon.
  std::size_t find(std::string_view key) {
    skip_space();
    std::size_t found = at_;
    while (!key.empty()) {
      std::size_t const rest = peek() == '{'   ? enter_object(key, found)
                               : peek() == '[' ? enter_list(key, found)
                                               : key.size();
      if (is_lost_) return std::string_view::npos;
      if (rest == key.size()) break;
      key = key.substr(key.size() - rest);
    }
    return found;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_space() { at_ = std::min(text_.find_first_not_of(space, at_), text_.size()); }

  /// Behind the text that begins here.
  void skip_string() {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) at_ += text_[at_] == '\\' ? 1 : 0;
    ++at_;
  }

  void skip_value() {
    for (int depth = 0; at_ < text_.size();) {
      char const c = peek();
      if (c == '"') {
        skip_string();
      } else if (c == '{' || c == '[') {
        ++depth;
        ++at_;
      } else if (c == '}' || c == ']') {
        if (depth == 0) return;  // of what the value stands in
        --depth;
        ++at_;
      } else {
        if (c == ',' && depth == 0) return;
        ++at_;
        continue;
      }
      if (depth == 0) return;
    }
  }

  /// Behind the comma that parts two entries; false where there is none more.
  bool goes_on() {
    skip_space();
    if (peek() != ',') {
      is_lost_ = is_lost_ || at_ >= text_.size();
      return false;
    }
    ++at_;
    skip_space();
    return true;
  }

  std::string name_here() {
    std::size_t const from = at_;
    skip_string();
    auto const name =
        nlohmann::json::parse(text_.substr(from, std::min(at_, text_.size()) - from), nullptr, false);
    return name.is_string() ? name.get<std::string>() : std::string();
  }

  /// To the value of the member that a key begins with. Of a name with a dot in it the key does not tell
  /// where it ends: the longest that fits is meant.
  /// @return how much of the key is left; all of it where there is no such member
  std::size_t enter_object(std::string_view key, std::size_t& found) {
    std::string_view const step = key.substr(key.front() == '.' ? 1 : 0);
    std::size_t best = 0, value = 0;
    ++at_;
    skip_space();
    if (peek() == '}') return key.size();
    do {
      if (peek() != '"') break;
      std::size_t const here = at_;
      std::string const name = name_here();
      skip_space();
      ++at_;  // the colon
      skip_space();
      bool const fits = step.starts_with(name) &&
                        (step.size() == name.size() || step[name.size()] == '.' || step[name.size()] == '[');
      if (fits && name.size() > best) {
        best = name.size();
        found = here;
        value = at_;
      }
      skip_value();
    } while (goes_on());
    if (best == 0) return key.size();
    at_ = value;
    return step.size() - best;
  }

  /// Likewise of "[2]...".
  std::size_t enter_list(std::string_view key, std::size_t& found) {
    std::size_t const close = key.find(']');
    std::string_view const digits = key.substr(1, std::min(close, key.size()) - 1);
    bool const is_index =
        key.front() == '[' && close != std::string_view::npos && !digits.empty() && digits.size() < 10 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_index) return key.size();
    ++at_;
    skip_space();
    if (peek() == ']') return key.size();
    for (int left = std::stoi(std::string(digits)); left > 0; --left) {
      skip_value();
      if (!goes_on()) return key.size();
    }
    found = at_;
    return key.size() - close - 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool is_lost_ = false;
};

struct Noted {
  std::mutex mutex;
  std::set<std::string, std::less<>> paths;
};
Noted& noted() {
  static Noted one;
  return one;
}

}  // namespace

TextPlace place_in(std::string_view text, std::size_t at) {
  std::size_t const begin = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  std::string_view const before = text.substr(begin, std::min(at, text.size()) - std::min(at, begin));
  auto const line = std::count(before.begin(), before.end(), '\n');
  std::string_view const last = before.substr(before.rfind('\n') + 1);  // all of it where there is none
  // Bytes that go on with a character of UTF-8 are no columns of their own.
  auto const columns = std::count_if(last.begin(), last.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return {1 + static_cast<std::size_t>(line), 1 + static_cast<std::size_t>(columns)};
}

std::string place_text(std::string_view file, TextPlace place) {
  return fmt::format("{}:{}:{}", file, place.line, place.column);
}

std::optional<TextPlace> place_of_key(std::string_view json, std::string_view key) {
  std::size_t const at = Walker(json).find(key);
  if (at >= json.size()) return std::nullopt;
  return place_in(json, at);
}

void note_json_file(std::string const& path) {
  std::scoped_lock const lock(noted().mutex);
  noted().paths.insert(path);
}

std::string file_and_place(std::string_view file, std::string_view key) {
  {
    std::scoped_lock const lock(noted().mutex);
    if (key.empty() || !noted().paths.contains(file)) return std::string(file);
  }
  std::string const path(file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return path;  // of a pipe there is nothing more to read
  std::ifstream stream(path, std::ios::binary);
  std::string const text(std::istreambuf_iterator<char>(stream), {});
  auto const place = place_of_key(text, key);
  return place ? place_text(path, *place) : path;
}

}  // namespace sphverify
