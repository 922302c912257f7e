#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

struct CompareOptions {
  TableFormat format = TableFormat::table;
  std::string region = "all";
  std::string norm;     ///< empty: l1 where the solution jumps, l2 elsewhere
  std::string section;  ///< series, envelopes or changes; empty: all (of CSV: series if there are any)
  bool colour = false;
};

/// A results document and the name that tells it from others.
struct NamedResults {
  std::string name;
  Results results;
};

/// Formulations side by side. On a terminal and in Markdown: per case tables of errors with orders and
/// verdicts, of wall fluxes, budgets and stability, of the time to 1%; a summary over all cases; envelopes;
/// and of several documents what changed since the first. In CSV a row per series, envelope or change with
/// all numbers, in JSON all of these.
std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options);

}  // namespace sphverify
