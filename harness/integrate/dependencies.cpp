// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/integrate/dependencies.hpp"

#include <algorithm>

namespace sphverify {

namespace {

using Rows = std::vector<std::vector<std::int64_t>>;

void make_set(std::vector<std::int64_t>& row) {
  std::sort(row.begin(), row.end());
  row.erase(std::unique(row.begin(), row.end()), row.end());
}

template <int Dim>
Rows one_pass(PairGeometry<Dim> const& geometry) {
  Rows rows(geometry.neighbours.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto const neighbours = geometry.neighbours.row(i);
    rows[i].assign(neighbours.begin(), neighbours.end());
    rows[i].push_back(static_cast<std::int64_t>(i));
  }
  for (WallContacts<Dim> const& contacts : geometry.contacts) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      auto& row = rows[contacts.particle[c]];
      for (std::size_t k = contacts.interpolation_first[c]; k < contacts.interpolation_first[c + 1]; ++k) {
        row.push_back(contacts.interpolation_neighbour[k]);
      }
    }
  }
  // What stands behind a wall has what its sources have, which may be out of the particle's own reach.
  for (std::size_t w = 0; w < geometry.behind.size(); ++w) {
    WallParticles<Dim> const& behind = geometry.behind[w];
    std::size_t const contacts = behind.pairs.rows();
    for (std::size_t c = 0; c < contacts; ++c) {
      auto& row = rows[geometry.contacts[w].particle[c]];
      for (std::uint32_t const k : behind.pairs.row(c)) {
        for (auto const& [source, weight] : behind.placed[k - contacts].sources) row.push_back(source);
      }
    }
  }
  for (auto& row : rows) make_set(row);
  return rows;
}

}  // namespace

template <int Dim>
DependencyPattern dependencies(PairGeometry<Dim> const& geometry, int passes) {
  Rows const direct = one_pass(geometry);
  DependencyPattern pattern;
  pattern.first.push_back(0);
  for (auto const& row : direct) {
    std::vector<std::int64_t> reached = row;
    for (int pass = 1; pass < passes; ++pass) {
      std::vector<std::int64_t> const nearer = reached;
      for (std::int64_t const j : nearer) reached.insert(reached.end(), direct[j].begin(), direct[j].end());
      make_set(reached);
    }
    pattern.column.insert(pattern.column.end(), reached.begin(), reached.end());
    pattern.first.push_back(static_cast<std::int64_t>(pattern.column.size()));
  }
  return pattern;
}

template DependencyPattern dependencies(PairGeometry<1> const&, int);
template DependencyPattern dependencies(PairGeometry<2> const&, int);
template DependencyPattern dependencies(PairGeometry<3> const&, int);

}  // namespace sphverify
