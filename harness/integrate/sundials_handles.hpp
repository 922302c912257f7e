// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "formulations/basics/finite.hpp"
#include "harness/integrate/ode.hpp"

namespace sphverify {

/// Owns a SUNDIALS context; everything else of a run hangs on it.
class SundialsContext {
 public:
  SundialsContext() {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::runtime_error("SUNDIALS: no context");
  }
  ~SundialsContext() { SUNContext_Free(&context_); }
  SundialsContext(SundialsContext const&) = delete;
  SundialsContext& operator=(SundialsContext const&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

struct DestroyVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct DestroyMatrix {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct DestroySolver {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};

using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, DestroyVector>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, DestroyMatrix>;
using SolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, DestroySolver>;

/// A SUNDIALS vector over memory that the caller keeps alive.
inline VectorHandle wrap(std::size_t size, double* data, SUNContext context) {
  VectorHandle vector(N_VMake_Serial(static_cast<sunindextype>(size), data, context));
  if (!vector) throw std::bad_alloc();
  return vector;
}

/// What a SUNDIALS callback gets as user data. Exceptions must not cross the library's C frames: they are
/// kept here, the callback fails, and `rethrow` lets them go on.
/// A RateFailure, or a rate that is not finite, is a recoverable failure: the integrator tries a shorter step,
/// and gives up in the end.
struct CallbackData {
  OdeSystem const& system;
  std::exception_ptr error = nullptr;
  std::exception_ptr failure = nullptr;     ///< the last of a rate, for when the integrator gives up
  std::optional<std::size_t> not_finite{};  ///< of the last rate: the first unknown that it is no number for
  std::optional<std::size_t> not_finite_in_step{};  ///< the same of any rate since `begin_step`

  void begin_step() { not_finite_in_step.reset(); }

  template <class Body>
  static int guarded(void* user, Body const& body) {
    auto& data = *static_cast<CallbackData*>(user);
    try {
      body(data.system);
      return 0;
    } catch (RateFailure const&) {
      data.failure = std::current_exception();
      return 1;
    } catch (...) {
      data.error = std::current_exception();
      return -1;
    }
  }
  static int require_finite(void* user, int status, N_Vector rate) {
    auto& data = *static_cast<CallbackData*>(user);
    data.not_finite.reset();
    if (status != 0) return status;
    data.not_finite =
        first_not_finite({N_VGetArrayPointer(rate), static_cast<std::size_t>(N_VGetLength(rate))});
    if (data.not_finite) data.not_finite_in_step = data.not_finite;
    return data.not_finite ? 1 : 0;
  }
  void rethrow() const {
    if (error) std::rethrow_exception(error);
  }
  void rethrow_failure() const {
    if (failure) std::rethrow_exception(failure);
  }
};

/// The integrator ended the run: because a rate is no number, or for its own reason.
inline void give_up(std::optional<std::size_t> not_finite, std::string reason, OdeResult& result) {
  result.outcome = not_finite ? OdeOutcome::not_finite : OdeOutcome::failed;
  result.not_finite = not_finite.value_or(0);
  result.reason = std::move(reason);
}

/// Throws std::runtime_error if a set-up call failed: that is our mistake or lack of memory, never a result.
inline void require_sundials(int flag, char const* call) {
  if (flag < 0)
    throw std::runtime_error(std::string("SUNDIALS: ") + call + " failed with " + std::to_string(flag));
}

}  // namespace sphverify
