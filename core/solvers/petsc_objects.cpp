#include "core/solvers/petsc_objects.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace tushar::solvers {

namespace {

/// What PETSc said of the error that it is about to return.
std::string& lastMessage() {
  static std::string message;
  return message;
}

PetscErrorCode keepMessage(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType type,
                           const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL && message) lastMessage() = message;
  return code;
}

/// PETSc from the first solve to the end of the program.
class Session {
 public:
  Session() {
    PetscBool started = PETSC_FALSE;
    PetscInitialized(&started);
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
  throw std::runtime_error(fmt::format("PETSc: {}{}{}", words ? words : "error", lastMessage().empty() ? "" : ": ",
                                       lastMessage()));
}

void startPetsc(const std::string& options) {
  static const Session session;
  if (!options.empty()) check(PetscOptionsInsertString(nullptr, options.c_str()));
  if (const char* given = std::getenv("PETSC_OPTIONS")) check(PetscOptionsInsertString(nullptr, given));
}

PetscMatrix::PetscMatrix(const Unknowns& unknowns) {
  const PetscInt block = unknowns.block, rows = block * unknowns.owned;
  check(MatCreate(communicator(), matrix_.address()));
  check(MatSetSizes(matrix_, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix_, block));
  check(MatSetType(matrix_, MATAIJ));
  check(MatXAIJSetPreallocation(matrix_, block, unknowns.entries.data(), nullptr, nullptr, nullptr));
  setNullSpaces(unknowns);
}

void PetscMatrix::setNullSpaces(const Unknowns& unknowns) {
  if (unknowns.constantIsFree) {
    OwnedNullSpace constant;
    check(MatNullSpaceCreate(communicator(), PETSC_TRUE, 0, nullptr, constant.address()));
    check(MatSetNullSpace(matrix_, constant));
  }
  if (unknowns.coordinates.empty() || unknowns.block == 1) return;
  OwnedVec places;
  check(MatCreateVecs(matrix_, places.address(), nullptr));
  check(VecSetBlockSize(places, unknowns.block));
  PetscScalar* values = nullptr;
  check(VecGetArrayWrite(places, &values));
  std::copy(unknowns.coordinates.begin(), unknowns.coordinates.end(), values);
  check(VecRestoreArrayWrite(places, &values));
  OwnedNullSpace rigid;
  check(MatNullSpaceCreateRigidBody(places, rigid.address()));
  check(MatSetNearNullSpace(matrix_, rigid));
}

void PetscMatrix::add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) {
  check(MatSetValuesBlocked(matrix_, static_cast<PetscInt>(rows.size()), rows.data(),
                            static_cast<PetscInt>(columns.size()), columns.data(), values.data(), ADD_VALUES));
}

PetscVector::PetscVector(const Unknowns& unknowns, std::span<double> values) {
  check(VecCreateMPIWithArray(communicator(), unknowns.block, unknowns.block * unknowns.owned, PETSC_DETERMINE,
                              values.data(), vector_.address()));
}

void configure(KSP krylov, const LinearSettings& settings) {
  check(KSPSetType(krylov, settings.solver.c_str()));
  check(KSPSetTolerances(krylov, settings.tolerance, 0, 1e10, settings.maxIterations));
  check(KSPSetNormType(krylov, settings.solver == "preonly" ? KSP_NORM_NONE : KSP_NORM_UNPRECONDITIONED));
  if (settings.solver == "gmres") check(KSPSetPCSide(krylov, PC_RIGHT));
  PC preconditioner = nullptr;
  check(KSPGetPC(krylov, &preconditioner));
  check(PCSetType(preconditioner, settings.preconditioner.c_str()));
  check(KSPSetFromOptions(krylov));
}

int worstOf(Vec residual) {
  PetscInt count = 0;
  const PetscScalar* values = nullptr;
  check(VecGetLocalSize(residual, &count));
  check(VecGetArrayRead(residual, &values));
  int worst = -1;
  for (PetscInt k = 0; k < count; ++k)
    if (worst < 0 || !(std::abs(values[k]) <= std::abs(values[worst]))) worst = static_cast<int>(k);
  check(VecRestoreArrayRead(residual, &values));
  return worst;
}

}  // namespace tushar::solvers
