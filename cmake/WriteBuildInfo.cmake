# SPDX-License-Identifier: GPL-3.0-or-later
# Run at every build: writes OUTPUT, a header that says what is being built, if it changed.
include("${CMAKE_CURRENT_LIST_DIR}/DescribeCommit.cmake")
sphverify_describe_commit("${SOURCE_DIR}" commit date)
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [=[
#pragma once

namespace sphverify::build {

inline constexpr char const* version = "@VERSION@";
inline constexpr char const* commit = "@commit@";
inline constexpr char const* compiler = "@COMPILER@";
inline constexpr char const* flags = "@FLAGS@";

}  // namespace sphverify::build
]=])
