// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace sphverify::bench {

/// Registers the plain loops for each number of particles per side of the cube, as
/// hand-written/WORK/HOW/SIDE.
void register_hand_written(std::span<std::size_t const> sides);

/// Registers the product's sweeps likewise, as product/WORK/SIDE.
void register_product(std::span<std::size_t const> sides);

/// Registers the product's conduction on a line of particles, as product/line/WORK/PARTICLES.
void register_line();

/// Registers one evaluation of whole scenes, with all that a scene can ask for and without one of it each, as
/// scene/WHICH/SIDE. Counters: what an evaluation visits and takes, and what the scene holds, per particle.
void register_scenes(std::span<std::size_t const> sides);

/// Compares the plain loops' fast forms with their simple ones on a small cube.
/// @return an empty text, or which differs by more than 1e-12 of the largest value
std::string check_hand_written();

}  // namespace sphverify::bench
