# SPDX-License-Identifier: GPL-3.0-or-later
# Run at every build: writes OUTPUT, a header that says what is being built, if it changed.
include("${CMAKE_CURRENT_LIST_DIR}/DescribeCommit.cmake")
sphverify_describe_commit("${SOURCE_DIR}" commit date)
# The manual has the day of the sources, so that equal sources give equal files.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  string(TIMESTAMP date "%d %b %Y" UTC)
elseif(date MATCHES "[0-9]+ [A-Z][a-z]+ [0-9]+")
  set(date "${CMAKE_MATCH_0}")
endif()
if(NOT TYPE)
  set(TYPE "none")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [=[
#pragma once

namespace sphverify::build {

inline constexpr char const* version = "@VERSION@";
inline constexpr char const* commit = "@commit@";
inline constexpr char const* compiler = "@COMPILER@";
inline constexpr char const* flags = "@FLAGS@";
inline constexpr char const* date = "@date@";
inline constexpr char const* type = "@TYPE@";

}  // namespace sphverify::build
]=])
