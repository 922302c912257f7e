#pragma once

namespace sphverify {

constexpr auto square(auto x) { return x * x; }

}  // namespace sphverify
