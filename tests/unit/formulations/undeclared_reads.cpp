// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "formulations/conduction/campbell_flux.hpp"
#include "formulations/walls/views.hpp"

// Nothing here is called across files: how vectors are passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SPHVERIFY_INSTRUCTION_SET undeclared_reads_test
#include "formulations/sweep/views.hpp"

/// What a scheme reads but does not declare must not compile: at run time it would be somebody else's number.
BOOST_AUTO_TEST_SUITE(formulations_undeclared_reads)

using namespace sphverify;

constexpr FieldSet density_and_flux{Field::density, Field::flux};

template <class View>
constexpr bool reads_temperature = requires(View const& i) { i.T(); };
template <class View>
constexpr bool reads_density = requires(View const& i) { i.rho(); };
template <class View>
constexpr bool reads_flux = requires(View const& i) { i.F(); };
template <class View>
constexpr bool reads_velocity = requires(View const& i) { i.v(); };
template <class View>
constexpr bool reads_mass = requires(View const& i) { i.m(); };

template <class View>
constexpr bool reads_omega = requires(View const& i) { i.Omega(); };
template <class Kernel>
constexpr bool has_gradient = requires(Kernel const& W) { W.gradient(); };
template <class Kernel>
constexpr bool has_own_gradients = requires(Kernel const& W) {
  W.gradient_i();
  W.gradient_j();
};

template <FieldSet fields>
using InPacks = undeclared_reads_test::View<2, fields, undeclared_reads_test::ReadOwn>;

BOOST_AUTO_TEST_CASE(a_view_of_a_particle_has_what_is_declared_and_nothing_else) {
  BOOST_TEST((reads_density<InPacks<density_and_flux>> && reads_flux<InPacks<density_and_flux>>));
  BOOST_TEST(!(reads_temperature<InPacks<density_and_flux>> || reads_velocity<InPacks<density_and_flux>> ||
               reads_mass<InPacks<density_and_flux>>));
  using OfWall = ParticleView<2, density_and_flux>;
  BOOST_TEST((reads_density<OfWall> && reads_flux<OfWall>));
  BOOST_TEST(!(reads_temperature<OfWall> || reads_velocity<OfWall> || reads_mass<OfWall>));
}

BOOST_AUTO_TEST_CASE(a_kernel_has_the_gradients_that_are_declared) {
  using undeclared_reads_test::DeclaredKernel;
  using Columns = undeclared_reads_test::KernelOfPairs<2>;
  using Usual = DeclaredKernel<KernelWeightSet{KernelWeight::gradient}, Columns>;
  using Own = DeclaredKernel<KernelWeightSet{KernelWeight::own_gradients}, Columns>;
  BOOST_TEST((has_gradient<Usual> && !has_own_gradients<Usual>));
  BOOST_TEST((has_own_gradients<Own> && !has_gradient<Own>));
  using WithOmega = InPacks<FieldSet{Field::omega}>;
  BOOST_TEST((reads_omega<WithOmega> && !reads_omega<InPacks<density_and_flux>>));
  BOOST_TEST((reads_omega<ParticleView<2, FieldSet{Field::omega}>> && !reads_omega<ParticleView<2, density_and_flux>>));
}

BOOST_AUTO_TEST_CASE(a_view_of_a_wall_has_its_density_and_what_is_declared) {
  using View = WallView<3, BoundaryValueSet{BoundaryValue::temperature}>;
  BOOST_TEST((reads_density<View> && reads_temperature<View>));
  BOOST_TEST(!(reads_flux<View> || reads_velocity<View>));
}

template <class View>
constexpr bool reads_offset = requires(View const& one) { one.offset(); };

BOOST_AUTO_TEST_CASE(faces_of_cells_are_read_where_that_is_declared) {
  using namespace undeclared_reads_test;
  BOOST_TEST((reads_offset<DeclaredKernel<KernelWeightSet{KernelWeight::face_offset}, KernelOfPairs<2>>>));
  BOOST_TEST(!(reads_offset<DeclaredKernel<KernelWeightSet{KernelWeight::gradient, KernelWeight::radial}, KernelOfPairs<2>>>));
  BOOST_TEST((reads_offset<WallView<3, BoundaryValueSet{}, true>>));
  BOOST_TEST(!(reads_offset<WallView<3, BoundaryValueSet{}>>));
}

BOOST_AUTO_TEST_CASE(a_pass_reads_what_it_declares_and_what_passes_before_it_wrote) {
  BOOST_TEST((reads_of_pass<CampbellFlux, 0>() ==
              FieldSet{Field::mass, Field::density, Field::temperature, Field::conductivity}));
  BOOST_TEST((reads_of_pass<CampbellFlux, 1>() == FieldSet{Field::mass, Field::density, Field::flux}));
}

/// A scheme that promises a first pass and has no code for it.
struct WithoutItsPass {
  static constexpr SchemeInfo info{.id = "conduction/without-its-pass",
                                   .title = "",
                                   .source = "",
                                   .equation = "",
                                   .remarks = "",
                                   .rate = Rate::conduction_heating,
                                   .reads = {},
                                   .kernel = {},
                                   .boundary = {},
                                   .first_passes = {CampbellFlux::Flux::info}};
};
struct WithoutInfo {};

BOOST_AUTO_TEST_CASE(what_is_no_scheme_is_known_as_none) {
  BOOST_TEST(IsScheme<CampbellFlux>);
  BOOST_TEST(!IsScheme<WithoutInfo>);
  BOOST_TEST(!IsScheme<WithoutItsPass>);
}

BOOST_AUTO_TEST_SUITE_END()
