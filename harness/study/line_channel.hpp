// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "harness/study/open_file.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// Documents to and from another process, one per line, over a socket or a pipe.
class LineChannel {
 public:
  explicit LineChannel(OpenFile file) : file_(std::move(file)) {}

  int file() const { return file_; }

  /// Sends all of it. False if nobody is there any more.
  bool send(Json const& document);

  /// Reads what has come, waiting if nothing has. False at the end: nothing will come any more.
  bool receive();

  /// The next whole document that has come. What is no object is an empty one.
  std::optional<Json> next();

  /// How much has come that is not a whole document.
  std::size_t unread() const { return text_.size(); }

  /// Waits for a document; empty at the end.
  std::optional<Json> wait();

 private:
  OpenFile file_;
  std::string text_;
  std::size_t seen_ = 0;  ///< of the text, that holds no end of a line
};

}  // namespace sphverify
