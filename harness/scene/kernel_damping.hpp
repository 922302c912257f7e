// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

class Kernel;

/// How fast viscosity between the particles of this kernel damps the velocity of one beside the others', as a multiple of
/// what the cubic spline does at the same h: the rate is a/h times the kernel's h^2 int |dW/dr|/r dV, with a the viscosity's
/// alpha c + beta mu, and does not depend on the number of neighbours.
double damping_over_cubic_spline(Kernel const& kernel);

}  // namespace sphverify
