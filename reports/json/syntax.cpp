// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "reports/json/places.hpp"
#include "reports/printable.hpp"

namespace sphverify {

namespace {

constexpr char const* whole_document = "a complete JSON document";
constexpr char const* straight_quotes = R"(double quotes, as in "text")";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
/// What a number or a bare word may go on with.
bool is_word(char c) { return is_digit(c) || is_letter(c) || c == '.' || c == '+' || c == '-'; }

/// Stops at the first mistake, by throwing it.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = begin_ = 3;  // a byte order mark
  }

  void scan() {
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
      refuse(0, "text in UTF-16", "text in UTF-8");
    for (Next next = Next::value; next != Next::nothing;) next = step(next);
  }

 private:
  /// What may come next. After a comma an object needs a key, and a list a value.
  enum class Next { value, value_or_end, key, key_or_end, colon, comma_or_end, document_end, nothing };

  struct Open {
    char bracket;
    std::size_t at;
    std::set<std::string> keys{};
  };

  [[noreturn]] void refuse(std::size_t at, std::string found, std::string expected) const {
    auto const [line, column] = place_in(text_, at);
    throw SyntaxError{line, column, std::move(found), std::move(expected)};
  }

  std::string where(std::size_t at) const {
    auto const [line, column] = place_in(text_, at);
    return fmt::format("line {}, column {}", line, column);
  }

