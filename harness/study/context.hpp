#pragma once

#include "reports/results.hpp"

namespace sphverify {

/// Version, build, machine and date of this process.
Context current_context();

}  // namespace sphverify
