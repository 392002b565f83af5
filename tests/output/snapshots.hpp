#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/output/snapshot.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::output {

/// A folder for one test, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> made{0};
    path_ = test::newFolder("output_" + std::to_string(made++));
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  operator const std::filesystem::path&() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Returns the content of a file.
inline std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A real array whose value with index k is first + k.
inline Array counting(const std::string& label, int components, std::size_t entries, double first) {
  std::vector<double> values(entries * components);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = first + static_cast<double>(k);
  return {label, "m/s", "numbers from " + std::to_string(first), components, values};
}

/// `count` particles of a material with a vector, a tensor and ids.
inline ParticleBlock particles(const std::string& material, int index, std::size_t count, double first) {
  ParticleBlock block{material, index, {}};
  block.arrays.push_back(counting("p.x", 3, count, first));
  block.arrays.push_back(counting("p.density", 1, count, first + 0.5));
  block.arrays.push_back(counting("p.velocity", 3, count, -first));
  block.arrays.push_back(counting("p.stress", 9, count, first * first));
  std::vector<std::uint64_t> ids(count);
  for (std::size_t k = 0; k < count; ++k) ids[k] = (std::uint64_t{1} << 40) + k;
  block.arrays.push_back({"p.particleID", "", "identity", 1, ids});
  std::vector<std::int32_t> marks(count, -7);
  block.arrays.push_back({"p.mark", "", "a mark", 1, marks});
  return block;
}

inline Snapshot emptySnapshot(int step, double time) {
  Snapshot snapshot;
  snapshot.step = step;
  snapshot.time = time;
  snapshot.delT = 0.125;
  return snapshot;
}

/// Two materials, the second without particles, and fields on 4 × 3 × 2 cells with lower corner (-1, 0, 2).
inline Snapshot snapshot3d(int step, double time) {
  Snapshot snapshot = emptySnapshot(step, time);
  snapshot.grid = {{-1, 0, 2}, {0.5, 0.25, 2}, {{4, 3, 2}}, 3};
  snapshot.particles = {particles("gas", 0, 5, 10 + time), particles("steel ball", 1, 0, 0)};
  snapshot.fields = {{Centring::cell, "", -1, counting("c.temperature", 1, 24, 300 + time)},
                     {Centring::cell, "gas", 0, counting("c.density", 1, 24, 1)},
                     {Centring::node, "gas", 0, counting("g.velocity", 3, 60, time)},
                     {Centring::node, "", -1, counting("g.mass", 1, 60, 7)}};
  snapshot.reference = {counting("x", 1, 11, 0), counting("density", 1, 11, 3)};
  return snapshot;
}

/// 4 × 2 cells with the lower corner (-1, 3): the right half is refined once, and a quarter of it twice, so that there
/// are 32 cells in 4 boxes. And particles of one material.
inline Snapshot snapshotRefined(int step, double time) {
  Snapshot snapshot = emptySnapshot(step, time);
  snapshot.grid = {{-1, 3, 0}, {0.1, 0.2, 2}, {{4, 2, 1}}, 2};
  snapshot.grid.boxes = {{0, {{0, 0, 0}}, {{2, 2, 1}}},
                         {1, {{4, 0, 0}}, {{6, 4, 1}}},
                         {1, {{6, 0, 0}}, {{8, 2, 1}}},
                         {2, {{12, 4, 0}}, {{16, 8, 1}}}};
  snapshot.grid.levels = 3;
  snapshot.particles = {particles("gas", 0, 5, 10 + time)};
  snapshot.fields = {{Centring::cell, "", -1, counting("c.temperature", 1, 32, 300 + time)},
                     {Centring::cell, "", -1, counting("c.velocity", 3, 32, -time)},
                     {Centring::cell, "gas", 0, counting("c.density", 1, 32, 1)}};
  return snapshot;
}

/// The grid of snapshotRefined() before its refinement: one box.
inline Snapshot snapshotUnrefined(int step, double time) {
  Snapshot snapshot = snapshotRefined(step, time);
  snapshot.grid.boxes = {{0, {{0, 0, 0}}, {{4, 2, 1}}}};
  snapshot.fields = {{Centring::cell, "", -1, counting("c.temperature", 1, 8, 300 + time)}};
  return snapshot;
}

}  // namespace tushar::output
