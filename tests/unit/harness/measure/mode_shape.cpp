// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/mode_shape.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "cases/support/boxes.hpp"
#include "formulations/layouts/layout.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_mode_shape)

using namespace sphverify;
using boost::test_tools::tolerance;

constexpr double two_pi = 2.0 * std::numbers::pi;

template <int Dim>
struct Lattice {
  explicit Lattice(int n, bool periodic) : particles(positions(n).size(), 1.2 / n) {
    particles.positions() = positions(n);
    domain.lower = Vector<Dim>::Zero();
    domain.upper = Vector<Dim>::Ones();
    domain.periodic.fill(periodic);
  }
  static VectorField<Dim> positions(int n) {
    Domain<Dim> box;
    box.lower = Vector<Dim>::Zero();
    box.upper = Vector<Dim>::Ones();
    return lattice(box, n).positions;
  }
  Eigen::VectorXcd wave(Vector<Dim> const& k) const {
    Eigen::VectorXcd v(static_cast<Eigen::Index>(particles.size()));
    for (std::size_t i = 0; i < particles.size(); ++i)
      v[static_cast<Eigen::Index>(i)] = std::polar(1.0, k.dot(particles.positions()[i]));
    return v;
  }
  Particles<Dim> particles;
  Domain<Dim> domain;
};

BOOST_AUTO_TEST_CASE(the_wavelength_of_a_plane_wave_is_found) {
  Lattice<1> const line(24, true);
  for (int const waves : {1, 3, 8, 12}) {
    Mode const mode = mode_shape<1>({-1.0, 2.0}, line.wave(Vector<1>(two_pi * waves)), line.particles,
                                    line.domain, {}, 1.0 / 24);
    BOOST_TEST(mode.wavelength.value() == 24.0 / waves, tolerance(1e-6));
    BOOST_TEST(mode.growth == -1.0);
    BOOST_TEST(mode.frequency == 2.0);
    BOOST_TEST(!mode.wall_share.has_value());
  }
  Lattice<2> const square(16, true);
  Mode const along =
      mode_shape<2>(0.0, square.wave({two_pi * 4, 0.0}), square.particles, square.domain, {}, 1.0 / 16);
  BOOST_TEST(along.wavelength.value() == 4.0, tolerance(1e-6));
  // A chequerboard is shorter than any wave along an axis: given as the shortest.
  Mode const board = mode_shape<2>(0.0, square.wave({two_pi * 8, two_pi * 8}), square.particles,
                                   square.domain, {}, 1.0 / 16);
  BOOST_TEST(board.wavelength.value() == 2.0, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_mode_that_is_the_same_everywhere_has_no_wavelength) {
  Lattice<1> const line(10, true);
  Mode const mode =
      mode_shape<1>(0.0, Eigen::VectorXcd::Constant(10, 2.0), line.particles, line.domain, {}, 0.1);
  BOOST_TEST(!mode.wavelength.has_value());
  BOOST_TEST(mode.centre.at(0) == 0.5, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_mode_at_a_wall_is_seen_there) {
  Lattice<1> const line(50, false);
  std::vector<Wall<1>> const walls{{.point = Vector<1>(0.0), .outward_normal = Vector<1>(-1.0)},
                                   {.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)}};
  Eigen::VectorXcd v = Eigen::VectorXcd::Zero(50);
  v[0] = 3.0;          // x = 0.01, within 2h = 0.048 of the wall
  v[25] = {0.0, 1.0};  // x = 0.51
  Mode const mode = mode_shape<1>(0.0, v, line.particles, line.domain, walls, 0.02);
  BOOST_TEST(mode.wall_share.value() == 0.9, tolerance(1e-12));
  BOOST_TEST(mode.centre.at(0) == 0.9 * 0.01 + 0.1 * 0.51, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
