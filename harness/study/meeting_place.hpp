// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "harness/study/line_channel.hpp"
#include "harness/study/ranks.hpp"

namespace sphverify {

/// Where workers of other ranks find rank 0: a socket, whose addresses and a key stand in RESULTS.json.ranks, which the
/// user alone can read, as long as rank 0 listens.
class MeetingPlace {
 public:
  /// Rank 0 opens it. Throws std::runtime_error if the machine has no socket, UserError if the file cannot be written.
  MeetingPlace(std::string const& results, Rank const& rank);
  ~MeetingPlace();
  MeetingPlace(MeetingPlace const&) = delete;
  MeetingPlace& operator=(MeetingPlace const&) = delete;

  int file() const { return listens_; }

  /// Somebody who asks to come in; empty if nobody does, after all.
  std::optional<LineChannel> accept() const;

  /// Whether a greeting is that of a worker of this job.
  bool is_ours(Json const& greeting) const;

 private:
  std::string path_, key_, job_;
  OpenFile listens_;
};

/// Finds rank 0 and greets it, again and again until it answers.
/// @param greeting goes along with the key
/// Empty if rank 0 is not found in a minute; throws Interrupted when asked to stop, std::runtime_error if it is refused.
std::optional<LineChannel> find_rank_0(std::string const& results, Rank const& rank, Json greeting, std::atomic<bool> const* interrupted);

}  // namespace sphverify
