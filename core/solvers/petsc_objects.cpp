#include "core/solvers/petsc_objects.hpp"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace tushar::solvers {

namespace {

/// The message of the last error in PETSc.
std::string& lastMessage() {
  static std::string message;
  return message;
}

PetscErrorCode keepMessage(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType type,
                           const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL && message) lastMessage() = message;
  return code;
}

/// Preserves the program's reaction to SIGTERM, which is to write output and end the run. PETSc installs its own
/// handler when it starts, and restores the system's default when it ends.
class KeptTermination {
 public:
  KeptTermination() { sigaction(SIGTERM, nullptr, &before_); }
  ~KeptTermination() { sigaction(SIGTERM, &before_, nullptr); }
  KeptTermination(const KeptTermination&) = delete;
  KeptTermination& operator=(const KeptTermination&) = delete;

 private:
  struct sigaction before_ {};
};

/// PETSc from the first solve to the end of the program.
class Session {
 public:
  Session() {
    const KeptTermination kept;
    PetscBool started = PETSC_FALSE;
    PetscInitialized(&started);
    int underLauncher = 0;
    MPI_Initialized(&underLauncher);
    if (underLauncher) PETSC_COMM_WORLD = MPI_COMM_SELF;  // ranks without patches do not come here
    // Without a launcher, Open MPI would start a daemon for processes that the program may start later, which would
    // take a fifth of the processor time of a small run.
    if (!underLauncher) setenv("OMPI_MCA_ess_singleton_isolated", "true", 0);
    if (!started) check(PetscInitializeNoArguments());
    check(PetscPushErrorHandler(keepMessage, nullptr));
    check(PetscPopSignalHandler());
  }
  ~Session() {
    int over = 0;
    MPI_Finalized(&over);
    if (!over) PetscFinalize();
  }
};

}  // namespace

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* words = nullptr;
  PetscErrorMessage(code, &words, nullptr);
  throw std::runtime_error(
      fmt::format("PETSc: {}{}{}", words ? words : "error", lastMessage().empty() ? "" : ": ", lastMessage()));
}

void startPetsc() { static const Session session; }

PetscMatrix::PetscMatrix(const Unknowns& unknowns) : ranks_(mpi::handleOf(*unknowns.ranks)) {
  const PetscInt block = unknowns.block, rows = block * unknowns.owned;
  check(MatCreate(ranks_, matrix_.address()));
  check(MatSetSizes(matrix_, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix_, block));
  check(MatSetType(matrix_, MATAIJ));
  check(MatXAIJSetPreallocation(matrix_, block, unknowns.entries.data(), unknowns.entries.data(), nullptr, nullptr));
  numberBlocks(unknowns);
  setNullSpaces(unknowns);
}

void PetscMatrix::numberBlocks(const Unknowns& unknowns) {
  PetscInt first = 0;
  check(MatGetOwnershipRange(matrix_, &first, nullptr));
  std::vector<PetscInt> numbers(unknowns.owned);
  std::iota(numbers.begin(), numbers.end(), first / unknowns.block);
  numbers.insert(numbers.end(), unknowns.ghosts.begin(), unknowns.ghosts.end());
  OwnedNumbering numbering;
  check(ISLocalToGlobalMappingCreate(ranks_, unknowns.block, static_cast<PetscInt>(numbers.size()), numbers.data(),
                                     PETSC_COPY_VALUES, numbering.address()));
  check(MatSetLocalToGlobalMapping(matrix_, numbering, numbering));
}

void PetscMatrix::setNullSpaces(const Unknowns& unknowns) {
  if (unknowns.constantIsFree) {
    OwnedNullSpace constant;
    check(MatNullSpaceCreate(ranks_, PETSC_TRUE, 0, nullptr, constant.address()));
    check(MatSetNullSpace(matrix_, constant));
  }
  int given = unknowns.coordinates.empty() ? 0 : 1;  // none on a rank that owns nothing
  MPI_Allreduce(MPI_IN_PLACE, &given, 1, MPI_INT, MPI_MAX, ranks_);
  if (given == 0) return;
  OwnedVec places;
  check(MatCreateVecs(matrix_, places.address(), nullptr));
  check(VecSetBlockSize(places, unknowns.block));
  PetscScalar* values = nullptr;
  check(VecGetArrayWrite(places, &values));
  std::copy(unknowns.coordinates.begin(), unknowns.coordinates.end(), values);
  check(VecRestoreArrayWrite(places, &values));
  if (unknowns.block > 1)
    check(MatNullSpaceCreateRigidBody(places, rigid_.address()));
  else
    check(MatNullSpaceCreate(ranks_, PETSC_TRUE, 0, nullptr, rigid_.address()));
  check(MatSetNearNullSpace(matrix_, rigid_));
}

