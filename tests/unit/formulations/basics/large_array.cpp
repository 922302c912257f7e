// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/large_array.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <numeric>

BOOST_AUTO_TEST_SUITE(formulations_basics_large_array)

using namespace sphverify;

constexpr std::size_t page = 2u << 20;

BOOST_AUTO_TEST_CASE(large_ones_begin_at_a_large_page) {
  LargeArray<std::uint32_t> const array(page + 1);  // four times that in bytes
  BOOST_TEST(reinterpret_cast<std::uintptr_t>(array.data()) % page == 0u);
}

BOOST_AUTO_TEST_CASE(elements_stay_when_it_grows_from_small_to_large_and_are_copied_and_moved) {
  LargeArray<std::uint32_t> array(1000);
  std::iota(array.begin(), array.end(), 0u);
  for (std::uint32_t n = 1000; n < 3 * page; ++n) array.push_back(n);
  LargeArray<std::uint32_t> const copy = array;
  LargeArray<std::uint32_t> const moved = std::move(array);
  BOOST_TEST((copy == moved));
  std::uint32_t wrong = 0;
  for (std::uint32_t n = 0; n < moved.size(); ++n) wrong += moved[n] != n;
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(more_than_there_is_is_refused) {
  LargeArrayAllocator<std::uint64_t> allocator;
  BOOST_CHECK_THROW(allocator.allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // which ends the program where a system would refuse
  BOOST_CHECK_THROW(allocator.allocate(static_cast<std::size_t>(-1) / 32), std::bad_alloc);
#endif
}

BOOST_AUTO_TEST_SUITE_END()
