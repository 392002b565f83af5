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

std::string versionText() {
  return fmt::format(
      "sus {} ({})\n"
      "commit    {}\n"
      "compiler  {}\n"
      "MPI       {}\n"
      "HDF5      {}\n"
      "PETSc     {}\n"
      "Eigen     {}.{}.{}\n"
      "TBB       {}\n",
      TUSHAR_VERSION, TUSHAR_BUILD_TYPE, buildCommit, compiler, mpi::libraryVersion(), output::hdf5Version(),
      solvers::petscVersion(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, tbbVersion());
}

}  // namespace tushar
