// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// Where in a file something stands, so that complaints about it begin as those of compilers do, which editors
// and terminals turn into links: FILE:LINE:COLUMN.
namespace sphverify {

/// Both count from 1; columns in characters.
struct TextPlace {
  std::size_t line, column;
};

TextPlace place_in(std::string_view text, std::size_t at);

/// "study.json:3:14"
std::string place_text(std::string_view file, TextPlace place);

/// Where a key such as `cases[0].parameters.final_time` stands in JSON that has been read without a
/// complaint: its name, or an element itself; of a key that is missing, the innermost place on the way to it.
/// Empty where the text is no such JSON.
std::optional<TextPlace> place_of_key(std::string_view json, std::string_view key);

/// Notes that a file was read as JSON: complaints about a key of it then say where it stands.
void note_json_file(std::string const& path);

/// FILE, or FILE:LINE:COLUMN where a file was noted. It is read again: whoever complains has time, and
/// whoever does not need not keep the text.
std::string file_and_place(std::string_view file, std::string_view key);

}  // namespace sphverify
