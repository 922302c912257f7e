// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "cases/support/case.hpp"
#include "formulations/kernels/kernel_of.hpp"
#include "formulations/scheme_operator.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"
#include "harness/study/context.hpp"

namespace sphverify {

struct Program {
  std::string_view name = "sphverify";
  void (*add_parts)() = nullptr;  ///< calls add_scheme, add_kernel, add_wall_treatment and add_case for what is not ours
};

/// All commands; what a program's `main` returns.
int program_main(int argc, char** argv, Program const& program);

// What a program has beside our parts. Each is listed, described, studied, evaluated and compared like ours; results name
// it among `context.added`. sphverify_add_program of CMake writes the calls.

/// @tparam Scheme what formulations/scheme.hpp describes; a file that CMake made has its loops over pairs
template <class Scheme>
void add_scheme() {
  add_scheme(scheme_part<Scheme>());
  note_added_part(Scheme::info.id);
}

/// @tparam Kernel what formulations/kernels/scaled.hpp describes; a file that CMake made has it over columns of distances
template <template <int> class Kernel>
void add_kernel() {
  add_kernel(kernel_part<Kernel>());
  note_added_part(Kernel<1>::id);
}

/// @tparam Treatment what formulations/wall_particles/wall_treatment.hpp describes
template <class Treatment>
void add_wall_treatment() {
  add_wall_treatment(wall_treatment_part<Treatment>());
  note_added_part(Treatment::info.id);
}

/// @tparam Definition what cases/support/case.hpp describes
template <class Definition>
void add_case() {
  Case const one = case_part<Definition>();
  add_case(one);
  note_added_part(one.info.id);
}

}  // namespace sphverify
