#include "cases/all.hpp"

#include "cases/support/case.hpp"

namespace sphverify {

std::vector<Case> const& all_cases() {
  static std::vector<Case> const cases = std::apply(
      [](auto... one) { return std::vector<Case>{{decltype(one)::info(), &decltype(one)::problem}...}; }, AllCases{});
  return cases;
}

Case const* find_case(std::string_view id) {
  for (Case const& one : all_cases()) {
    if (one.info.id == id) return &one;
  }
  return nullptr;
}

}  // namespace sphverify
