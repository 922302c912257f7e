// SPDX-License-Identifier: GPL-3.0-or-later
// What libFuzzer calls. SPHVERIFY_FUZZ_TARGET names the target: one program holds all of them, since each
// would be as large.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/target.hpp"

namespace {

sphverify::fuzz::Target const* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  char const* const name = std::getenv("SPHVERIFY_FUZZ_TARGET");
  target = &sphverify::fuzz::target_named(name == nullptr ? "" : name);
  sphverify::fuzz::enter_folder();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  try {
    sphverify::fuzz::take(*target, {reinterpret_cast<char const*>(data), size});
  } catch (std::exception const& error) {
    std::fprintf(stderr, "a fault: %s\n", error.what());
    std::abort();
  }
  return 0;
}
