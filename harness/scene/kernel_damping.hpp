// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

class Kernel;

/// h^2 int |dW/dr|/r dV, of the cubic spline 2.77, 20/7 and 3 in one to three dimensions. Viscosity whose pressure over density
/// grows as a mu damps a particle's velocity beside that of the others at a/h times this, whatever the number of neighbours, and
/// particles against each other at up to twice that (Gershgorin): an explicit step is stable up to h over a times this.  [1]
double kernel_damping(Kernel const& kernel);

}  // namespace sphverify
