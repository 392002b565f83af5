#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include <optional>
#include <utility>

#include "components/mpm/particles/ids.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/loads/load.hpp"
#include "components/mpm/solid/loads/manufactured.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"

namespace tushar::mpm::solid {

/// Settings for the creation of particles, apart from their bodies.
struct Start {
  bool axisymmetric = false;
  Loads loads;
  std::shared_ptr<const Manufactured> solution;  ///< manufactured solution; null: none
  bool domainsDeform = false;  ///< whether domains deform with F, so that p.size remains the undeformed size
  double leastMass = 0;        ///< smallest allowed mass of a particle [kg]
};

/// The numbers of the loads on a particle, starting from 1, packed in the form of p.loadCurveID. Throws InputError
/// where there are more than three.
inline int loadsOn(const Level& level, const Start& start, const Material& material, const Body& body,
                   const Vec3& point) {
  int ids = 0, factor = 1, number = 0;
  const auto addIf = [&](bool acts) {
    ++number;
    if (!acts) return;
    if (factor > 65536)
      throw InputError(
          {{body.where, "geom_object",
            fmt::format("more than three loads act on the particle at ({:g}, {:g}, {:g}) m; at most three are possible",
                        point[0], point[1], point[2])}});
    ids += factor * number;
    factor *= 256;
  };
  for (const SurfaceLoad& load : start.loads.surfaces)
    addIf((load.material < 0 || load.material == material.index) && load.acts(level, body, point));
  const Vec3 spacing = particleSpacing(level, body, point);
  for (const BodyLoad& load : start.loads.bodies) addIf(load.acts(point, spacing));
  return ids;
}

/// The values of new particles, one list for each variable.
template <int D>
struct NewParticles {
  std::vector<Vec<D>>&x, &velocity, &displacement, &size;
  std::vector<Matrix3>& domain;
  std::vector<double>&mass, &temperature, &color;
  std::vector<int>& loads;

  static NewParticles from(auto& take) {
    return {.x = take(creates(p::x<D>)),
            .velocity = take(creates(p::velocity<D>)),
            .displacement = take(creates(p::displacement<D>)),
            .size = take(creates(p::size<D>)),
            .domain = take(creates(p::domain)),
            .mass = take(creates(p::mass)),
            .temperature = take(creates(p::temperature)),
            .color = take(creates(p::color)),
            .loads = take(creates(p::loadCurves))};
  }

  /// Adds a particle at `at` [m]. The seed's position is the same point, rounded as in Uintah; it decides which loads
  /// act on the particle. Throws InputError if the mass of the particle is not above `leastMass`.
  void add(const Level& level, const Start& start, const Material& material, const Body& body, const Vec<D>& at,
           const Seed& seed) const {
    const Vec3 point = level.expandPoint<D>(at);
    x.push_back(at);
    const auto listed = [&](const auto& values, const auto& otherwise) {
      return seed.listed && !values.empty() ? values[*seed.listed] : otherwise(point);
    };
    static const ListedParticles none;
    const ListedParticles& list = body.list ? *body.list : none;
    velocity.push_back(level.reduce<D>(listed(list.velocity, body.velocity)));
    displacement.push_back(Vec<D>::Zero());
    size.push_back(extentOf<D>(level, seed));
    domain.push_back(seed.domain);
    double volume = level.cellVolume() * seed.volume;
    if (start.axisymmetric) volume *= point[0] / (level.cellWidth(2) > 0 ? level.cellWidth(2) : 1.0);
    mass.push_back(material.density * volume);
    if (mass.back() <= start.leastMass)
      throw InputError(
          {{body.where, "geom_object",
            fmt::format("the particle at ({:g}, {:g}, {:g}) m has {:g} kg, but <minimum_particle_mass> is {:g} kg",
                        point[0], point[1], point[2], mass.back(), start.leastMass)}});
    temperature.push_back(listed(list.temperature, body.temperature));
    color.push_back(listed(list.color, [&](const Vec3&) { return body.color; }));
    loads.push_back(loadsOn(level, start, material, body, seed.at));
    if (start.solution) deform(level, start, material, point);
  }

