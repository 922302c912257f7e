// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/hdf5/library.hpp"

namespace sphverify::hdf5 {

std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

void be_quiet() {
  static std::once_flag once;
  std::call_once(once, [] { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); });
}

}  // namespace sphverify::hdf5
