// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/write_results.hpp"

#include <array>
#include <fstream>

#include "reports/hdf5.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

/// The document in columns, whose entries become JSON one after the other.
Column columns_of(Results const& results) {
  Column document;
  Json top = top_json(results);
  top["study"] = results.study;
  document.append(top);
  document.members.at("study").kind = Column::Kind::json;  // word for word, with keys in their order
  for (ResultsList const& list : lists_of(results)) {
    Column& column = document.members[list.name];
    column.append(Json::array());
    for (std::size_t k = 0; k < list.size; ++k) column.elements.front().append(list.entry(k));
    column.starts.back() = list.size;
  }
  return document;
}

}  // namespace

ResultsFormat results_format(std::string const& word, std::string const& command) {
  if (word == "json") return ResultsFormat::json;
  if (!can_use_hdf5())
    throw UserError(command, "--format", word + ", and a program that was built without libhdf5-dev", "json, or a build with it");
  return ResultsFormat::hdf5;
}

ResultsFormat format_of_file(std::string const& path) {
  std::array<char, 8> signature{};
  std::ifstream(path, std::ios::binary).read(signature.data(), signature.size());
  return is_hdf5({signature.data(), signature.size()}) ? ResultsFormat::hdf5 : ResultsFormat::json;
}

void write_results(std::string const& path, Results const& results, ResultsFormat format) {
  write_document(path, format == ResultsFormat::hdf5 ? hdf5_file(columns_of(results)) : document_text(to_json(results)));
}

}  // namespace sphverify
