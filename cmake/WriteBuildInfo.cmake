# SPDX-License-Identifier: GPL-3.0-or-later
# Run at every build: writes OUTPUT, a header that says what is being built, if it changed.
include("${CMAKE_CURRENT_LIST_DIR}/DescribeCommit.cmake")
sphverify_describe_commit("${SOURCE_DIR}" commit date)
set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
# The manual has the day of the sources, so that equal sources give equal files.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  string(TIMESTAMP date "%Y-%m-%d" UTC)
elseif(date MATCHES "([0-9]+) ([A-Z][a-z]+) ([0-9]+)")
  list(FIND months ${CMAKE_MATCH_2} month)
  math(EXPR month "101 + ${month}")
  math(EXPR day "100 + ${CMAKE_MATCH_1}")
  string(REGEX REPLACE "-1" "-" date "${CMAKE_MATCH_3}-${month}-${day}")
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
