#include "core/simulation/regridder.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <vector>

#include "core/base/trace.hpp"
#include "core/simulation/refinement_marks.hpp"
#include "core/tasks/regrid.hpp"

namespace tushar::simulation {

using grid::BlockId;
using grid::Box;

namespace {

BlockId parentOf(BlockId block, int dimension) {
  --block.level;
  for (int d = 0; d < dimension; ++d) block.at[d] /= 2;
  return block;
}

/// Blocks as text that can be sent, without duplicates.
std::string textOf(std::vector<BlockId> blocks) {
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return {reinterpret_cast<const char*>(blocks.data()), blocks.size() * sizeof(BlockId)};
}

void addBlocks(const std::string& text, std::vector<BlockId>& blocks) {
  if (text.empty()) return;
  const std::size_t before = blocks.size(), count = text.size() / sizeof(BlockId);
  blocks.resize(before + count);
  std::memcpy(blocks.data() + before, text.data(), count * sizeof(BlockId));
}

/// Consecutive cells of a patch along an axis that are near the same blocks.
struct CellRun {
  int first, last;             ///< range of cells in the patch: [first, last)
  std::pair<int, int> blocks;  ///< range of blocks: [lower, upper)
};

/// Raises marks of blocks, starting at `origin`, to those of a row of cells; returns whether there are any.
bool raiseMarksOfBlocks(const int* cells, const std::vector<CellRun>& runs, int origin, std::vector<int>& blocks) {
  std::fill(blocks.begin(), blocks.end(), 0);
  int any = 0;
  for (const CellRun& run : runs) {
    int most = 0;
    for (int k = run.first; k < run.last; ++k) most = std::max(most, cells[k]);
    any = std::max(any, most);
    for (int at = run.blocks.first; most > 0 && at < run.blocks.second; ++at)
      blocks[at - origin] = std::max(blocks[at - origin], most);
  }
  return any > 0;
}

}  // namespace

MarkedBlocks::Range MarkedBlocks::blocksAlong(const grid::Level& level, int axis, int cell, int distance) const {
  if (axis >= level.dimension()) return {0, 1};
  const long cells = grid_.blockCells()[axis], all = level.cells().extent(axis);
  const bool isPeriodic = level.isPeriodic(axis);
  if (isPeriodic && 2L * distance + 1 >= all) return {0, static_cast<int>(all / cells)};  // once around is enough
  const long lower = isPeriodic ? long{cell} - distance : std::max(long{cell} - distance, 0L);
  const long upper = isPeriodic ? long{cell} + distance : std::min(long{cell} + distance, all - 1);
  const auto blockOf = [&](long at) { return static_cast<int>(at >= 0 ? at / cells : -((cells - 1 - at) / cells)); };
  return {blockOf(lower), blockOf(upper) + 1};
}

Box MarkedBlocks::blocksNear(const grid::Level& level, const Index3& cell, int distance) const {
  Box blocks;
  for (int d = 0; d < 3; ++d) std::tie(blocks.lower[d], blocks.upper[d]) = blocksAlong(level, d, cell[d], distance);
  return blocks;
}

BlockId MarkedBlocks::wrapped(BlockId image) const {
  const Index3 count = grid_.tree().blocksOf(image.level);
  for (int d = 0; d < grid_.dimension(); ++d) image.at[d] = (image.at[d] % count[d] + count[d]) % count[d];
  return image;
}

void MarkedBlocks::add(const grid::Level& level, const Index3& cell, int mark) {
  if (mark > 0)
    grid::forEach<3>(blocksNear(level, cell, crossed(level) + dilation_), [&](const Index3& at) {
      ask({level.number(), at}, mark);
    });
}

/// Each row of cells first marks blocks along the first axis. These marks then apply to all rows of blocks near this
/// row of cells, so that a row of cells marks each block only once.
void MarkedBlocks::add(const grid::Patch& patch, const int* marks, const Box& stored) {
  const grid::Level& level = patch.level();
  const Box& cells = patch.cells();
  const auto blocksOf = [&](int d, int at) { return blocksAlong(level, d, at, crossed(level) + dilation_); };
  std::vector<CellRun> runs;
  for (int at = cells.lower[0]; at < cells.upper[0]; ++at) {
    const int place = at - cells.lower[0];
    if (const Range blocks = blocksOf(0, at); runs.empty() || runs.back().blocks != blocks)
      runs.push_back({place, place, blocks});
    runs.back().last = place + 1;
  }
  Box reached;
  for (int d = 0; d < 3; ++d) {
    reached.lower[d] = blocksOf(d, cells.lower[d]).first;
    reached.upper[d] = blocksOf(d, cells.upper[d] - 1).second;
  }
  std::vector<int> found, row(static_cast<std::size_t>(reached.extent(0)));
  grid::forEachRow<3>(cells, [&](const Index3& first, int) {
    if (!raiseMarksOfBlocks(marks + stored.offset(first), runs, reached.lower[0], row)) return;
    if (found.empty()) found.assign(reached.size(), 0);
    Box rows = reached;
    for (const int d : {1, 2}) std::tie(rows.lower[d], rows.upper[d]) = blocksOf(d, first[d]);
    grid::forEachRow<3>(rows, [&](const Index3& start, int count) {
      int* to = found.data() + reached.offset(start);
      for (int k = 0; k < count; ++k) to[k] = std::max(to[k], row[static_cast<std::size_t>(k)]);
    });
  });
  if (found.empty()) return;
  grid::forEach<3>(reached, [&](const Index3& at) {
    if (const int mark = found[reached.offset(at)]; mark > 0) ask({level.number(), at}, mark);
  });
}

void MarkedBlocks::ask(const BlockId& image, int mark) {
  const int dimension = grid_.dimension();
  BlockId block = wrapped(image);
  if (block.level > 0)
    if (const BlockId parent = parentOf(block, dimension); kept_.empty() || kept_.back() != parent)
      kept_.push_back(parent);
  if (mark < 2 || block.level == grid_.levels() - 1) return;
  // If the block does not exist yet, the leaf that contains it is refined instead, so that no cell becomes two levels
  // finer in one regridding.
  for (const int there = grid_.tree().levelAt(block); block.level > there;) block = parentOf(block, dimension);
  wanted_.push_back(block);
}

void MarkedBlocks::addParticles(const grid::Level& level, const Index3& cell, int margin) {
  const int finest = grid_.levels() - 1, dimension = level.dimension();
  const bool isFinest = level.number() == finest;
  const Box blocks = blocksNear(level, cell, crossed(level) + (isFinest ? margin : dilation_));
  const auto& [lower, upper] = blocks;
  if (!near_particles_.insert({level.number(), lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]}).second)
    return;
  if (!isFinest) return grid::forEach<3>(blocks, [&](const Index3& at) { ask({level.number(), at}, 2); });
  grid::forEach<3>(blocks, [&](const Index3& at) {
    BlockId block = wrapped({finest, at});
    ask(block, 1);
    const int there = grid_.tree().levelAt(block);
    while (block.level > there) block = parentOf(block, dimension);
    if (there < finest) wanted_.push_back(block);
  });
}

