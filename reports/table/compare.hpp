#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

struct CompareOptions {
  TableFormat format = TableFormat::table;
  std::string region = "all";
  std::string norm;  ///< empty: l1 where the solution jumps, l2 elsewhere
  bool colour = false;
};

/// A results document and the name that tells it from others.
struct NamedResults {
  std::string name;
  Results results;
};

/// Formulations side by side. On a terminal and in Markdown: per case one table of errors with orders and
/// verdicts, one of the flux through the walls, one of the time to 1%, and a summary over all cases; in CSV
/// and JSON one row per series with all numbers.
std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options);

}  // namespace sphverify