 private:
  /// Moves the particle that was added last to its position in the manufactured solution at time 0.
  void deform(const Level& level, const Start& start, const Material& material, const Vec3& point) const {
    const Manufactured& solution = *start.solution;
    const Elastic elastic = elasticOf(material);
    displacement.back() = level.reduce<D>(solution.displacement(elastic, point, 0));
    x.back() += displacement.back();
    velocity.back() = level.reduce<D>(solution.velocity(elastic, point, 0));
    if (start.domainsDeform) return;
    const Matrix3 f = solution.deformationGradient(elastic, point, 0);
    for (int d = 0; d < D; ++d)  // gimp's are no wider than a cell
      size.back()[d] = std::min(size.back()[d] * f(level.axis(d), level.axis(d)), 1.0);
  }
};

/// Adds the particles of a body that start in a cell at the positions of its seeds; `inCell` counts the particles of
/// the cell.
template <int D>
void addSeeds(const Level& level, const Start& start, const Material& material, const Body& body, const Index<D>& cell,
              ParticleId& inCell, ParticleMaker& maker, const NewParticles<D>& particles) {
  const auto found = body.seeds->find(level.cellNumber<D>(cell));
  if (found == body.seeds->end()) return;
  for (const Seed& seed : found->second) {
    maker.add(cell, idOf<D>(level, cell, inCell++, body.where));
    particles.add(level, start, material, body, level.reduce<D>(seed.at), seed);
  }
}

/// The largest distance, in cells, by which particles are displaced at the start.
inline int cellsMovedAtStart(const Level& level, const Start& start) {
  const double farthest = start.solution ? start.solution->farthestAtStart() : 0.0;
  return static_cast<int>(std::ceil(farthest / level.minSpacing()));
}

/// The initial position of any one particle of a body in these cells of the finest level, and the part of a cell that
/// the particle fills; none if there is no such particle.
template <int D>
std::optional<std::pair<Vec<D>, Seed>> particleIn(const Level& finest, const Body& body, const Box& cells) {
  std::optional<std::pair<Vec<D>, Seed>> found;
  const auto take = [&](const Seed& seed) { found.emplace(finest.reduce<D>(seed.at), seed); };
  if (body.seeds) {
    forEachRow<D>(cells, [&](const Index<D>& first, int count) {  // whose numbers are consecutive
      const std::uint64_t number = finest.cellNumber<D>(first);
      const auto next = body.seeds->lower_bound(number);
      if (!found && next != body.seeds->end() && next->first < number + static_cast<std::uint64_t>(count))
        take(next->second.front());
    });
    return found;
  }
  const Seed part = partOfCell<D>(finest, body.particlesPerCell);
  const input::Box3 bounds = body.shape->bounds();
  forEach<D>(finest.cellsNear(bounds.min, bounds.max).intersect(cells), [&](const Index<D>& cell) {
    if (!found)
      forEachParticleIn<D>(finest, body, cell, [&](const Index<D>&, const Vec3& at, double depth) {
        take({at, part.domain, depth * part.volume});
      });
  });
  return found;
}

/// Puts one particle of each body into each cell of a coarser level whose finest descendants would contain any. As a
/// result, such cells are refined, or the scene is refused. Sample points of the coarser cell itself would miss a thin
/// body.
template <int D>
void standIn(const Patch& patch, const Material& material, ParticleMaker& maker, const Start& start,
             const NewParticles<D>& particles) {
  const Level &level = patch.level(), &finest = level.finest();
  const int halvings = finest.number() - level.number(), around = cellsMovedAtStart(finest, start);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    Box inside{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      inside.lower[d] = cell[d] << halvings;
      inside.upper[d] = (cell[d] + 1) << halvings;
    }
    inside = inside.grown(around, D).intersect(finest.cells());
    ParticleId inCell = material.firstIdInCell;
    for (const Body& body : material.bodies)
      if (const auto found = particleIn<D>(finest, body, inside)) {
        maker.add(cell, idOf<D>(level, cell, inCell++, body.where));
        particles.add(finest, start, material, body, found->first, found->second);
      }
  });
}

/// Calls `visit(cell, body, inCell)` for the cells and bodies of a patch that may have particles at the start: cell by
/// cell, with the bodies in their order; `inCell` is `firstInCell` for the first body of a cell. A cell further than
/// `around` from the patch is not visited, and one that the bounds of a body do not reach only if particles are
/// displaced.
template <int D, class Visit>
void forEachCellAndBody(const Patch& patch, const std::vector<Body>& bodies, ParticleId firstInCell, int around,
                        Visit&& visit) {
  const Box cells = patch.cellsWithin(around);
  std::vector<std::pair<const Body*, Box>> all, ofRow;
  for (const Body& body : bodies) {
    const input::Box3 bounds = body.shape->bounds();
    const bool isAnywhere = body.seeds || around > 0;
    all.emplace_back(&body, isAnywhere ? cells : patch.level().cellsNear(bounds.min, bounds.max).intersect(cells));
  }
  forEachRow<D>(cells, [&](Index<D> cell, int count) {
    ofRow.clear();
    for (const auto& one : all) {
      Index<D> at = cell;
      at[0] = one.second.lower[0];
      if (one.second.contains(at)) ofRow.push_back(one);
    }
    for (int k = 0; k < count && !ofRow.empty(); ++k, ++cell[0]) {
      ParticleId inCell = firstInCell;
      for (const auto& [body, box] : ofRow)
        if (box.contains(cell)) visit(cell, *body, inCell);
    }
  });
}

