#include "core/simulation/snapshot_of.hpp"

namespace tushar::simulation {

using collect::Gather;
using data::Centring;
using data::Generation;

namespace {

output::Snapshot emptySnapshot(const RunState& run, output::GridInfo grid) {
  output::Snapshot snapshot;
  snapshot.step = run.time.step();
  snapshot.time = run.time.time();
  snapshot.delT = run.time.delT();
  snapshot.grid = std::move(grid);
  return snapshot;
}

/// The particles of every material, with p.x alone.
output::Snapshot positions(const RunState& run, Gather& gather) {
  output::Snapshot snapshot = emptySnapshot(run, collect::gridInfo(*run.problem.grid));
  for (std::size_t m = 0; m < run.phases.materials().size(); ++m) {
    const int number = run.table.find(data::positionName, static_cast<int>(m));
    if (number < 0) continue;
    snapshot.particles.push_back({run.phases.materials()[m], static_cast<int>(m), {}});
    snapshot.particles.back().arrays.push_back(gather.stream(Generation::old, number));
  }
  return snapshot;
}

/// `stream(generation, number)` gets the values.
template <class Stream>
void addField(RunState& run, const SaveRequest& save, const Stream& stream, output::Snapshot& snapshot) {
  for (int m = -1; m < run.materials(); ++m) {
    const int number = run.table.find(save.label, m);
    const std::string material = m < 0 ? "" : run.phases.materials()[m];
    if (number < 0 || save.label == data::positionName || (!save.material.empty() && save.material != material))
      continue;
    const data::Label& label = *run.table[number].label;
    const bool derived = !run.warehouse.isHeld(Generation::old, number);
    output::Array array = stream(derived ? Generation::fresh : Generation::old, number);
    if (label.centring == Centring::particle)
      snapshot.particles[m].arrays.push_back(std::move(array));
    else if (array.entries() > 0)
      snapshot.fields.push_back({label.centring == Centring::node ? output::Centring::node : output::Centring::cell,
                                 material, m, std::move(array)});
  }
}

}  // namespace

output::Snapshot snapshotOf(RunState& run, const std::vector<SaveRequest>& requests) {
  Gather gather(run.warehouse);
  output::Snapshot snapshot = positions(run, gather);
  const auto whole = [&](Generation generation, int number) { return gather.stream(generation, number); };
  for (const SaveRequest& request : requests) addField(run, request, whole, snapshot);
  return snapshot;
}

output::Snapshot snapshotOf(RunState& run, const std::vector<SaveRequest>& requests, const collect::Layer& layer) {
  Gather gather(run.warehouse);
  output::Snapshot snapshot = emptySnapshot(run, collect::gridInfo(run.problem.grid->level(), layer));
  const auto part = [&](Generation generation, int number) { return gather.stream(generation, number, layer); };
  for (const SaveRequest& request : requests) addField(run, request, part, snapshot);
  return snapshot;
}

}  // namespace tushar::simulation
