// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/codes/snapshot_options.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// A code that a study runs itself, as the formulation `external/NAME` (contract, "Other codes").
struct ExternalCode {
  std::string id;
  std::vector<std::string> command;  ///< words with placeholders; no shell reads them
  std::string initial = "csv";       ///< format of the particles that it starts from
  SnapshotOptions options;           ///< of the file that it writes
  double disk_budget = 4.0;          ///< that a run may write [GB]
  std::string keep;                  ///< folder in which runs leave what they wrote; empty: nothing is left
  bool operator==(ExternalCode const& other) const { return id == other.id; }
};

/// How identifiers of such formulations begin.
inline constexpr char const* external_prefix = "external/";
inline bool is_external(std::string const& formulation) { return formulation.starts_with(external_prefix); }

/// Throws UserError where NAME is not one of letters, digits, '-', '_' and '.'.
void require_external_name(Node const& id, std::string const& name);

/// Reads {"id": "external/NAME", "command": [...], ...}. Throws UserError.
ExternalCode read_external_code(Node const& object);
Json to_json(ExternalCode const& code);

}  // namespace sphverify
