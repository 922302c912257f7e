// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/available_memory.hpp"

#include <sys/resource.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <string>

BOOST_AUTO_TEST_SUITE(harness_study_available_memory)

using namespace sphverify;

/// A file system of its own, for as long as it lives.
struct Root {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("sphverify-cgroup-" + std::to_string(getpid()));

  Root() { std::filesystem::remove_all(path); }
  ~Root() { std::filesystem::remove_all(path); }

  void write(std::string const& file, std::string const& text) const {
    std::filesystem::create_directories((path / file).parent_path());
    std::ofstream(path / file) << text << "\n";
  }
  double limit() const { return control_group_limit(path); }
};

BOOST_AUTO_TEST_CASE(least_limit_of_the_groups_above_holds_too) {
  Root const root;
  BOOST_TEST(std::isinf(root.limit()));
  root.write("proc/self/cgroup", "0::/slice/job/step");
  BOOST_TEST(std::isinf(root.limit()));
  root.write("sys/fs/cgroup/slice/job/step/memory.max", "max");
  BOOST_TEST(std::isinf(root.limit()));
  root.write("sys/fs/cgroup/slice/memory.max", "4000000000");
  BOOST_TEST(root.limit() == 4e9);
  root.write("sys/fs/cgroup/slice/job/memory.max", "1000000000");
  BOOST_TEST(root.limit() == 1e9);
  root.write("sys/fs/cgroup/slice/job/step/memory.max", "2000000000");
  BOOST_TEST(root.limit() == 1e9);
  // What a container sees of its own group.
  root.write("proc/self/cgroup", "0::/");
  root.write("sys/fs/cgroup/memory.max", "500000000");
  BOOST_TEST(root.limit() == 5e8);
}

BOOST_AUTO_TEST_CASE(first_version_of_control_groups_is_read_by_its_controller) {
  Root const root;
  root.write("proc/self/cgroup", "12:cpu,cpuacct:/job\n4:memory:/job\n1:name=systemd:/job");
  root.write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "3000000000");
  root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  root.write("sys/fs/cgroup/job/memory.max", "1");  // of no group that the line names
  BOOST_TEST(root.limit() == 3e9);
}

// The address and thread sanitizers hold more address space than any limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
BOOST_AUTO_TEST_CASE(limit_of_the_process_counts) {
  double const before = available_memory();
  rlimit old{};
  BOOST_TEST_REQUIRE(getrlimit(RLIMIT_AS, &old) == 0);
  rlimit low = old;
  low.rlim_cur = static_cast<rlim_t>(0.5 * before);
  BOOST_TEST_REQUIRE(setrlimit(RLIMIT_AS, &low) == 0);
  rlimit now{};
  BOOST_TEST_REQUIRE(getrlimit(RLIMIT_AS, &now) == 0);
  if (now.rlim_cur != low.rlim_cur) return;  // an emulator that takes limits and ignores them
  BOOST_TEST(available_memory() == static_cast<double>(low.rlim_cur));
  BOOST_TEST_REQUIRE(setrlimit(RLIMIT_AS, &old) == 0);
  BOOST_TEST(available_memory() == before);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
