// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/read_layout.hpp"

#include <algorithm>
#include <limits>

namespace sphverify {

namespace {

/// Of clumped and touching layouts, in particle spacings.
constexpr double default_separation = 0.1;
constexpr double default_gap = 1e-12;

}  // namespace

std::vector<LayoutChoice> read_layout(Node const& node) {
  std::vector<std::string> const ids{"lattice",    "jittered",  "clumped",      "touching",
                                     "equal-mass", "hexagonal", "close-packed", "glass", "random"};
  if (node.is_string()) {
    std::string const id = node.word(ids);
    if (id == "jittered") node.complain(R"({"id": "jittered", "amplitude": ..., "seed": ...})");
    if (id == "glass" || id == "random") node.complain(R"({"id": ")" + id + R"(", "seed": ...})");
    if (id == "clumped") return {{id, default_separation}};
    if (id == "touching") return {{id, default_gap}};
    return {{id}};
  }
  node.require_keys({"id", "amplitude", "seed", "seeds", "separation", "gap", "masses"});
  std::string const id = node.at("id").word(ids);
  auto const masses = node.find("masses");
  bool const voronoi = masses && masses->word({"layout", "voronoi"}) == "voronoi";
  if (voronoi && id == "equal-mass") masses->complain("none of voronoi: this layout is made of equal masses");
  if (id == "clumped" || id == "touching") {
    bool const clumps = id == "clumped";
    std::string const key = clumps ? "separation" : "gap";
    node.require_keys({"id", key, "masses"});
    auto const distance = node.find(key);
    double const away = distance ? distance->number_between(1e-15, clumps ? 1.0 : 0.5) : clumps ? default_separation : default_gap;
    return {{id, away, 0, voronoi}};
  }
  node.require_keys({"id", "amplitude", "seed", "seeds", "masses"});
  if (!is_drawn({id})) {
    node.require_keys({"id", "masses"});
    return {{id, 0.0, 0, voronoi}};
  }
  node.require_keys(id == "jittered" ? std::vector<std::string>{"id", "amplitude", "seed", "seeds", "masses"}
                                     : std::vector<std::string>{"id", "seed", "seeds", "masses"});
  double const amplitude = id == "jittered" ? node.at("amplitude").number_between(0.0, 0.499999) : 0.0;
  if (node.find("seed") && node.find("seeds")) node.complain("one of seed and seeds");
  auto const seeds = node.find("seeds") ? node.at("seeds").one_or_many() : std::vector<Node>{node.at("seed")};
  if (id == "jittered" && amplitude == 0.0 && seeds.size() > 1)
    node.at("seeds").complain("one seed: with an amplitude of 0 all of them give the same particles");
  std::vector<LayoutChoice> layouts;
  for (Node const& seed : seeds) {
    auto const value = static_cast<std::uint64_t>(seed.integer(0, std::numeric_limits<std::int64_t>::max()));
    LayoutChoice const layout{id, amplitude, value, voronoi};
    if (std::find(layouts.begin(), layouts.end(), layout) != layouts.end())
      seed.complain("every seed only once");
    layouts.push_back(layout);
  }
  return layouts;
}

}  // namespace sphverify