/// Fills each body with its particles: `particlesPerCell` along each axis, each in the centre of one of the equal parts
/// of a cell, if the shape contains that point. As in Uintah, bodies may overlap; if such points lie on a face that two
/// bodies share, both bodies have particles there.
///
/// The id of a particle is composed of the index of its cell and its position in the cell, so it does not depend on the
/// patches. Particles are on the finest level; see standIn for cells of coarser levels.
template <int D>
void actuallyInitialize(const Patch& patch, const Material& material, ParticleMaker& maker, const Start& start,
                        const NewParticles<D>& particles) {
  const Level& level = patch.level();
  if (patch.id() == 0) refuseIdle(start.loads.surfaces);
  if (&level != &level.finest()) return standIn<D>(patch, material, maker, start, particles);
  // A displaced particle may start in another cell than the one that made it, hence on another patch.
  const int around = cellsMovedAtStart(level, start);
  forEachCellAndBody<D>(
      patch, material.bodies, material.firstIdInCell, around,
      [&](const Index<D>& cell, const Body& body, ParticleId& inCell) {
        if (body.seeds) {
          if (patch.cells().contains(cell)) addSeeds<D>(level, start, material, body, cell, inCell, maker, particles);
          return;
        }
        const Seed part = partOfCell<D>(level, body.particlesPerCell);
        forEachParticleIn<D>(level, body, cell, [&](const Index<D>& k, const Vec3& place, double depth) {
          Vec<D> at;
          for (int d = 0; d < D; ++d)
            at[d] = level.nodePosition(d, 0) +
                    (cell[d] + (k[d] + 0.5) * part.domain(level.axis(d), level.axis(d))) * level.spacing(d);
          const ParticleId id = idOf<D>(level, cell, inCell++, body.where);
          Index<D> home = cell;
          if (start.solution) {
            const Vec3 point = level.expandPoint<D>(at);
            home = level.cellOf<D>(at + level.reduce<D>(start.solution->displacement(elasticOf(material), point, 0)));
          }
          if (!patch.cells().contains(home)) return;
          maker.add(home, id);
          particles.add(level, start, material, body, at, {place, part.domain, depth * part.volume});
        });
      });
}

/// Sets a variable to its initial value of zero on every particle.
template <class T>
void startAtZero(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<T> values) {
  for (int p = 0; p < mass.owned(); ++p)
    if constexpr (std::is_arithmetic_v<T>)
      values[p] = 0;
    else
      values[p].setZero();
}

/// Sets the initial F = J^(1/3) I with J of the model, which is 1 unless the body starts under pressure, or F of the
/// manufactured solution at time 0.
template <int D>
void startDeformation(const Patch& patch, const Material& material, const Start& start, ParticleView<const Vec<D>> x,
                      std::optional<ParticleView<const Vec<D>>> displacement, ParticleView<Matrix3> deformation) {
  for (int p = 0; p < x.owned(); ++p)
    if (displacement)
      deformation[p] = start.solution->deformationGradient(
          elasticOf(material), patch.level().expandPoint<D>(Vec<D>(x[p] - (*displacement)[p])), 0);
    else
      deformation[p] = Matrix3::Identity() * std::cbrt(material.model->initialVolumeRatio());
}

/// The initial stress of a particle [Pa]: if it starts under pressure, the stress that follows from its F and
/// temperature [K], otherwise that of the model. Also gives the density of its strain energy [J/m^3], if requested.
inline Matrix3 startStress(const Material& material, const Matrix3& f, double temperature, double* state,
                           double* energyDensity = nullptr) {
  if (material.model->initialVolumeRatio() == 1) return material.model->initialStress();
  const Matrix3 zero = Matrix3::Zero();
  Matrix3 stress = zero;
  double waveSpeed = 0;
  StressPoints point{.count = 1, .oldDeformationGradient = &f, .deformationGradient = &f, .velocityGradient = &zero};
  point.temperature = &temperature;
  point.oldStress = &zero;
  point.stress = &stress;
  point.state = state;
  point.waveSpeed = &waveSpeed;
  point.strainEnergyDensity = energyDensity;
  material.model->updateStress(material.density, point);
  return stress;
}

