#include "tools/version.hpp"

#include <fmt/format.h>

#include <Eigen/Core>

#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"
#include "core/output/archive_hdf5.hpp"
#include "core/solvers/solver.hpp"

namespace tushar {

namespace {

#ifdef __clang__
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

}  // namespace

output::RunRecord buildRecord() {
  output::RunRecord record;
  record.version = TUSHAR_VERSION;
  record.build = TUSHAR_BUILD_TYPE;
  record.commit = buildCommit;
  record.compiler = compiler;
  record.flags = buildFlags;
  record.libraries = {{"MPI", mpi::libraryVersion()},
                      {"HDF5", output::hdf5Version()},
                      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
                      {"TBB", tbbVersion()}};
  return record;
}

std::string versionText() {
  output::RunRecord record = buildRecord();
  record.libraries.emplace(record.libraries.begin() + 2, "PETSc", solvers::petscVersion());
  std::string text = fmt::format("sus {} ({})\n{:<9} {}\n{:<9} {}\n", record.version, record.build, "commit",
                                 record.commit, "compiler", record.compiler);
  for (const auto& [name, version] : record.libraries) text += fmt::format("{:<9} {}\n", name, version);
  return text;
}

}  // namespace tushar
