// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/large_array.hpp"

#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace sphverify {

namespace {

constexpr std::size_t page = std::size_t{2} << 20;  // on x86-64, and on AArch64 where small ones have 4 kB
constexpr std::size_t worth_it = 2 * page;

std::size_t whole_pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }

}  // namespace

void* allocate_large(std::size_t bytes) {
  if (bytes < worth_it) return ::operator new(bytes);
  void* const memory = std::aligned_alloc(page, whole_pages(bytes));
  if (!memory) throw std::bad_alloc();
#if defined(__linux__)
  // A wish: where the system has no large pages to give, it gives small ones.
  madvise(memory, whole_pages(bytes), MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept {
  if (bytes < worth_it) {
    ::operator delete(memory);
  } else {
    std::free(memory);
  }
}

}  // namespace sphverify
