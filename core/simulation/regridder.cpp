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

/// Blocks as text, to be sent.
std::string textOf(const std::set<BlockId>& blocks) {
  std::string text;
  for (const BlockId& block : blocks) text.append(reinterpret_cast<const char*>(&block), sizeof(block));
  return text;
}

void addBlocks(const std::string& text, std::set<BlockId>& blocks) {
  for (std::size_t at = 0; at + sizeof(BlockId) <= text.size(); at += sizeof(BlockId)) {
    BlockId block;
    std::memcpy(&block, text.data() + at, sizeof(block));
    blocks.insert(block);
  }
}

}  // namespace

std::pair<int, int> MarkedBlocks::blocksAlong(const grid::Level& level, int axis, int cell, int distance) const {
  if (axis >= level.dimension()) return {0, 1};
  const long cells = grid_.blockCells()[axis];
  const auto blockOf = [&](long at) { return static_cast<int>(at >= 0 ? at / cells : -((cells - 1 - at) / cells)); };
  distance = std::min(distance, level.cells().extent(axis));  // once around is enough
  long lower = long{cell} - distance, upper = long{cell} + distance;
  if (!level.isPeriodic(axis)) {
    lower = std::max(lower, 0L);
    upper = std::min(upper, level.cells().upper[axis] - 1L);
  }
  return {blockOf(lower), blockOf(upper) + 1};
}

Box MarkedBlocks::blocksNear(const grid::Level& level, const Index3& cell, int distance) const {
  Box blocks;
  for (int d = 0; d < 3; ++d) std::tie(blocks.lower[d], blocks.upper[d]) = blocksAlong(level, d, cell[d], distance);
  return blocks;
}

template <class Visit>
void MarkedBlocks::forEachNear(const grid::Level& level, const Box& blocks, int mark, Visit&& visit) {
  const Seen now{level.number(),  mark,           blocks.lower[0], blocks.lower[1], blocks.lower[2], blocks.upper[0],
                 blocks.upper[1], blocks.upper[2]};
  if (!seen_.insert(now).second) return;
  const Index3 count = grid_.tree().blocksOf(level.number());
  grid::forEach<3>(blocks, [&](Index3 at) {
    for (int d = 0; d < level.dimension(); ++d) at[d] = (at[d] % count[d] + count[d]) % count[d];
    visit(BlockId{level.number(), at});
  });
}

void MarkedBlocks::add(const grid::Level& level, const Index3& cell, int mark) {
  if (mark > 0) ask(level, blocksNear(level, cell, crossed(level) + dilation_), mark);
}

void MarkedBlocks::add(const grid::Patch& patch, const int* marks, const Box& stored) {
  const grid::Level& level = patch.level();
  const Box& cells = patch.cells();
  std::array<std::vector<std::pair<int, int>>, 3> along;
  for (int d = 0; d < 3; ++d)
    for (int at = cells.lower[d]; at < cells.upper[d]; ++at)
      along[d].push_back(blocksAlong(level, d, at, crossed(level) + dilation_));
  const auto rangeOf = [&](int axis, int at) { return along[axis][at - cells.lower[axis]]; };
  grid::forEachRow<3>(cells, [&](const Index3& first, int count) {
    const int* row = marks + stored.offset(first);
    Box blocks;
    for (const int d : {1, 2}) std::tie(blocks.lower[d], blocks.upper[d]) = rangeOf(d, first[d]);
    std::pair<int, int> last;
    int lastMark = 0;
    for (int k = 0; k < count; ++k) {
      const std::pair<int, int> now = along[0][k];
      if (row[k] == 0 || (row[k] == lastMark && now == last)) continue;
      last = now;
      lastMark = row[k];
      std::tie(blocks.lower[0], blocks.upper[0]) = now;
      ask(level, blocks, lastMark);
    }
  });
}

void MarkedBlocks::ask(const grid::Level& level, const Box& blocks, int mark) {
  const int number = level.number();
  forEachNear(level, blocks, mark, [&](const BlockId& block) {
    if (number > 0) kept_.insert(parentOf(block, level.dimension()));
    if (mark < 2 || number == grid_.levels() - 1) return;
    // Of a block that is not there yet, the leaf that it lies in is refined: no cell becomes two levels finer at once.
    BlockId leaf = block;
    for (const int there = grid_.tree().levelAt(block); leaf.level > there;) leaf = parentOf(leaf, level.dimension());
    wanted_.insert(leaf);
  });
}

void MarkedBlocks::addParticles(const grid::Level& level, const Index3& cell, int margin) {
  const int finest = grid_.levels() - 1, dimension = level.dimension();
  if (level.number() < finest) return add(level, cell, 2);
  constexpr int particles = 3;  // unlike any mark
  forEachNear(level, blocksNear(level, cell, crossed(level) + margin), particles, [&](BlockId block) {
    kept_.insert(parentOf(block, dimension));
    const int there = grid_.tree().levelAt(block);
    while (block.level > there) block = parentOf(block, dimension);
    if (there < finest) wanted_.insert(block);
  });
}

void MarkedBlocks::unite(const mpi::Communicator& ranks) {
  if (ranks.isAlone()) return;
  for (const std::string& text : ranks.gather(textOf(wanted_))) addBlocks(text, wanted_);
  for (const std::string& text : ranks.gather(textOf(kept_))) addBlocks(text, kept_);
}

grid::BlockTree MarkedBlocks::tree() const {
  std::set<BlockId> kept = kept_, wanted = wanted_;
  wanted.insert(grid_.fixedBlocks().begin(), grid_.fixedBlocks().end());
  const int dimension = grid_.dimension();
  for (const BlockId& leaf : grid_.tree().leaves())
    if (leaf.level > 1) kept.insert(parentOf(parentOf(leaf, dimension), dimension));
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

/// Steps between regriddings; if finer levels take smaller steps, rounded up to whole steps of the coarsest.
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
