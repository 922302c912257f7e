# SPDX-License-Identifier: GPL-3.0-or-later
# Run at every build: writes OUTPUT, a header that says what is being built, if it changed.
find_program(GIT_PROGRAM git)
set(commit "unknown")
set(date "")
if(GIT_PROGRAM AND EXISTS "${SOURCE_DIR}/.git")
  execute_process(COMMAND "${GIT_PROGRAM}" -C "${SOURCE_DIR}" describe --always --dirty --abbrev=12
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
  execute_process(COMMAND "${GIT_PROGRAM}" -C "${SOURCE_DIR}" log -1 --date=short --format=%cd
                  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
# Of the sources, for the manual: equal sources give equal files.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  string(TIMESTAMP date "%Y-%m-%d" UTC)
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
