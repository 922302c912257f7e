#include "formulations/support/pair_weights.hpp"

#include "formulations/support/cubic_spline.hpp"

namespace sphverify {

template <int Dim>
std::size_t PairWeights<Dim>::bytes() const {
  return sizeof(double) * (Dim * gradient.component(0).capacity() + radial.capacity());
}

template <int Dim>
PairWeights<Dim> evaluate_kernel(NeighbourList const& neighbours, VectorField<Dim> const& positions,
                                 Domain<Dim> const& domain, SmoothingLength const& h,
                                 KernelWeightSet wanted) {
  bool const with_gradient = wanted.contains(KernelWeight::gradient);
  bool const with_radial = wanted.contains(KernelWeight::radial);
  PairWeights<Dim> weights;
  if (with_gradient) weights.gradient = VectorField<Dim>(neighbours.pairs());
  if (with_radial) weights.radial.resize(neighbours.pairs());
  for (std::size_t i = 0; i < neighbours.rows(); ++i) {
    Vector<Dim> const x = positions[i];
    for (std::size_t k = neighbours.first[i]; k < neighbours.first[i + 1]; ++k) {
      std::uint32_t const j = neighbours.neighbour[k];
      Vector<Dim> const separation = domain.nearest_image(x - positions[j]);
      double const radial = CubicSpline<Dim>::radial(separation.norm(), h(i, j));
      if (with_gradient) weights.gradient.set(k, radial * separation);
      if (with_radial) weights.radial[k] = radial;
    }
  }
  return weights;
}

template struct PairWeights<1>;
template struct PairWeights<2>;
template struct PairWeights<3>;
template PairWeights<1> evaluate_kernel(NeighbourList const&, VectorField<1> const&, Domain<1> const&,
                                        SmoothingLength const&, KernelWeightSet);
template PairWeights<2> evaluate_kernel(NeighbourList const&, VectorField<2> const&, Domain<2> const&,
                                        SmoothingLength const&, KernelWeightSet);
template PairWeights<3> evaluate_kernel(NeighbourList const&, VectorField<3> const&, Domain<3> const&,
                                        SmoothingLength const&, KernelWeightSet);

}  // namespace sphverify
