#include "core/output/archive.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"
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

  void writePending();
  void writeIndex() { replaceFile(folder / "index.xml", index.text()); }

  ArchiveOptions options;
  fs::path folder, xdmf_file;
  ArchiveIndex index;
  XdmfIndex xdmf;
  std::map<std::string, std::string> pending;  ///< lines of each global that wait to be written
  bool new_global = false;                     ///< the index on disk lacks a global
  int last_step = -1;
};

void Archive::State::writePending() {
  for (auto& [name, lines] : pending) {
    if (lines.empty()) continue;
    appendToFile(folder / (nameInPath(name) + ".dat"), lines);
    lines.clear();
  }
}

Archive::Archive(const fs::path& filebase, const std::string& inputXml, const ArchiveOptions& options)
    : state_(std::make_unique<State>(withoutSlash(filebase), options)) {
  replaceFile(state_->folder / "input.xml", inputXml);
  state_->writeIndex();
  pointLink(withoutSlash(filebase), state_->folder);
}

Archive::~Archive() {
  try {
    flush();
  } catch (const FileError&) {
    // The run has ended, and whoever wants to know of it has called flush().
  }
}

void Archive::write(const Snapshot& snapshot) {
  writeSnapshot(state_->folder / outputName(snapshot.step), snapshot, state_->options);
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

const fs::path& Archive::folder() const { return state_->folder; }

int Archive::lastStep() const { return state_->last_step; }

}  // namespace tushar::output
