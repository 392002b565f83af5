#include "core/simulation/snapshot_of.hpp"

#include <algorithm>

#include "core/output/pieces.hpp"

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

/// Adds an entry for every material that has p.x; the entry contains p.x if the material is requested.
template <class IsWanted>
output::Snapshot positions(const RunState& run, Gather& gather, const IsWanted& isWanted) {
  output::Snapshot snapshot = emptySnapshot(run, collect::gridInfo(*run.problem.grid));
  for (std::size_t m = 0; m < run.phases.materials().size(); ++m) {
    const int number = run.table.find(data::positionName, static_cast<int>(m));
    if (number < 0) continue;
    snapshot.particles.push_back({run.phases.materials()[m], static_cast<int>(m), {}});
    if (isWanted(static_cast<int>(m)))
      snapshot.particles.back().arrays.push_back(gather.stream(Generation::old, number));
  }
  return snapshot;
}

/// Adds a field; `stream(generation, number)` provides its values.
template <class Stream>
void addField(RunState& run, const SaveRequest& save, const Stream& stream, output::Snapshot& snapshot) {
  for (int m = -1; m < run.materials(); ++m) {
    const int number = run.table.find(save.label, m);
    const std::string material = m < 0 ? "" : run.phases.materials()[m];
    if (number < 0 || save.label == data::positionName || (!save.material.empty() && save.material != material))
      continue;
    const data::Label& label = *run.table[number].label;
    if (label.centring == Centring::reduction) {
      const std::vector<double> values = run.reduction(save.label);
      snapshot.totals.push_back({save.label, std::string(label.unit), std::string(label.description),
                                 static_cast<int>(values.size()), values});
      continue;
    }
    const bool derived = !run.warehouse.isHeld(Generation::old, number);
    output::Array array = stream(derived ? Generation::fresh : Generation::old, number);
    if (label.centring == Centring::particle)
      snapshot.particles[m].arrays.push_back(std::move(array));
    else if (array.entries() > 0)
      snapshot.fields.push_back({label.centring == Centring::node ? output::Centring::node : output::Centring::cell,
                                 material, m, std::move(array)});
  }
}

/// The state on the whole grid, with the particles of the requested materials.
template <class IsWanted>
output::Snapshot snapshotWith(RunState& run, const std::vector<SaveRequest>& requests, const IsWanted& isWanted) {
  Gather gather(run.warehouse);
  output::Snapshot snapshot = positions(run, gather, isWanted);
  const auto whole = [&](Generation generation, int number) { return gather.stream(generation, number); };
  for (const SaveRequest& request : requests) addField(run, request, whole, snapshot);
  return snapshot;
}

/// Whether a request is for particles of a material.
bool isOfParticles(const RunState& run, const SaveRequest& request, int material) {
  const int number = run.table.find(request.label, material);
  const bool isOfMaterial = request.material.empty() || request.material == run.phases.materials()[material];
  return isOfMaterial && number >= 0 && run.table[number].label->centring == Centring::particle;
}

/// The state in a part of the grid, without particles.
template <class Part>
output::Snapshot snapshotIn(RunState& run, const std::vector<SaveRequest>& requests, output::GridInfo grid,
                            const Part& where) {
  Gather gather(run.warehouse);
  output::Snapshot snapshot = emptySnapshot(run, std::move(grid));
  const auto part = [&](Generation generation, int number) { return gather.stream(generation, number, where); };
  for (const SaveRequest& request : requests) addField(run, request, part, snapshot);
  return snapshot;
}

/// Snapshots with the minimum, the maximum and the sum of values.
std::vector<output::Snapshot> summarySnapshots(RunState& run, const std::vector<SaveRequest>& requests,
                                               collect::SummaryOver over) {
  std::vector<output::Snapshot> parts(3, emptySnapshot(run, collect::gridInfo(*run.problem.grid)));
  for (const SaveRequest& request : requests) {
    collect::Summary summary;
    const auto take = [&](Generation generation, int number) {
      summary = collect::summaryOf(run.warehouse, generation, number, over);
      return summary.least;
    };
    const std::size_t before = parts[0].fields.size();
    addField(run, request, take, parts[0]);
    if (parts[0].fields.size() == before) continue;
    for (const auto& [part, array] : {std::pair{&parts[1], &summary.greatest}, {&parts[2], &summary.sum}}) {
      part->fields.push_back(parts[0].fields.back());
      part->fields.back().array = *array;
    }
  }
  return parts;
}

}  // namespace

output::Snapshot snapshotOf(RunState& run, const std::vector<SaveRequest>& requests) {
  return snapshotWith(run, requests, [](int) { return true; });
}

std::vector<output::Snapshot> partsOf(RunState& run, const Analysis& analysis) {
  const std::vector<SaveRequest> requests = analysis.samples();
  const grid::Grid& grid = *run.problem.grid;
  if (const auto over = analysis.summary()) return summarySnapshots(run, requests, *over);
  std::vector<output::Snapshot> parts;
  for (const collect::Layer& layer : analysis.layers())
    parts.push_back(snapshotIn(run, requests, collect::gridInfo(grid, layer), layer));
  for (const collect::Window& window : analysis.windows())
    parts.push_back(snapshotIn(run, requests, collect::gridInfo(grid, window), window));
  if (parts.empty())
    parts.push_back(snapshotWith(run, requests, [&](int material) {
      return std::any_of(requests.begin(), requests.end(),
                         [&](const SaveRequest& request) { return isOfParticles(run, request, material); });
    }));
  for (output::Snapshot& part : parts) output::load(part, run.ranks);
  return parts;
}

}  // namespace tushar::simulation
