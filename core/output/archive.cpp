#include "core/output/archive.hpp"

#include <system_error>

#include "core/base/error.hpp"
#include "core/output/archive_cut.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_globals.hpp"
#include "core/output/archive_index.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/archive_xdmf.hpp"
#include "core/output/pace.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

fs::path withoutSlash(const fs::path& filebase) { return filebase.has_filename() ? filebase : filebase.parent_path(); }

}  // namespace

struct Archive::State {
  State(const fs::path& filebase, const ArchiveOptions& how)
      : options(how),
        folder(makeNextFolder(filebase)),
        index(how.version),
        xdmf(folder / (filebase.stem().string() + ".xdmf"), how.doubleAsFloat) {}
  State(fs::path existing, const fs::path& name, const ArchivePoint& from, const ArchiveOptions& how)
      : options(how),
        folder(std::move(existing)),
        index(how.version, fullerIndex(indexFile(), from.index, from.step), from.step),
        xdmf(folder / (name.stem().string() + ".xdmf"), how.doubleAsFloat),
        last_step(index.lastStep()) {
    xdmf.resume(index);
  }

  fs::path indexFile() const { return folder / "index.xml"; }
  /// Writes index.xml and the XDMF file; if there are no outputs, only the index.
  void writeLists();
  void writeVtkHdfFiles();

  ArchiveOptions options;
  fs::path folder;
  ArchiveIndex index;
  XdmfIndex xdmf;
  GlobalFiles globals{folder};
  Pace pace;                         ///< when to write the lists
  std::vector<std::string> damages;  ///< of the `.dat` files of the run that is continued
  int last_step = -1;
  Pace vtkhdf_pace;  ///< when to write the VTKHDF files, which takes longer
};

void Archive::State::writeLists() {
  pace.catchUp([&] {
    replaceFile(indexFile(), [this](std::ostream& out) { index.write(out); });
    if (last_step >= 0) xdmf.write();
  });
}

void Archive::State::writeVtkHdfFiles() {
  vtkhdf_pace.catchUp([&] {
    if (last_step >= 0) xdmf.writeVtkHdf();
  });
}

Archive::Archive(const fs::path& filebase, const std::string& inputXml, const ArchiveOptions& options)
    : state_(std::make_unique<State>(withoutSlash(filebase), options)) {
  replaceFile(state_->folder / "input.xml", inputXml);
  state_->writeLists();
  pointLink(withoutSlash(filebase), state_->folder);
}

Archive::Archive(const fs::path& folder, const std::string& name, const ArchivePoint& from, const std::string& inputXml,
                 const ArchiveOptions& options)
    : state_(std::make_unique<State>(folder, name, from, options)) {
  if (textOf(folder / "input.xml") != inputXml) replaceFileOnDisk(folder / "input.xml", inputXml);
  state_->damages = state_->globals.resume(state_->index.globals(), from.time);
  state_->writeLists();
  std::error_code ignored;
  if (state_->last_step < 0) fs::remove(state_->xdmf.file(), ignored);
  state_->vtkhdf_pace.note(true);
  removeUnlisted(folder, state_->index);
}

Archive::~Archive() {
  try {
    flush();
  } catch (const FileError&) {
    // The run has ended, and callers who want its errors have called flush().
  }
}

void Archive::write(const Snapshot& snapshot) {
  writeSnapshot(state_->folder / outputName(snapshot.step), snapshot, state_->options);
  list(snapshot);
}

void Archive::list(const Snapshot& snapshot) {
  const bool hasNewNames = state_->index.add(snapshot);
  state_->xdmf.add(snapshot);
  state_->last_step = snapshot.step;
  state_->pace.note(hasNewNames);
  state_->vtkhdf_pace.note(hasNewNames);
  keepUp();
}

void Archive::appendGlobal(const GlobalSample& sample) {
  if (!state_->globals.append(sample)) return;
  state_->index.add(sample, GlobalFiles::nameOf(sample.name));
  state_->pace.note(true);
}

void Archive::keepUp() {
  if (state_->pace.isDue()) state_->writeLists();
  if (state_->vtkhdf_pace.isDue()) state_->writeVtkHdfFiles();
}

void Archive::flush() {
  if (state_->pace.isBehind()) state_->writeLists();
  if (state_->vtkhdf_pace.isBehind()) state_->writeVtkHdfFiles();
}

/// Does not write the lists: a run that continues from a checkpoint uses the list in it, and adds the later outputs
/// again.
void Archive::sync() const {
  state_->globals.sync();
  syncToDisk(state_->folder);
}

ArchivePoint Archive::pointAt(int step, double time) const { return {step, time, state_->index.text()}; }

const fs::path& Archive::folder() const { return state_->folder; }

const std::vector<std::string>& Archive::damages() const { return state_->damages; }

int Archive::lastStep() const { return state_->last_step; }

}  // namespace tushar::output