  bool is_end() const { return at_ >= text_.size(); }
  char peek() const { return is_end() ? '\0' : text_[at_]; }
  bool follows(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  static char closing(Open const& open) { return open.bracket == '{' ? '}' : ']'; }
  static char const* kind(Open const& open) { return open.bracket == '{' ? "object" : "list"; }

  void skip_space() {
    while (!is_end() && std::string_view(" \t\r\n").find(peek()) != std::string_view::npos) ++at_;
  }

  /// What people write and JSON does not have, wherever it stands.
  void refuse_foreign(Next next) const {
    if (follows("//") || follows("/*") || peek() == '#')
      refuse(at_, "a comment", "JSON, which has no comments");
    if (peek() == '\'' || peek() == '`') refuse(at_, "a single quote", straight_quotes);
    for (std::string_view const quote :
         {"\u201C", "\u201D", "\u201E", "\u2018", "\u2019", "\u00AB", "\u00BB"}) {
      if (follows(quote)) refuse(at_, "a typographic quote", straight_quotes);
    }
    if (follows("\u00A0")) refuse(at_, "a no-break space", "plain spaces");
    if (follows("\u200B") || follows("\uFEFF")) refuse(at_, "an invisible character", "plain spaces");
    bool const may_be_comma = next == Next::comma_or_end || next == Next::colon ||
                              next == Next::document_end || (at_ > begin_ && text_[last_] == ':');
    if (peek() == ',' && !may_be_comma)
      refuse(at_, "a comma with nothing before it", "one comma between entries");
  }

  Next step(Next next) {
    skip_space();
    if (is_end()) {
      if (next == Next::document_end) return Next::nothing;
      if (open_.empty()) refuse(at_, "the end of the file", whole_document);
      refuse(at_, "the end of the file",
             fmt::format("{}: the {} that opens at {} is not closed", whole_document, kind(open_.back()),
                         where(open_.back().at)));
    }
    refuse_foreign(next);
    switch (next) {
      case Next::value_or_end:
        if (peek() == ']') return close();
        return value(false);
      case Next::value:
        return value(true);
      case Next::key_or_end:
        if (peek() == '}') return close();
        return key();
      case Next::key:
        if (peek() == '}') refuse(last_, "a trailing comma", "another entry after it, or none before '}'");
        return key();
      case Next::colon:
        if (peek() != ':')
          refuse(at_, token(), fmt::format("a colon after the key '{}'", printable(last_key_)));
        last_ = at_++;
        return Next::value;
      case Next::comma_or_end:
        return comma_or_end();
      default:
        refuse(at_, fmt::format("{} after the end of the document", token()), "one document in the file");
    }
  }

  Next after_value() const { return open_.empty() ? Next::document_end : Next::comma_or_end; }

  Next close() {
    open_.pop_back();
    last_ = at_++;
    return after_value();
  }

  /// What stands here, in words.
  std::string token() const {
    if (peek() == '"') return "a text";
    std::size_t end = at_;
    while (end < text_.size() && is_word(text_[end])) ++end;
    if (end > at_) return fmt::format("'{}'", shortened(printable(text_.substr(at_, end - at_))));
    // A whole character.
    end = at_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    return fmt::format("'{}'", printable(text_.substr(at_, end - at_)));
  }

  static std::string shortened(std::string const& text) {
    constexpr std::size_t longest = 40;
    return text.size() > longest ? text.substr(0, longest - 3) + "..." : text;
  }

  Next value(bool is_needed) {
    char const c = peek();
    if (c == '{' || c == '[') {
      if (open_.size() == deepest_nesting) {
        refuse(at_, "lists or objects nested too deeply", fmt::format("at most {} levels", deepest_nesting));
      }
      open_.push_back({c, at_});
      last_ = at_++;
      return c == '{' ? Next::key_or_end : Next::value_or_end;
    }
    if (c == '"') {
      text();
    } else if (is_digit(c) || c == '-' || c == '+' || c == '.') {
      number();
    } else if (is_letter(c)) {
      word();
    } else if (is_needed && !open_.empty() && c == ']' && text_[last_] == ',') {
      refuse(last_, "a trailing comma", "another value after it, or none before ']'");
    } else if (!open_.empty() && text_[last_] == ':') {
      refuse(at_, token(), fmt::format("a value of the key '{}'", printable(last_key_)));
    } else {
      refuse(at_, token(), open_.empty() ? whole_document : "a value");
    }
    return after_value();
  }

  Next key() {
    if (is_letter(peek())) refuse(at_, fmt::format("{} without quotes", token()), "a key in double quotes");
    if (peek() != '"') refuse(at_, token(), "a key in double quotes, or '}'");
    std::size_t const start = at_;
    text();
    last_key_ = std::string(text_.substr(start + 1, at_ - start - 2));
    // What differs in its escapes only is the same key.
    if (last_key_.find('\\') != std::string::npos)
      last_key_ = nlohmann::json::parse(text_.substr(start, at_ - start)).get<std::string>();
    if (!open_.back().keys.insert(last_key_).second) {
      refuse(start, fmt::format("the key '{}' twice", printable(last_key_)), "every key of an object once");
    }
    return Next::colon;
  }

  Next comma_or_end() {
    Open const& open = open_.back();
    if (peek() == closing(open)) return close();
    if (peek() == ',') {
      last_ = at_++;
      return open.bracket == '{' ? Next::key : Next::value;
    }
    if (peek() == '}' || peek() == ']') {
      refuse(at_, token(),
             fmt::format("'{}', which closes the {} that opens at {}", closing(open), kind(open),
                         where(open.at)));
    }
    if (peek() == '"' || peek() == '{' || peek() == '[' || is_word(peek())) {
      refuse(last_ + 1,
             fmt::format("a missing comma before {}", peek() == '{'   ? "an object"
                                                      : peek() == '[' ? "a list"
                                                                      : token()),
             fmt::format("a comma between entries, or '{}'", closing(open)));
    }
    refuse(at_, token(), fmt::format("a comma or '{}'", closing(open)));
  }

  void text() {
    std::size_t const start = at_++;
    while (!is_end() && peek() != '"') {
      auto const c = static_cast<unsigned char>(peek());
      if (c == '\n' || c == '\r') {
        refuse(start, "a text that is not closed on its line", "a double quote at its end");
      } else if (c < 0x20) {
        refuse(at_, fmt::format("the control character {} in a text", printable(text_.substr(at_, 1))),
               fmt::format("\\u{:04x}", c));
      } else if (c == '\\') {
        escape();
      } else if (std::size_t const size = utf8_size(text_.substr(at_)); size > 0) {
        at_ += size;
      } else {
        refuse(at_, fmt::format("the byte 0x{:02x}, which is not UTF-8", c), "text in UTF-8");
      }
    }
    if (is_end()) {
      refuse(at_, "the end of the file",
             fmt::format("{}: the text that opens at {} is not closed", whole_document, where(start)));
    }
    last_ = at_++;
  }

  void escape() {
    std::size_t const start = at_++;
    char const c = peek();
    if (c == 'u') {
      unsigned const code = hexadecimal(start);
      if (code >= 0xDC00 && code < 0xE000)
        refuse(start, "half a surrogate pair", "both halves, or the character");
      if (code < 0xD800 || code >= 0xDC00) return;
      if (!follows("\\u")) refuse(start, "half a surrogate pair", "both halves, or the character");
      ++at_;
      if (unsigned const low = hexadecimal(start); low < 0xDC00 || low >= 0xE000)
        refuse(start, "half a surrogate pair", "both halves, or the character");
      return;
    }
    if (is_end() || std::string_view(R"("\/bfnrt)").find(c) == std::string_view::npos) {
      refuse(start, fmt::format("the escape {}", shortened(printable(text_.substr(start, 2)))),
             R"(one of \" \\ \/ \b \f \n \r \t \uXXXX; a backslash is \\)");
    }
    ++at_;
  }

  /// Of uXXXX.
  unsigned hexadecimal(std::size_t start) {
    unsigned code = 0;
    for (int k = 0; k < 4; ++k) {
      char const c = ++at_ < text_.size() ? text_[at_] : ' ';
      std::size_t const digit = std::string_view("0123456789abcdef").find(static_cast<char>(c | 0x20));
      if (digit == std::string_view::npos)
        refuse(start, "an escape \\u without four digits", "\\uXXXX, hexadecimal");
      code = 16 * code + static_cast<unsigned>(digit);
    }
    ++at_;
    return code;
  }

  void number() {
    std::size_t const start = at_;
    while (!is_end() && is_word(peek())) ++at_;
    std::string_view const all = text_.substr(start, at_ - start);
    std::size_t k = 0;
    auto const digits = [&] {
      std::size_t const first = k;
      while (k < all.size() && is_digit(all[k])) ++k;
      return k > first;
    };
    auto const is_number = [&] {
      if (k < all.size() && all[k] == '-') ++k;
      bool const leading_zero = k + 1 < all.size() && all[k] == '0' && is_digit(all[k + 1]);
      if (leading_zero || !digits()) return false;
      if (k < all.size() && all[k] == '.' && (++k, !digits())) return false;
      if (k < all.size() && (all[k] == 'e' || all[k] == 'E')) {
        ++k;
        if (k < all.size() && (all[k] == '+' || all[k] == '-')) ++k;
        if (!digits()) return false;
      }
      return k == all.size();
    };
    if (!is_number()) {
      at_ = start;
      refuse(start, token(), "a number as JSON writes it, such as -0.5 or 1e-3");
    }
    if (std::isinf(std::strtod(std::string(all).c_str(), nullptr))) {
      at_ = start;
      refuse(start, token(), "a number within the range of double");
    }
    last_ = at_ - 1;
  }

  void word() {
    std::size_t const start = at_;
    while (!is_end() && is_word(peek())) ++at_;
    std::string const found(text_.substr(start, at_ - start));
    last_ = at_ - 1;
    if (found == "true" || found == "false" || found == "null") return;
    at_ = start;
    std::string lower = found;
    for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
    if (lower == "nan" || lower == "inf" || lower == "infinity") refuse(start, token(), "a finite number");
    for (char const* word : {"true", "false", "null"}) {
      if (lower == word) refuse(start, token(), word);
    }
    if (lower == "none") refuse(start, token(), "null");
    refuse(start, token(), "a value: a number, true, false, null, or a text in double quotes");
  }

  std::string_view text_;
  std::size_t begin_ = 0;  ///< of the document, behind what marks its encoding
  std::size_t at_ = 0;
  std::size_t last_ = 0;  ///< last character of what was read before
  std::vector<Open> open_;
  std::string last_key_;
};

}  // namespace

std::optional<SyntaxError> find_syntax_error(std::string_view text) {
  try {
    Scanner(text).scan();
  } catch (SyntaxError const& error) {
    return error;
  }
  return std::nullopt;
}

}  // namespace sphverify
