#pragma once

#include <Eigen/LU>

#include <vector>

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid::implicit {

/// A node near a particle: S_i, its gradient [1/m] and, in axisymmetric scenes, S_i / r [1/m].
template <int D>
struct NodeTouch {
  int node = -1;  ///< index in the system; -1: not in the system
  double s = 0, hoop = 0;
  Vec<D> gradient, sign;  ///< gradient of S_i, and the sign with which the node moves the particle along each axis
};

/// The particles of a material on a patch, contiguous in memory, with their state before the step.
struct PointGroup {
  const Material* material = nullptr;
  int count = 0;
  std::size_t first = 0;  ///< index of the first particle among all points of the system
  const double *mass = nullptr, *temperature = nullptr;
  const Matrix3 *oldDeformation = nullptr, *oldStress = nullptr;
  const double* oldState = nullptr;  ///< state before the step, stateSize numbers for each particle
  /// State at the end of the step, stateSize numbers for each particle; null: not requested.
  double* newState = nullptr;
  double* strainEnergy = nullptr;       ///< strain energy [J]; null: not requested
  double* temperatureChange = nullptr;  ///< temperature change [K]; null: not requested
};

/// The particles of a group that are in one cell, contiguous in memory.
struct PointRun {
  const PointGroup* group;
  int from, count;
};

/// Computes deformation gradients and stresses at the end of a step.
class PointStates {
 public:
  PointStates(std::size_t count, int stateSize, double dt, bool sharesVolume)
      : deformation(count),
        stress(count),
        gradient(count),
        stretch(count, 1.0),
        state_size_(stateSize),
        dt_(dt),
        shares_volume_(sharesVolume),
        f_bar_(count) {}

  std::vector<Matrix3> deformation, stress;  ///< deformation gradient F [1], and Cauchy stress [Pa]
  /// Gradient of the displacement with respect to the position at the start of the step [1].
  std::vector<Matrix3> gradient;
  std::vector<double> stretch;  ///< factor of F in F-bar, which is passed to the model [1]

  /// Whether F-bar applies to the points of a run: only for models that support it.
  bool sharesVolume(const PointRun& run) const { return shares_volume_ && run.group->material->model->supportsFBar(); }
  /// Computes F = (I + gradient) F_old of a run. Returns false if the step would turn a point inside out or compress it
  /// to a tenth of its volume.
  bool deform(const PointRun& run) {
    for (int k = run.from; k < run.from + run.count; ++k) {
      const std::size_t at = run.group->first + k;
      const Matrix3 step = Matrix3::Identity() + gradient[at];
      if (!(step.determinant() > 0.1)) return false;
      deformation[at] = step * run.group->oldDeformation[k];
    }
    shareVolume(run);
    return true;
  }
  void updateStress(const PointRun& run) {
    const PointGroup& group = *run.group;
    std::array<double, stressGroup> energyDensity;
    forEachChunk(run, [&](int from, StressPoints& points) {
      points.strainEnergyDensity = group.strainEnergy ? energyDensity.data() : nullptr;
      points.temperatureChange = group.temperatureChange ? group.temperatureChange + from : nullptr;
      group.material->model->updateStress(group.material->density, points);
      if (group.newState) std::copy_n(points.state, points.count * state_size_, group.newState + from * state_size_);
      for (int k = 0; k < points.count && group.strainEnergy; ++k)
        group.strainEnergy[from + k] = energyDensity[k] * group.mass[from + k] / group.material->undeformedDensity();
    });
  }
  /// Calls `visit(k, tangent)` with dP/dF of the k-th point of the group.
  template <class Visit>
  void forEachTangent(const PointRun& run, Visit&& visit) {
    std::vector<Matrix9> tangents(std::min(stressGroup, run.count));
    forEachChunk(run, [&](int from, StressPoints& points) {
      run.group->material->model->nominalTangent(points, tangents.data());
      for (int k = 0; k < points.count; ++k) visit(from + k, tangents[k]);
    });
  }

 private:
  /// Applies F-bar: det(stretch F) is the ratio of the volume of all points of the run to their volume at the start of
  /// the simulation, so that each cell is compressed as a whole (de Souza Neto et al., Int. J. Solids Structures 33
  /// (1996) 3277).
  void shareVolume(const PointRun& run) {
    double start = 0, now = 0;
    const bool shares = sharesVolume(run);
    for (int k = run.from; k < run.from + run.count && shares; ++k) {
      const double volume = run.group->mass[k] / run.group->material->undeformedDensity();
      start += volume;
      now += volume * deformation[run.group->first + k].determinant();
    }
    for (int k = run.from; k < run.from + run.count; ++k) {
      const std::size_t at = run.group->first + k;
      if (shares) stretch[at] = std::cbrt(now / start / deformation[at].determinant());
      f_bar_[at] = stretch[at] * deformation[at];
    }
  }
  /// Calls `work(k, points)` for groups of up to stressGroup points, with their state at the start of the step; k is
  /// the index of the first point of the group.
  template <class Work>
  void forEachChunk(const PointRun& run, Work&& work) {
    const PointGroup& group = *run.group;
    std::array<Matrix3, stressGroup> rate;
    std::array<double, stressGroup> waveSpeed;
    std::vector<double> state(std::min(stressGroup, run.count) * state_size_);
    for (int from = run.from; from < run.from + run.count; from += stressGroup) {
      const std::size_t at = group.first + from;
      StressPoints points;
      points.count = std::min(stressGroup, run.from + run.count - from);
      points.timeStep = dt_;
      points.oldDeformationGradient = group.oldDeformation + from;
      points.deformationGradient = &f_bar_[at];
      for (int k = 0; k < points.count; ++k) rate[k] = gradient[at + k] / dt_;
      points.velocityGradient = rate.data();
      points.temperature = group.temperature + from;
      points.oldStress = group.oldStress + from;
      points.stress = &stress[at];
      points.stateStride = state_size_;
      std::copy_n(group.oldState + from * state_size_, points.count * state_size_, state.data());
      points.state = state.data();
      points.waveSpeed = waveSpeed.data();
      work(from, points);
    }
  }

  int state_size_;
  double dt_;
  bool shares_volume_;
  std::vector<Matrix3> f_bar_;
};

}  // namespace tushar::mpm::solid::implicit