/// Sets the initial strain energy, which is not 0 if the body starts under pressure.
inline void startEnergy(const Patch&, const Material& material, ParticleView<const double> mass,
                        ParticleView<const double> temperature, ParticleView<const Matrix3> deformation,
                        ParticleView<double> energy) {
  const bool isStressed = material.model->initialVolumeRatio() != 1;
  std::vector<double> state(static_cast<std::size_t>(material.model->stateSize()), 0.0);
  for (int p = 0; p < mass.owned(); ++p) {
    double density = 0;
    if (isStressed) {
      if (!state.empty()) material.model->initialize(state.data(), Birth{});
      startStress(material, deformation[p], temperature[p], state.data(), &density);
    }
    energy[p] = density * mass[p] / material.undeformedDensity();
  }
}

/// Views of initial values of particles besides their position and mass; `state` contains the internal variables of the
/// constitutive models, which may depend on id and color.
struct StartOfPoints {
  ParticleView<const double> mass, temperature;
  ParticleView<const Matrix3> deformation;
  ParticleView<double> volume;
  ParticleView<Matrix3> stress;
  std::optional<ParticleView<double>> state;
  std::optional<ParticleView<const ParticleId>> id;
  std::optional<ParticleView<const double>> color;

  static StartOfPoints from(auto& take, const ParticleLabel<double>* state, bool vary) {
    return {.mass = take(requiresNew(p::mass)),
            .temperature = take(requiresNew(p::temperature)),
            .deformation = take(requiresNew(p::deformationMeasure)),
            .volume = take(computes(p::volume)),
            .stress = take(computes(p::stress)),
            .state = take(when(state->components > 0, computes(*state))),
            .id = take(when(vary, requiresNew(data::particleId))),
            .color = take(when(vary, requiresNew(p::color)))};
  }
};

/// Sets initial volume, stress and internal variables of particles.
inline void initializeStress(const Patch&, const Material& material, int stateSize, const StartOfPoints& points) {
  const double density = material.undeformedDensity();
  for (int p = 0; p < points.mass.owned(); ++p) {
    const Matrix3& f = points.deformation[p];
    points.volume[p] = points.mass[p] / density * f.determinant();
    double* const internal = points.state ? &(*points.state)[0] + p * stateSize : nullptr;
    if (internal) std::fill_n(internal, stateSize, 0.0);  // another material's model may have more of it
    if (internal)
      material.model->initialize(internal, points.id ? Birth{(*points.id)[p], (*points.color)[p]} : Birth{});
    points.stress[p] = startStress(material, f, points.temperature[p], internal);
  }
}

inline void scheduleInitialStress(TaskList& tasks, const std::vector<Material>& materials,
                                  const ParticleLabel<double>& state) {
  const bool vary = std::any_of(materials.begin(), materials.end(),
                                [](const Material& material) { return material.model->variesByParticle(); });
  tasks.perMaterial("mpm::initializeStress", initializeStress, materials, with(state.components),
                    all<StartOfPoints>(&state, vary));
}

template <int D>
void scheduleActuallyInitialize(TaskList& tasks, const std::vector<Material>& materials, const Start& start) {
  tasks.newParticles("mpm::actuallyInitialize", actuallyInitialize<D>, materials, with(start), all<NewParticles<D>>());
  tasks.perMaterial("mpm::initializeDeformation", startDeformation<D>, materials, with(start), requiresNew(p::x<D>),
                    when(start.solution != nullptr, requiresNew(p::displacement<D>)), computes(p::deformationMeasure));
  const auto atZero = [&]<class T>(const ParticleLabel<T>& label) {
    tasks.perMaterial("mpm::initializeAtZero", startAtZero<T>, materials, requiresNew(p::mass), computes(label));
  };
  atZero(p::externalForce<D>);
  atZero(p::viscosity);
  atZero(p::velocityGradient);
  tasks.perMaterial("mpm::initializeStrainEnergy", startEnergy, materials, requiresNew(p::mass),
                    requiresNew(p::temperature), requiresNew(p::deformationMeasure), computes(p::strainEnergy));
}
// Compiled in solids_of.cpp.
extern template void scheduleActuallyInitialize<1>(TaskList&, const std::vector<Material>&, const Start&);
extern template void scheduleActuallyInitialize<2>(TaskList&, const std::vector<Material>&, const Start&);
extern template void scheduleActuallyInitialize<3>(TaskList&, const std::vector<Material>&, const Start&);

}  // namespace tushar::mpm::solid
