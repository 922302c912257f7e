// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/density/density.hpp"
#include "formulations/kernels/kernel.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"
#include "formulations/walls/walls.hpp"
#include "harness/study/words.hpp"

namespace sphverify {

/// Identifiers of the choices that a discretisation offers, as written in documents.
inline constexpr Words<DensityRule, 5> density_words{{{{"given", DensityRule::given},
                                                       {"summation", DensityRule::summation},
                                                       {"normalised", DensityRule::normalised},
                                                       {"continuity", DensityRule::continuity},
                                                       {"voronoi", DensityRule::voronoi}}}};

inline constexpr Words<PairWeight, 2> pair_weight_words{{{{"kernel", PairWeight::kernel}, {"voronoi", PairWeight::voronoi}}}};

/// What may stand for walls: a form's own terms, nothing, or a treatment.
inline std::vector<std::string> wall_words() {
  std::vector<std::string> words{"on", "off"};
  for (WallTreatmentPart const& one : all_wall_treatments()) words.emplace_back(one.info->id);
  return words;
}

/// Kernels that documents may name.
inline std::vector<std::string> kernel_words() {
  std::vector<std::string> words;
  for (KernelInfo const& one : all_kernel_infos()) words.emplace_back(one.id);
  return words;
}

inline constexpr Words<FaceWeight, 3> face_weight_words{
    {{{"campbell", FaceWeight::campbell}, {"exact", FaceWeight::exact}, {"balanced", FaceWeight::balanced}}}};

inline constexpr Words<Closure, 3> closure_words{{{{"interpolated", Closure::interpolated},
                                                   {"quotient", Closure::quotient},
                                                   {"one-sided", Closure::one_sided}}}};

inline constexpr Words<WallMotion, 2> wall_motion_words{
    {{{"velocity", WallMotion::velocity}, {"mass", WallMotion::mass}}}};

}  // namespace sphverify
