// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// The results document, sphverify-results/1.
Json to_json(Results const& results);

/// What it is put together from: what stands there once, and its lists, in their order.
struct ResultsList {
  char const* name;
  std::size_t size;
  std::function<Json(std::size_t)> entry;
};
Json top_json(Results const& results);
std::vector<ResultsList> lists_of(Results const& results);

Json to_json(RunRecord const& run);
Json to_json(Cost const& cost);
Json to_json(ObservedOrder const& order);
Json to_json(Context const& context);
Json parameters_json(std::map<std::string, ParameterValue> const& parameters);
Json to_json(FormulationChoice const& formulation);
/// The formulation, its partners and whether walls act, as keys of an object.
void put_formulation(Json& json, FormulationChoice const& formulation);
Json to_json(Discretisation const& discretisation);
Json to_json(LayoutChoice const& layout);
Json to_json(ViscosityChoice const& viscosity);

/// Reads back what `to_json` wrote (and `put_formulation`, from the same object). Throws UserError for
/// anything else.
std::map<std::string, ParameterValue> read_parameters(Node const& node);
FormulationChoice read_formulation(Node const& node);
Discretisation read_discretisation(Node const& node);
RunRecord read_run(Node const& node);
Cost read_cost(Node const& node);
/// Of JSON or HDF5, as the file's content is.
Results read_results(std::string const& path);
/// The same of what has orders and tables: throws UserError for a part of a study.
Results read_whole_results(std::string const& path);

/// Writes a document so that the file is either the old one or the whole new one; `-` is standard output.
/// Throws UserError when the place cannot be written.
void write_document(std::string const& path, std::string const& text);

/// Removes what a process that was killed left of writing it. Nobody else may be writing it.
void remove_unfinished(std::string const& path);

/// Throws UserError unless a file can be created where the path says, and it is not the input.
void require_writable(std::string const& path, std::string const& input = "");

/// A document as text: one line per small object, numbers in the shortest form that reads back the same.
std::string document_text(Json const& document);

}  // namespace sphverify