void MarkedBlocks::unite(const mpi::Communicator& ranks) {
  if (ranks.isAlone()) return;
  for (const std::string& text : ranks.gather(textOf(wanted_))) addBlocks(text, wanted_);
  for (const std::string& text : ranks.gather(textOf(kept_))) addBlocks(text, kept_);
}

grid::BlockTree MarkedBlocks::tree() const {
  std::vector<BlockId> kept = kept_, wanted = wanted_;
  wanted.insert(wanted.end(), grid_.fixedBlocks().begin(), grid_.fixedBlocks().end());
  const int dimension = grid_.dimension();
  for (const BlockId& leaf : grid_.tree().leaves())
    if (leaf.level > 1)
      if (const BlockId block = parentOf(parentOf(leaf, dimension), dimension); kept.empty() || kept.back() != block)
        kept.push_back(block);
  return grid_.tree().regridded(wanted, kept);
}

void Regridder::addMarks(MarkedBlocks& marked) {
  if (run_.phases.refinement.tasks().empty()) return;
  run_.diagnose(run_.phases.refinement);
  const int number = run_.table.find(tasks::refinementMark.name, -1);
  for (const grid::Patch& patch : run_.problem.grid->patches()) {
    const data::Variable marks = run_.warehouse.variable(data::Generation::fresh, number, patch.id());
    marked.add(patch, reinterpret_cast<const int*>(marks.values), marks.stored);
  }
}