void PetscMatrix::add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) {
  check(MatSetValuesBlockedLocal(matrix_, static_cast<PetscInt>(rows.size()), rows.data(),
                                 static_cast<PetscInt>(columns.size()), columns.data(), values.data(), ADD_VALUES));
}

PetscVector::PetscVector(const Unknowns& unknowns, std::span<double> values) {
  check(VecCreateMPIWithArray(mpi::handleOf(*unknowns.ranks), unknowns.block, unknowns.block * unknowns.owned,
                              PETSC_DETERMINE, values.data(), vector_.address()));
}

GhostedVector::GhostedVector(const Unknowns& unknowns)
    : values_(static_cast<std::size_t>(unknowns.block) * (unknowns.owned + unknowns.ghosts.size())) {
  check(VecCreateGhostBlockWithArray(mpi::handleOf(*unknowns.ranks), unknowns.block, unknowns.block * unknowns.owned,
                                     PETSC_DETERMINE, static_cast<PetscInt>(unknowns.ghosts.size()),
                                     unknowns.ghosts.data(), values_.data(), vector_.address()));
}

void GhostedVector::take(Vec all) {
  check(VecCopy(all, vector_));
  check(VecGhostUpdateBegin(vector_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecGhostUpdateEnd(vector_, INSERT_VALUES, SCATTER_FORWARD));
}

void GhostedVector::addUp(Vec all) {
  check(VecGhostUpdateBegin(vector_, ADD_VALUES, SCATTER_REVERSE));
  check(VecGhostUpdateEnd(vector_, ADD_VALUES, SCATTER_REVERSE));
  check(VecCopy(vector_, all));
}

void GhostedVector::addUp(std::span<double> values) {
  std::copy(values.begin(), values.end(), values_.begin());
  check(VecGhostUpdateBegin(vector_, ADD_VALUES, SCATTER_REVERSE));
  check(VecGhostUpdateEnd(vector_, ADD_VALUES, SCATTER_REVERSE));
  check(VecGhostUpdateBegin(vector_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecGhostUpdateEnd(vector_, INSERT_VALUES, SCATTER_FORWARD));
  std::copy(values_.begin(), values_.end(), values.begin());
}

void configure(KSP krylov, LinearSettings settings, const char* automatic) {
  if (settings.solver == "automatic") settings.solver = automatic;
  if (settings.preconditioner == "multigrid") settings.preconditioner = "hypre";
  check(KSPSetType(krylov, settings.solver.c_str()));
  check(KSPSetTolerances(krylov, settings.tolerance, 0, 1e10, settings.maxIterations));
  check(KSPSetNormType(krylov, settings.solver == "preonly" ? KSP_NORM_NONE : KSP_NORM_UNPRECONDITIONED));
  if (settings.solver == "gmres") {
    check(KSPSetPCSide(krylov, PC_RIGHT));
    // Without it, nearly singular systems fail through rounding.
    check(KSPGMRESSetCGSRefinementType(krylov, KSP_GMRES_CGS_REFINE_IFNEEDED));
    // By default, PETSc restarts after 30 iterations; nearly incompressible systems then do not converge.
    check(KSPGMRESSetRestart(krylov, std::min(settings.maxIterations, 200)));
  }
  PC preconditioner = nullptr;
  check(KSPGetPC(krylov, &preconditioner));
  check(PCSetType(preconditioner, settings.preconditioner.c_str()));
  // Later tangents of a solve have the same entries, so the first determines which unknowns GAMG aggregates.
  check(PCGAMGSetReuseInterpolation(preconditioner, PETSC_TRUE));
  check(KSPSetFromOptions(krylov));
}

int worstOf(Vec residual) {
  struct {
    double size;
    int rank;
  } mine{-1, 0}, greatest{};
  PetscInt count = 0;
  const PetscScalar* values = nullptr;
  check(VecGetLocalSize(residual, &count));
  check(VecGetArrayRead(residual, &values));
  int worst = -1;
  for (PetscInt k = 0; k < count; ++k) {
    const double size = std::isnan(values[k]) ? std::numeric_limits<double>::infinity() : std::abs(values[k]);
    if (size <= mine.size) continue;
    mine.size = size;
    worst = static_cast<int>(k);
  }
  check(VecRestoreArrayRead(residual, &values));
  MPI_Comm ranks = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(residual), &ranks));
  MPI_Comm_rank(ranks, &mine.rank);
  MPI_Allreduce(&mine, &greatest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ranks);
  return greatest.rank == mine.rank ? worst : -1;
}

}  // namespace tushar::solvers
