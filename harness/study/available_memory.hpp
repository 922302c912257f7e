// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace sphverify {

/// Bytes that this process may have: the machine's memory, or less where a limit on the process (ulimit -v)
/// or on its control group (a container, a batch job) says so.
double available_memory();

/// The least memory limit of the process's control group and of those that hold it, of either version of
/// Linux' control groups; infinite where there is none. [bytes]
/// @param root of the file system that holds /proc and /sys
double control_group_limit(std::filesystem::path const& root);

}  // namespace sphverify
