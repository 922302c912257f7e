// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace sphverify {

/// As the system calls it; "unknown" where it does not say.
std::string processor_name();

/// Tells this machine from others without saying which it is: times of two machines are not compared.
std::string const& machine_name();

/// Cores that this process may use: what is bound to some of them has no more.
int own_cores();

}  // namespace sphverify
