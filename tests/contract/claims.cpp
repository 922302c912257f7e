// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/claims.hpp"

#include <boost/test/unit_test.hpp>

#include "formulations/rate_operator.hpp"
#include "harness/claims/defects.hpp"

// Every scheme is held to what it claims; and each question can be answered with no.
BOOST_AUTO_TEST_SUITE(claims)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(every_scheme_keeps_its_claims_and_claims_what_it_keeps) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    std::vector<ClaimResult> const results = check_claims(*scheme);
    BOOST_TEST(results.size() >= (scheme->needs_partners ? 6u : 7u), scheme->id);
    for (ClaimResult const& one : results) {
      BOOST_TEST(one.remark == "", scheme->id << ": " << one.claim);
      BOOST_TEST(one.holds() == one.claimed,
                 scheme->id << ": " << one.claim << ": " << one.found << " where " << one.allowed << " is allowed, in " << one.where);
    }
  }
}

/// What is found of a scheme that claims something else than it is.
double found_with(std::string_view id, Claims const& claims, std::string_view words) {
  SchemeInfo liar = *find_scheme(id);
  liar.claims = claims;
  for (ClaimResult const& one : check_claims(liar)) {
    if (one.claim.find(words) == std::string::npos) continue;
    BOOST_TEST(one.fails(), id << ": " << words);
    return one.found;
  }
  BOOST_ERROR("no claim about " << words);
  return 0.0;
}

BOOST_AUTO_TEST_CASE(a_claim_that_does_not_hold_fails) {
  // A pair of K = 1 and 3: the arithmetic mean is 4/3 of the harmonic, and far from it for 1 and 0.01.
  BOOST_TEST(found_with("conduction/brookshaw", {.steady_on_any_particles = true, .mean = ConductivityMean::harmonic},
                        "harmonic mean") > 0.3);
  BOOST_TEST(found_with("conduction/brookshaw", {.steady_on_any_particles = true, .mean = ConductivityMean::geometric},
                        "geometric mean") > 0.1);
  BOOST_TEST(found_with("momentum/p-rho2", {.lattice_factors = 0}, "exact derivative") > 1e-3);
  BOOST_TEST(found_with("conduction/campbell-flux", {.lattice_factors = 1}, "lattice's factor") > 1e-3);
  BOOST_TEST(found_with("momentum/p-rho2", {.steady_on_any_particles = true}, "any particles") > 1e-3);
  BOOST_TEST(found_with("work/total-energy", {}, "common velocity") > 1e-2);
  SchemeInfo liar = *find_scheme("momentum/direct-gradient");
  liar.conserves = {Invariant::momentum};
  bool found = false;
  for (ClaimResult const& one : check_claims(liar)) found = found || (one.fails() && one.claim == "pairs conserve momentum");
  BOOST_TEST(found);
}

BOOST_AUTO_TEST_CASE(a_harmonic_mean_is_no_failure_where_it_is_claimed) {
  // Of one and the same form: what is claimed decides, not what we like.
  Kernel const& kernel = default_kernel(2);
  SchemeInfo const& brookshaw = *find_scheme("conduction/brookshaw");
  BOOST_TEST(*sphverify::claims::conductivity_mean<2>(brookshaw, kernel) < 1e-14);
  SchemeInfo unknown = brookshaw;
  unknown.claims.mean = ConductivityMean::unknown;
  BOOST_TEST(!sphverify::claims::conductivity_mean<2>(unknown, kernel).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
