// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/bad_value.hpp"

#include <utility>

namespace sphverify {

BadValue::BadValue(std::string of, std::string wanted, std::string given)
    : std::invalid_argument(of + " must be " + wanted + (given.empty() ? "" : ", found " + given)),
      quantity(std::move(of)),
      expected(std::move(wanted)),
      found(std::move(given)) {}

}  // namespace sphverify
