#pragma once

#include "components/mpm/gas/conserving/boxes.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::conserving {

/// Creates boxes that tile each cell inside a body, with `res` boxes along each axis and the same ids as in
/// createParticles. Mass, momentum, velocity modes and total energy are integrals of the body's state over the box
/// (Gauss-Legendre, 3 points per axis, unless the state is uniform); kinetic energy that the modes cannot represent
/// becomes internal energy.
template <int D>
void createBoxes(const Patch& patch, const Gas& gas, ParticleMaker& maker, const NewBoxes<D>& boxes);

}  // namespace tushar::mpm::gas::conserving
