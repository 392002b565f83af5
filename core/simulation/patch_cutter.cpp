#include "core/simulation/patch_cutter.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/base/trace.hpp"
#include "core/grid/choose_patches.hpp"
#include "core/grid/cut_tiling.hpp"
#include "core/tasks/regrid.hpp"

namespace tushar::simulation {

namespace {

/// Patches per worker. Few suffice, because the work is known, and each cut has a cost: the particles next to it are
/// added to the nodes on both sides.
constexpr int patchesPerWorker = 2;
/// If the load of the largest patch is at least this, its worker may still be busy when the others are idle.
constexpr double heavy = 0.7;
/// Factor by which other cuts must reduce the load.
constexpr double worthwhile = 0.8;

/// Cuts an axis into `parts` parts of at least one cell each, whose sums of `work` are as equal as possible.
std::vector<int> evenCuts(const std::vector<double>& work, int parts) {
  const int cells = static_cast<int>(work.size());
  std::vector<double> before(work.size() + 1, 0.0);
  std::partial_sum(work.begin(), work.end(), before.begin() + 1);
  std::vector<int> cuts{0};
  for (int part = 1; part < parts; ++part) {
    const double wanted = before.back() * part / parts;
    int at = static_cast<int>(std::lower_bound(before.begin(), before.end(), wanted) - before.begin());
    if (at > 0 && wanted - before[at - 1] < before[at] - wanted) --at;
    cuts.push_back(std::clamp(at, cuts.back() + 1, cells - (parts - part)));
  }
  cuts.push_back(cells);
  return cuts;
}

/// Number of planes of cells from the first one with work to the last; at least 1.
int extentOf(const std::vector<double>& work) {
  const auto isAny = [](double one) { return one > 0; };
  const auto first = std::find_if(work.begin(), work.end(), isAny);
  const auto last = std::find_if(work.rbegin(), work.rend(), isAny);
  return std::max(1, static_cast<int>(last.base() - first));
}

}  // namespace

bool PatchCutter::mayCut() const {
  const grid::Grid& grid = *run_.problem.grid;
  if (grid.levels() > 1 || !grid.level().domain().mayRecut || run_.materials() == 0 || workers() < 2) return false;
  const auto& graph = run_.phases.timeAdvance.tasks();
  if (std::any_of(graph.begin(), graph.end(), [](const tasks::CompiledTask& one) { return one.task.perRank; }))
    return false;
  bool hasParticles = false;
  for (const int number : run_.migratedVariables().variables) {
    const data::Centring centring = run_.table[number].label->centring;
    if (centring == data::Centring::node) return false;
    hasParticles = hasParticles || centring == data::Centring::particle;
  }
  return hasParticles;
}

int PatchCutter::workers() const {
  const int ranks = run_.ranks.size(), threads = run_.problem.threads, cells = run_.problem.cellsPerThread;
  if (cells == 0) return ranks * threads;
  return ranks * grid::usefulThreads(static_cast<double>(run_.problem.grid->cellCount()) / ranks, cells, threads);
}

double PatchCutter::workOfCell() const {
  for (const int number : run_.migratedVariables().variables)
    if (run_.table[number].label->centring == data::Centring::cell) return 1;
  return 0;
}

template <class Visit>
void PatchCutter::forEachWork(const grid::Patch& patch, double ofCell, Visit&& visit) const {
  if (ofCell > 0) grid::forEach<3>(patch.cells(), [&](const Index3& cell) { visit(cell, ofCell); });
  for (int material = 0; material < run_.materials(); ++material) {
    const data::ParticleSet& set = run_.warehouse.particles(data::Generation::old, material, patch.id());
    if (set.owned() > 0)
      set.forEachOccupied<3>(patch.cells(), [&](const Index3& cell, const data::ParticleRange& particles) {
        visit(cell, static_cast<double>(particles.size()));
      });
  }
}

std::array<std::vector<double>, 3> PatchCutter::workAlongAxes(double ofCell) const {
  const grid::Grid& grid = *run_.problem.grid;
  std::array<std::vector<double>, 3> work;
  for (int d = 0; d < 3; ++d) work[d].resize(grid.level().cells().extent(d));
  for (const grid::Patch& patch : grid.patches())
    forEachWork(patch, ofCell, [&](const Index3& cell, double here) {
      for (int d = 0; d < 3; ++d) work[d][cell[d]] += here;
    });
  for (std::vector<double>& along : work) run_.ranks.sum(along);
  return work;
}

double PatchCutter::loadOf(std::vector<double>& ofPatches) const {
  run_.ranks.sum(ofPatches);
  const double all = std::accumulate(ofPatches.begin(), ofPatches.end(), 0.0);
  return all > 0 ? workers() * *std::max_element(ofPatches.begin(), ofPatches.end()) / all : 0;
}

double PatchCutter::load(double ofCell) const {
  std::vector<double> ofPatches(run_.problem.grid->patchCount());
  for (const grid::Patch& patch : run_.problem.grid->patches()) {
    double& work = ofPatches[patch.id()];
    work = ofCell * static_cast<double>(patch.cells().size());
    for (int material = 0; material < run_.materials(); ++material)
      work += run_.warehouse.particles(data::Generation::old, material, patch.id()).owned();
  }
  return loadOf(ofPatches);
}

double PatchCutter::load(double ofCell, const Cuts& cuts) const {
  std::array<std::vector<std::size_t>, 3> blockOf;  // by cell along each axis
  std::size_t blocks = 1;
  for (int d = 0; d < 3; ++d) {
    const std::size_t count = cuts[d].size() - 1;
    for (std::size_t block = 0; block < count; ++block) blockOf[d].resize(cuts[d][block + 1], blocks * block);
    blocks *= count;
  }
  std::vector<double> ofPatches(blocks);
  for (const grid::Patch& patch : run_.problem.grid->patches())
    forEachWork(patch, ofCell, [&](const Index3& cell, double here) {
      ofPatches[blockOf[0][cell[0]] + blockOf[1][cell[1]] + blockOf[2][cell[2]]] += here;
    });
  return loadOf(ofPatches);
}

void PatchCutter::cut() {
  const double ofCell = workOfCell(), now = load(ofCell);
  if (now < heavy || ++waited_ < patience_) return;
  waited_ = 0;
  patience_ = std::min(2 * patience_, mostPatience);
  const std::array<std::vector<double>, 3> work = workAlongAxes(ofCell);
  Index3 extent;
  for (int d = 0; d < 3; ++d) extent[d] = extentOf(work[d]);
  const Index3 parts = grid::choosePatches(extent, patchesPerWorker * workers());
  Cuts cuts;
  for (int d = 0; d < 3; ++d) cuts[d] = evenCuts(work[d], parts[d]);
  if (const grid::SeveralBoxes* boxes = run_.problem.grid->level().boxes())
    for (int d = 0; d < run_.problem.grid->dimension(); ++d) cuts[d] = boxes->allowedCuts(d, cuts[d]);
  if (load(ofCell, cuts) > worthwhile * now) return;
  const trace::Span span(trace::Kind::message, "cut the grid elsewhere");
  run_.warehouse.releaseFreeMemory();  // of a step, which the copies of all values need now
  tasks::recut(*run_.problem.grid, std::make_unique<grid::CutTiling>(std::move(cuts)), run_.warehouse,
               run_.migratedVariables(), {ofCell, 1});
  run_.scheduler.forgetLayout();
  ++times_;
  patience_ = 1;
}

void PatchCutter::cutAtStart() {
  may_cut_ = mayCut();
  if (may_cut_) cut();
}

void PatchCutter::cutIfDue() {
  if (!may_cut_ || ++steps_ < (run_.ranks.isAlone() ? soonest : soonestOfRanks)) return;
  steps_ = 0;
  cut();
}

}  // namespace tushar::simulation
