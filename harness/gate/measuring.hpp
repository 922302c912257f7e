// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/gate/gates.hpp"

namespace sphverify {

/// What the measures of one gate share: the gate, the document, and the names that were looked for.
class Measuring {
 public:
  /// @param gates_file the gates document, for complaints; null: missing names are no one's error
  Measuring(Gate const& of, Results const& document, std::string const* gates_file)
      : gate(of), results(document), file(gates_file) {}

  Gate const& gate;
  Results const& results;
  std::string const* file;

  /// What a key of the gate names must exist somewhere among the sound runs that it selects.
  /// @return whether it exists in this one
  bool name(std::string const& key, std::string const& wanted, std::set<std::string> const& existing);

  /// Throws UserError for a name that none of them had.
  void require_names() const;

  /// The run or series itself is what it would be compared to.
  bool is_reference(FormulationChoice const& formulation) const;

 private:
  struct Named {
    std::string wanted;
    std::set<std::string> existing;
    bool found = false;
  };
  std::map<std::string, Named> names_;
};

/// One number of a run or series, by its name in a gate.
template <class Record>
struct Quantity {
  char const* name;
  std::function<Number(Record const&)> value;
  char const* unit;
};

std::vector<Quantity<Stability>> const& stability_table();
std::vector<Quantity<Cost>> const& cost_table();

template <class Record>
Quantity<Record> const& find_quantity(std::vector<Quantity<Record>> const& table, std::string const& name) {
  auto found = table.begin();
  while (found + 1 != table.end() && found->name != name) ++found;
  return *found;
}

/// Puts a number into an entry; what was written as null, or is relative to nothing, is a problem.
void put(Measured& m, Number const& value, std::string const& missing);

/// Status and reason of a run that is not ok.
std::string failure(RunRecord const& run);

// The measures, one function each: they fill an entry whose run (or series) is sound.
void measure_error(Measuring& measuring, Measured& m);
void measure_skill(Measuring& measuring, Measured& m);
void measure_time_error(Measuring& measuring, Measured& m);
void measure_order(Measuring& measuring, Measured& m);
void measure_budget(Measuring& measuring, Measured& m);
void measure_wall_flux(Measuring& measuring, Measured& m);
void measure_stability(Measuring& measuring, Measured& m);
void measure_cost(Measuring& measuring, Measured& m);
void measure_time_to_error(Measuring& measuring, Measured& m);

/// The entry of a list of a series (orders, times) that a gate names; null if there is none.
template <class Entry>
Entry const* find_entry(Measuring& measuring, std::vector<Entry> const& entries, std::string const& field) {
  Gate const& gate = measuring.gate;
  std::set<std::string> fields;
  std::set<std::string> regions;
  for (Entry const& entry : entries) {
    fields.insert(entry.field);
    if (entry.field == field) regions.insert(entry.region);
  }
  if (!measuring.name("field", field, fields) || !measuring.name("region", gate.region, regions))
    return nullptr;
  for (Entry const& entry : entries) {
    if (entry.field != field || entry.region != gate.region || entry.norm != gate.norm) continue;
    if constexpr (requires { entry.relative; }) {
      if (entry.relative != gate.target) continue;
    }
    return &entry;
  }
  return nullptr;
}

}  // namespace sphverify
