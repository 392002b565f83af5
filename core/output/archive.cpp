#include "core/output/archive.hpp"

#include <fmt/format.h>

#include <map>
#include <system_error>
#include <vector>

#include "core/base/error.hpp"
#include "core/output/archive_cut.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_index.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/archive_xdmf.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t bufferedBytes = 1 << 16;

/// `TotalMomentum.x [kg m/s]` for each component.
std::string columnNames(const GlobalSample& sample) {
  const std::size_t count = sample.values.size();
  std::string names;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string which = count == 1 ? "" : count == 3 ? std::string(".") + "xyz"[k] : fmt::format(".{}", k + 1);
    names += fmt::format(" {}{} [{}]", sample.name, which, sample.unit);
  }
  return names;
}

fs::path withoutSlash(const fs::path& filebase) { return filebase.has_filename() ? filebase : filebase.parent_path(); }

}  // namespace

struct Archive::State {
  State(const fs::path& filebase, const ArchiveOptions& how)
      : options(how),
        folder(makeNextFolder(filebase)),
        xdmf_file(folder / (filebase.stem().string() + ".xdmf")),
        index(how.version),
        xdmf(how.doubleAsFloat) {}
  State(fs::path existing, const fs::path& name, const ArchivePoint& from, const ArchiveOptions& how)
      : options(how),
        folder(std::move(existing)),
        xdmf_file(folder / (name.stem().string() + ".xdmf")),
        index(how.version, xmlOr(indexFile(), ArchiveIndex::rootName, from.index), from.step),
        xdmf(how.doubleAsFloat, xmlOr(xdmf_file, XdmfIndex::rootName, from.xdmf), from.step),
        last_step(index.lastStep()) {}

  fs::path indexFile() const { return folder / "index.xml"; }
  fs::path fileOf(const std::string& global) const { return folder / (nameInPath(global) + ".dat"); }
  void writePending();
  void writeIndex() { replaceFile(indexFile(), index.text()); }
  void cutGlobals(double time);

  ArchiveOptions options;
  fs::path folder, xdmf_file;
  ArchiveIndex index;
  XdmfIndex xdmf;
  std::map<std::string, std::string> pending;  ///< lines of each global that wait to be written
  std::vector<fs::path> unsynced;              ///< outputs that may not be on the disk yet
  bool new_global = false;                     ///< the index on disk lacks a global
  int last_step = -1;
};

void Archive::State::writePending() {
  for (auto& [name, lines] : pending) {
    if (lines.empty()) continue;
    appendToFile(fileOf(name), lines);
    lines.clear();
  }
}

void Archive::State::cutGlobals(double time) {
  for (const std::string& name : index.globals()) {
    const std::string lines = textOf(fileOf(name)).value_or(""), kept = linesUpTo(lines, time);
    if (kept.empty()) continue;
    if (kept != lines) replaceFile(fileOf(name), kept);
    pending[name];
  }
}

Archive::Archive(const fs::path& filebase, const std::string& inputXml, const ArchiveOptions& options)
    : state_(std::make_unique<State>(withoutSlash(filebase), options)) {
  replaceFile(state_->folder / "input.xml", inputXml);
  state_->writeIndex();
  pointLink(withoutSlash(filebase), state_->folder);
}

Archive::Archive(const fs::path& folder, const std::string& name, const ArchivePoint& from, const std::string& inputXml,
                 const ArchiveOptions& options)
    : state_(std::make_unique<State>(folder, name, from, options)) {
  if (textOf(folder / "input.xml") != inputXml) replaceFileOnDisk(folder / "input.xml", inputXml);
  state_->cutGlobals(from.time);
  state_->writeIndex();
  if (state_->last_step >= 0 || fs::exists(state_->xdmf_file)) replaceFile(state_->xdmf_file, state_->xdmf.text());
  removeOutputsAfter(folder, from.step);
}

Archive::~Archive() {
  try {
    flush();
  } catch (const FileError&) {
    // The run has ended, and whoever wants to know of it has called flush().
  }
}

void Archive::write(const Snapshot& snapshot) {
  const fs::path file = state_->folder / outputName(snapshot.step);
  writeSnapshot(file, snapshot, state_->options);
  state_->unsynced.push_back(file);
  state_->index.add(snapshot);
  state_->xdmf.add(snapshot);
  state_->writePending();
  state_->writeIndex();
  replaceFile(state_->xdmf_file, state_->xdmf.text());
  state_->new_global = false;
  state_->last_step = snapshot.step;
}

void Archive::appendGlobal(const GlobalSample& sample) {
  const auto [place, isNew] = state_->pending.try_emplace(sample.name);
  std::string& lines = place->second;
  if (isNew) {
    state_->index.add(sample, nameInPath(sample.name) + ".dat");
    state_->new_global = true;
    std::error_code ignored;
    fs::remove(state_->fileOf(sample.name), ignored);
    lines = "# time [s]" + columnNames(sample) + "\n";
  }
  lines += fmt::format("{}", sample.time);
  for (const double value : sample.values) lines += fmt::format(" {}", value);
  lines += '\n';
  if (lines.size() > bufferedBytes) state_->writePending();
}

void Archive::flush() {
  state_->writePending();
  if (state_->new_global) state_->writeIndex();
  state_->new_global = false;
}

ArchivePoint Archive::sync(int step, double time) {
  flush();
  for (const fs::path& output : state_->unsynced) syncToDisk(output);
  for (const auto& global : state_->pending) syncToDisk(state_->fileOf(global.first));
  syncToDisk(state_->indexFile());
  if (state_->last_step >= 0) syncToDisk(state_->xdmf_file);
  syncToDisk(state_->folder);
  state_->unsynced.clear();
  return {step, time, state_->index.text(), state_->xdmf.text()};
}

const fs::path& Archive::folder() const { return state_->folder; }

int Archive::lastStep() const { return state_->last_step; }

}  // namespace tushar::output
