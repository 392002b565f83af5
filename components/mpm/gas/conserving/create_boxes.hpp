#pragma once

#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::conserving {

/// Boxes that tile each cell inside a body, `res` along each axis; ids as in createParticles. Mass, momentum, the modes
/// of velocity and total energy are integrals of the body's state over the box (Gauss-Legendre, 3 points per axis; a
/// state that is uniform is taken as it is), the motion that modes cannot hold counts as internal energy.
template <int D>
void createBoxes(const Patch& patch, const Gas& gas, ParticleMaker& maker, std::vector<Vec<D>>& x,
                 std::vector<Vec<D>>& edges, std::vector<double>& mass, std::vector<Vec<D>>& velocity,
                 std::vector<Modes<D>>& modes, std::vector<double>& internalEnergy, std::vector<double>& affineEnergy);

}  // namespace tushar::mpm::gas::conserving
