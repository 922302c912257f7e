// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/table/changes.hpp"

namespace sphverify {

Discretisation without_seed(Discretisation discretisation);

/// Whether items of two documents differ in nothing but what only one of them knows.
bool may_match(Series const& a, Series const& b);
bool may_match(Envelope const& a, Envelope const& b);

/// What lists call them.
std::string name_of(Series const& series);
std::string name_of(Envelope const& envelope);

/// Items of two documents that are the same, by the later one: those with the same parameters, and of what is
/// left those with no other value of any, where each is the other's only choice.
template <class Item>
std::map<Item const*, Item const*> matches(std::vector<Item> const& before, std::vector<Item> const& after) {
  std::map<Item const*, Item const*> found;
  std::set<Item const*> taken;  // of both documents
  auto const match = [&](Item const& a, Item const& b) {
    found[&b] = &a;
    taken.insert({&a, &b});
  };
  for (Item const& b : after) {
    auto const a = std::find_if(before.begin(), before.end(), [&](Item const& one) {
      return !taken.contains(&one) && may_match(one, b) && one.parameters == b.parameters;
    });
    if (a != before.end()) match(*a, b);
  }
  auto const only_choice = [&](Item const& item, std::vector<Item> const& others) -> Item const* {
    Item const* choice = nullptr;
    for (Item const& other : others) {
      if (taken.contains(&other) || !may_match(item, other)) continue;
      if (choice != nullptr) return nullptr;
      choice = &other;
    }
    return choice;
  };
  for (Item const& b : after) {
    Item const* const a = taken.contains(&b) ? nullptr : only_choice(b, before);
    if (a != nullptr && only_choice(*a, after) == &b) match(*a, b);
  }
  return found;
}

/// Calls back for every pair, and names what only one document has.
template <class Item, class Compare>
void match_all(std::vector<Item> const& before, std::vector<Item> const& after, Changes& changes,
               Compare const& compare) {
  auto const partners = matches(before, after);
  std::set<Item const*> taken;
  for (Item const& b : after) {
    auto const a = partners.find(&b);
    if (a == partners.end()) {
      changes.only_after.push_back(name_of(b));
      continue;
    }
    ++changes.in_both;
    taken.insert(a->second);
    compare(*a->second, b);
  }
  for (Item const& a : before) {
    if (!taken.contains(&a)) changes.only_before.push_back(name_of(a));
  }
}

}  // namespace sphverify
