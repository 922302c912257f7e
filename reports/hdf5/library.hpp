// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

// The HDF5 library as all of us use it.
namespace sphverify::hdf5 {

/// Held by whoever uses the library, which may not be built for several threads.
std::mutex& library();

/// The library tells of every failure on standard error unless it is asked not to.
void be_quiet();

/// What a file in memory is called: the library refuses the name of one that exists, and this one cannot.
inline constexpr char const* in_memory = "/dev/null/in-memory";

/// Closes what the library opened.
template <herr_t (*close)(hid_t)>
class Handle {
 public:
  explicit Handle(hid_t id = -1) : id_(id) {}
  ~Handle() {
    if (id_ >= 0) close(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  operator hid_t() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;
using Attribute = Handle<H5Aclose>;
using Set = Handle<H5Dclose>;
using Type = Handle<H5Tclose>;
using Space = Handle<H5Sclose>;
using Properties = Handle<H5Pclose>;

}  // namespace sphverify::hdf5
