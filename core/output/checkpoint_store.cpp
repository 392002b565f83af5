#include "core/output/checkpoint_store.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/mpi_together.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* latestName = "LATEST";

}  // namespace

CheckpointStore::CheckpointStore(const fs::path& archive, int cycle, const Writers& writers)
    : folder_(archive / "checkpoints"), cycle_(cycle), writers_(writers) {}

fs::path CheckpointStore::folder(int step) const { return folder_ / stepName(step); }

std::vector<int> CheckpointStore::steps() const {
  std::vector<int> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error))
    if (const auto step = stepOf(entry.path().filename().string())) found.push_back(*step);
  std::sort(found.begin(), found.end());
  return found;
}

int CheckpointStore::latest() const {
  const std::vector<int> all = steps();
  std::string name = textOf(folder_ / latestName).value_or("");
  if (name.ends_with('\n')) name.pop_back();
  const auto named = stepOf(name);
  if (named && std::binary_search(all.begin(), all.end(), *named)) return *named;
  return all.empty() ? -1 : all.back();
}

void CheckpointStore::write(int step, const std::function<std::vector<FilePart>(const fs::path&)>& fill,
                            const Pace& pace) const {
  const mpi::Communicator& ranks = writers_.ranks();
  const fs::path temporary = temporaryOf(folder(step));
  try {
    ranks.onFirst([&] {
      makeFolder(folder_);
      removeLeftovers();
      makeFolder(temporary);
    });
    const std::vector<FilePart> parts = fill(temporary);
    writeManifest(temporary, writers_, parts, pace.waitsForDisk);
    ranks.onFirst([&] { moveInto(temporary, folder(step)); });
  } catch (...) {
    if (ranks.isFirst()) removeLeftovers();
    throw;
  }
  ranks.onFirst([&] {
    if (pace.waitsForDisk) syncToDisk(folder_);
    setLatest(step, pace.waitsForDisk);
    removeOldest(pace.waitsForDisk ? -1 : pace.lastOnDisk);
  });
}

void CheckpointStore::bringToDisk(int step) const {
  mpi::together(writers_.ranks(), [&] {  // each node has pages of its own
    if (writers_.mine() < 0) return;
    for (const auto& entry : fs::directory_iterator(folder(step))) syncToDisk(entry.path());
  });
  writers_.ranks().onFirst([&] {
    syncToDisk(folder(step));
    syncToDisk(folder_);
    setLatest(step);
    removeOldest(-1);
  });
}

/// Removes the oldest checkpoints beyond the cycle, but not that of step `except`.
void CheckpointStore::removeOldest(int except) const {
  const std::vector<int> all = steps();
  for (std::size_t k = 0; k + static_cast<std::size_t>(cycle_) < all.size(); ++k)
    if (all[k] != except) remove(all[k]);
}

void CheckpointStore::goBackTo(int step) const {
  setLatest(step);
  for (const int other : steps())
    if (other > step) remove(other);
}

void CheckpointStore::setLatest(int step, bool waitsForDisk) const {
  const std::string name = stepName(step) + "\n";
  waitsForDisk ? replaceFileOnDisk(folder_ / latestName, name) : replaceFile(folder_ / latestName, name);
}

/// Removes a checkpoint. Renames its folder first, so that a partly removed folder is not mistaken for a checkpoint.
void CheckpointStore::remove(int step) const {
  moveInto(folder(step), temporaryOf(folder(step)));
  removeLeftovers();
}

void CheckpointStore::removeLeftovers() const {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().extension() == ".tmp") leftovers.push_back(entry.path());
  for (const fs::path& path : leftovers) fs::remove_all(path, ignored);
}

}  // namespace tushar::output
