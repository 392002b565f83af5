#pragma once

#include "components/mpm/conserving/extent.hpp"
#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/materials/gas.hpp"
#include "components/mpm/tasks/compute_pressure.hpp"

namespace tushar::mpm::conserving {

/// Intervals of equal length that tile each cell inside a body: N of h / N. Mass is density times volume. The slope of
/// velocity and the energy of the motion about the mean start at 0. Ids as in createParticles.
void createParticles(const Patch& patch, const Gas& gas, ParticleMaker& maker, std::vector<Vec<1>>& x,
                     std::vector<double>& length, std::vector<double>& mass, std::vector<Vec<1>>& velocity,
                     std::vector<double>& gradient, std::vector<double>& internalEnergy,
                     std::vector<double>& affineEnergy);

/// m_i = sum w m,   v_i = sum w m (v + B (x_i - x_p)) / m_i on the patch's nodes,
/// M_c = sum o m,   IE_c = sum o m e in its cells; w and o as in Extent. Walls: v_i = 0.
void interpolateParticlesToGrid(const Patch& patch, const Gas& gas, ParticleView<const Vec<1>> x,
                                ParticleView<const double> length, ParticleView<const double> mass,
                                ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
                                ParticleView<const double> internalEnergy, NodeView<double> nodeMass,
                                NodeView<Vec<1>> nodeVelocity, CellView<double> cellMass,
                                CellView<double> cellInternalEnergy);

/// p_c + q_c with p_c = (gamma - 1) IE_c / V_c and, where the cell is compressed (dv < 0),
/// q_c = rho_c |dv| (C_q |dv| + C_l c_c), dv the difference of its nodes' velocities.
void computeStress(const Patch& patch, const Gas& gas, const Viscosity& viscosity, CellView<const double> mass,
                   CellView<const double> internalEnergy, NodeView<const Vec<1>> velocity, CellView<double> stress);

/// a_i = (sigma_{i-1} - sigma_i) A / m_i, A the cross-section. Walls, and nodes without mass: 0.
void computeAcceleration(const Patch& patch, const Gas& gas, CellView<const double> stress,
                         NodeView<const double> mass, NodeView<Vec<1>> acceleration);

/// The least of cfl h / (|v| + c) over the particles, 0.4 h / max(-dv, (gamma - 1) dv) over the cells, and in each cell
/// the dt after which dt max(-dv*, (gamma - 1) dv*) = h / 2 with dv* = dv + dt da: no cell loses half its length.
void computeStableTimeStep(const Patch& patch, const Gas& gas, double cfl, ParticleView<const Vec<1>> velocity,
                           ParticleView<const double> internalEnergy, NodeView<const Vec<1>> nodeVelocity,
                           NodeView<const Vec<1>> acceleration, Minimum& dt);

/// The step of the particles, total energy conserved to round-off: with v* = v_i + a_i dt and v½ = v_i + a_i dt / 2,
/// f_c = max(-0.8, -sigma_c A (v½_{c+1} - v½_c) dt / IE_c)
/// e'  = e (1 + sum_c o f_c) + ½ sum_i w (v + B (x_i - x_p) - v_i)² + K_A - ½ I B²,    I = sum_i w (x_i - x_p)²
/// v'  = sum_i w v*,   K_A' = ½ (sum_i w v*² - v'²),   both ends move with v*, B' = their velocities' difference / L.
/// limitGradient has seen to it that e' stays positive.
void updateParticles(const Patch& patch, const Gas& gas, ParticleView<const Vec<1>> x, ParticleView<const double> length,
                     ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
                     ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                     NodeView<const Vec<1>> nodeVelocity, NodeView<const Vec<1>> acceleration,
                     CellView<const double> stress, CellView<const double> cellInternalEnergy, double dt,
                     ParticleView<Vec<1>> newX, ParticleView<double> newLength, ParticleView<Vec<1>> newVelocity,
                     ParticleView<double> newGradient, ParticleView<double> newInternalEnergy,
                     ParticleView<double> newAffineEnergy);

/// B is scaled down where ½ I B² could exceed K_A by more than e / 2; I is at most L² / 12 + h² / 4.
void limitGradient(const Patch& patch, const Gas& gas, ParticleView<const double> length,
                   ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                   ParticleView<double> gradient);

/// Halves particles longer than `longestInCells` cells: children at a quarter of the length to both sides of the centre with velocities
/// v ∓ L B / 4, whose kinetic energy comes from K_A, then from e. A child may lie in the next cell: each patch makes the
/// children that lie in its own cells, of its own particles and of its ghosts (1 cell).
void splitLong(const Patch& patch, const Gas& gas, ParticleMaker& maker, double longestInCells, ParticleView<const ParticleId> ids,
               ParticleView<const Vec<1>> x, ParticleView<const double> length, ParticleView<const double> mass,
               ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
               ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
               std::vector<Vec<1>>& newX, std::vector<double>& newLength, std::vector<double>& newMass,
               std::vector<Vec<1>>& newVelocity, std::vector<double>& newGradient,
               std::vector<double>& newInternalEnergy, std::vector<double>& newAffineEnergy);

}  // namespace tushar::mpm::conserving
