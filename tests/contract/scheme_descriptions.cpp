// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cctype>
#include <set>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(scheme_descriptions)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(identifiers_are_unique_and_name_their_room) {
  std::set<std::string_view> ids;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    BOOST_TEST(ids.insert(scheme->id).second, scheme->id);
    std::string_view const room = scheme->rate == Rate::acceleration         ? "momentum/"
                                  : scheme->rate == Rate::conduction_heating ? "conduction/"
                                                                             : "work/";
    BOOST_TEST(scheme->id.starts_with(room), scheme->id);
    std::string_view const name = scheme->id.substr(room.size());
    BOOST_TEST(!name.empty());
    BOOST_TEST(std::ranges::all_of(
                   name, [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '-'; }),
               scheme->id);
  }
}

BOOST_AUTO_TEST_CASE(contract_identifiers_are_all_there) {
  for (std::string_view const id :
       {"momentum/p-rho2", "momentum/sqrt-p", "momentum/direct-gradient", "work/total-energy",
        "work/internal-energy", "work/sqrt-p", "conduction/lucy-flux", "conduction/brookshaw",
        "conduction/campbell-flux"}) {
    BOOST_TEST(find_scheme(id) != nullptr, id);
  }
}

BOOST_AUTO_TEST_CASE(title_source_equation_and_remarks_are_there) {
  std::set<std::string_view> titles;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    BOOST_TEST(!scheme->title.empty(), scheme->id);
    BOOST_TEST(titles.insert(scheme->title).second, scheme->id);
    bool const cited = scheme->source.find("Eq") != std::string_view::npos;
    BOOST_TEST(cited, scheme->id << " cites no equation");
    BOOST_TEST(!scheme->remarks.empty(), scheme->id);
    bool const formula = scheme->equation.find('=') != std::string_view::npos;
    BOOST_TEST(formula, scheme->id);
    auto const lines = 1 + std::ranges::count(scheme->equation, '\n');
    if (pass_count(*scheme) > 1) BOOST_TEST(lines == pass_count(*scheme), scheme->id << " has one line for each pass");
  }
}

BOOST_AUTO_TEST_CASE(needs_are_declared) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    BOOST_TEST(fields_read(*scheme).contains(Field::density), scheme->id);
    BOOST_TEST(!scheme->kernel.empty(), scheme->id);
    BOOST_TEST(!scheme->boundary.empty(), scheme->id);
    BOOST_TEST(fields_read(*scheme).contains(scheme->non_negative), scheme->id);
    BOOST_TEST(!fields_read(*scheme).contains(output_field(scheme->rate)), scheme->id);
  }
}

BOOST_AUTO_TEST_CASE(momentum_forms_and_only_they_name_an_energy_partner_that_exists) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    BOOST_TEST(scheme->work_partner.empty() == (scheme->rate != Rate::acceleration), scheme->id);
    if (scheme->work_partner.empty()) continue;
    SchemeInfo const* partner = find_scheme(scheme->work_partner);
    BOOST_TEST_REQUIRE(partner != nullptr, scheme->work_partner);
    BOOST_TEST((partner->rate == Rate::internal_work));
  }
}

BOOST_AUTO_TEST_CASE(only_the_rates_that_can_conserve_something_claim_it) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->conserves.contains(Invariant::momentum)) BOOST_TEST((scheme->rate == Rate::acceleration));
    if (scheme->conserves.contains(Invariant::energy)) BOOST_TEST((scheme->rate != Rate::acceleration));
  }
}

BOOST_AUTO_TEST_SUITE_END()
