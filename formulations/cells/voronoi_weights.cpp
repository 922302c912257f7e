// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/cells/voronoi_weights.hpp"

#include <utility>

#include "formulations/basics/parallel.hpp"
#include "formulations/walls/finite_face.hpp"

namespace sphverify {

template <int Dim>
NeighbourList voronoi_pairs(VoronoiCells<Dim>&& cells, VectorField<Dim> const& positions, Domain<Dim> const& domain,
                            std::vector<double> const& mass, std::vector<double> const& density, int threads) {
  NeighbourList pairs = std::move(cells.faces);
  pairs.slope = std::move(cells.area);
  for (std::size_t k = 0; k < Dim; ++k) pairs.offset[k] = std::move(cells.offset[k]);
  for_each_row(pairs.rows(), threads, [&](std::size_t i) {
    for (std::size_t k = pairs.first[i]; k < pairs.first[i + 1]; ++k) {
      std::size_t const j = pairs.neighbour[k];
      double const distance = domain.nearest_image(positions[i] - positions[j]).norm();
      // The product of both volumes first: it has the same bits from either side, and so have the weights.
      pairs.slope[k] *= -0.5 * ((density[i] * density[j]) / (mass[i] * mass[j])) / distance;
    }
  });
  return pairs;
}

template <int Dim>
WallContacts<Dim> voronoi_contacts(WallFaces<Dim> const& faces, CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& all_walls,
                                   std::size_t index, SmoothingLength const& h, std::vector<double> const& mass,
                                   std::vector<double> const& density) {
  Wall<Dim> const& wall = all_walls[index];
  VectorField<Dim> const& positions = grid.positions();
  WallContacts<Dim> contacts;
  contacts.outward_normal = wall.outward_normal;
  contacts.prescribes_flux_only = wall.prescribes_flux_only();
  contacts.particle = faces.particle;
  contacts.foot = VectorField<Dim>(faces.particle.size());
  if (!faces.offset.empty()) contacts.offset = VectorField<Dim>(faces.particle.size());
  contacts.interpolation_first.push_back(0);
  for (std::size_t c = 0; c < faces.particle.size(); ++c) {
    std::uint32_t const i = faces.particle[c];
    Vector<Dim> const foot = wall.foot(positions[i]);
    contacts.distance.push_back(wall.distance(positions[i]));
    contacts.face_weight.push_back(0.5 * faces.area[c] * density[i] / mass[i]);
    contacts.foot_density.push_back(density[i]);
    contacts.foot.set(c, foot);
    if (!faces.offset.empty()) contacts.offset.set(c, faces.offset[c]);
    // Beyond an obtuse corner there is nothing to interpolate from: the face's nearest point stands for it.
    Vector<Dim> const within = nearest_on_face(positions[i], all_walls, index, h(i)).value_or(foot);
    if (add_foot_interpolation(contacts, grid, within, all_walls, h(i), mass, h.kernel()) <= 0.0) {
      // Beyond the kernel's support: what the particle has is all that is known there.
      contacts.interpolation_neighbour.push_back(i);
      contacts.interpolation_kernel.push_back(density[i] / mass[i]);
    }
    contacts.interpolation_first.push_back(contacts.interpolation_neighbour.size());
  }
  return contacts;
}

template <int Dim>
void weigh_by_cells(PairGeometry<Dim>& geometry, VoronoiCells<Dim>&& cells, CellGrid<Dim> const& grid, SmoothingLength const& h,
                    std::vector<double> const& mass, std::vector<double> const& density, int threads) {
  geometry.contacts.clear();
  for (std::size_t w = 0; w < geometry.walls.size(); ++w)
    geometry.contacts.push_back(voronoi_contacts(cells.walls[w], grid, geometry.walls, w, h, mass, density));
  geometry.neighbours = voronoi_pairs(std::move(cells), grid.positions(), geometry.domain, mass, density, threads);
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                                        \
  template NeighbourList voronoi_pairs(VoronoiCells<Dim>&&, VectorField<Dim> const&, Domain<Dim> const&,                  \
                                       std::vector<double> const&, std::vector<double> const&, int);                      \
  template WallContacts<Dim> voronoi_contacts(WallFaces<Dim> const&, CellGrid<Dim> const&, std::vector<Wall<Dim>> const&,      \
                                              std::size_t, SmoothingLength const&, std::vector<double> const&,            \
                                              std::vector<double> const&);                                                \
  template void weigh_by_cells(PairGeometry<Dim>&, VoronoiCells<Dim>&&, CellGrid<Dim> const&, SmoothingLength const&,     \
                               std::vector<double> const&, std::vector<double> const&, int);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