void Regridder::addParticles(MarkedBlocks& marked) {
  for (int material = 0; material < run_.materials(); ++material)
    for (const grid::Patch& patch : run_.problem.grid->patches()) {
      const data::ParticleSet& set = run_.warehouse.particles(data::Generation::old, material, patch.id());
      if (set.owned() == 0) continue;
      grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
        if (!set.in(cell).empty()) marked.addParticles(patch.level(), cell, run_.table.reach(material) + 1);
      });
    }
}

/// Number of steps between regriddings; if finer levels take smaller steps, rounded up to whole steps of the coarsest
/// level.
int Regridder::stepsBetween() const {
  const int finer = run_.problem.smallerSteps ? run_.problem.grid->levels() - 1 : 0;
  return ((run_.problem.regrid.interval - 1) >> finer) + 1;
}

int Regridder::finestStepsBetween() const {
  return run_.problem.smallerSteps ? stepsBetween() << (run_.problem.grid->levels() - 1) : run_.problem.regrid.interval;
}

grid::BlockTree Regridder::wantedTree() {
  MarkedBlocks marked(*run_.problem.grid, finestStepsBetween(), run_.problem.regrid.dilation);
  addMarks(marked);
  addParticles(marked);
  marked.unite(run_.ranks);
  return marked.tree();
}

bool Regridder::refinedStart() {
  if (!run_.problem.regrid.adaptive || starts_++ >= run_.problem.grid->levels()) return false;
  const auto started = Clock::now();
  grid::BlockTree tree = wantedTree();
  const bool isOther = !(tree == run_.problem.grid->tree());
  if (isOther) {
    run_.problem.grid->refine(run_.problem.grid->cut(std::move(tree)));
    run_.warehouse.startAnew(run_.materials());
    run_.scheduler.forgetLayout();
  }
  seconds_ += secondsSince(started);
  return isOther;
}

void Regridder::regridIfDue() {
  const RegridSettings& settings = run_.problem.regrid;
  if (!settings.adaptive || settings.once || run_.time.step() % stepsBetween() != 0) return;
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::message, "regrid");
  grid::BlockTree tree = wantedTree();
  if (!(tree == run_.problem.grid->tree())) change(std::move(tree));
  seconds_ += secondsSince(started);
}

void Regridder::change(grid::BlockTree tree) {
  const tasks::MigratedVariables variables = run_.migratedVariables();
  std::vector<int> cells;
  for (const int variable : variables.variables)
    if (run_.table[variable].label->centring == data::Centring::cell &&
        run_.warehouse.isHeld(data::Generation::old, variable))
      cells.push_back(variable);
  run_.scheduler.fillGhosts(cells);
  tasks::regrid(*run_.problem.grid, std::move(tree), run_.warehouse, variables);
  run_.scheduler.forgetLayout();
  ++regrids_;
  tasks::TaskGraph& mend = run_.phases.refined;
  run_.scheduler.run(mend, {run_.time.step(), run_.time.time()});
  run_.scheduler.commit(mend);
}

}  // namespace tushar::simulation
