// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "formulations/kernels/kernel.hpp"
#include "tests/support/runs.hpp"

/// Runs with every kernel of the list: a run takes the kernel that it names, and what schemes conserve they conserve with
/// any.
BOOST_AUTO_TEST_SUITE(harness_run_kernels)

using namespace sphverify;
using namespace sphverify::tests;

RunRecord run_with(std::string_view kernel, RunChoice choice) {
  choice.discretisation.kernel = kernel;
  RunSpec spec = make_spec(choice);
  if (choice.formulation.starts_with("momentum/")) spec.formulation.work = "work/internal-energy";
  RunOptions options;
  options.measure = {Measure::error, Measure::conservation};
  RunRecord const record = execute(spec, options);
  BOOST_TEST_REQUIRE(record.status == "ok", kernel << ": " << record.reason);
  BOOST_TEST(record.discretisation.kernel == kernel);
  return record;
}

BOOST_AUTO_TEST_CASE(gas_keeps_its_momentum_with_every_kernel) {
  for (KernelInfo const& kernel : all_kernel_infos()) {
    for (char const* smoothing : {"uniform", "adaptive"}) {
      RunChoice choice{.scene_case = "hydro/acoustic",
                       .formulation = "momentum/p-rho2",
                       .resolution = 20,
                       .smoothing_ratio = 1.5};
      choice.discretisation.density = "continuity";
      choice.discretisation.integrator = "leapfrog";
      choice.discretisation.smoothing = smoothing;
      RunRecord const record = run_with(kernel.id, choice);
      BOOST_TEST(std::abs(record.momentum.at(0).drift) < 1e-14, kernel.id << ", " << smoothing);
    }
  }
}

BOOST_AUTO_TEST_CASE(pairs_of_brookshaws_form_make_no_energy_with_any_kernel) {
  for (KernelInfo const& kernel : all_kernel_infos()) {
    RunChoice choice{.resolution = 40, .smoothing_ratio = 1.3, .parameters = {{"final_time", 0.002}}};
    choice.discretisation.layout = {"jittered", 0.1, 3};
    Budget const energy = run_with(kernel.id, choice).conservation.at("energy");
    BOOST_TEST(std::abs(energy.pair_drift.value()) < 1e-12, kernel.id);
  }
}

BOOST_AUTO_TEST_CASE(each_kernel_gives_an_error_of_its_own) {
  std::set<double> errors;
  for (KernelInfo const& kernel : all_kernel_infos()) {
    errors.insert(run_with(kernel.id, {.resolution = 50}).errors.at("temperature").at("all").error.l2);
  }
  BOOST_TEST(errors.size() == all_kernel_infos().size());
}

/// Of support 3h it sees half as far again as the others, which at h/dx = 1.2 are on their floors
/// (docs/findings/kernels-and-integrators.md).
BOOST_AUTO_TEST_CASE(the_quintic_spline_lowers_the_floor_at_the_same_smoothing_ratio) {
  auto const error = [](std::string_view kernel) {
    return run_with(kernel, {.resolution = 100}).errors.at("temperature").at("all").error.l2;
  };
  BOOST_TEST(error("quintic-spline") < 0.2 * error("cubic-spline"));
}

BOOST_AUTO_TEST_SUITE_END()
