#pragma once

#include <petscksp.h>
#include <petscsnes.h>

#include <exception>
#include <span>
#include <stdexcept>
#include <string>

#include "core/base/mpi_native.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// Throws std::runtime_error with PETSc's message if `code` reports a failure.
void check(PetscErrorCode code);

/// Initialises PETSc at the first call.
void startPetsc();

/// Owns a PETSc object.
template <class T, PetscErrorCode (*destroy)(T*)>
class Owned {
 public:
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { destroy(&object_); }

  operator T() const { return object_; }
  T* address() { return &object_; }

 private:
  T object_ = nullptr;
};
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedSnes = Owned<SNES, SNESDestroy>;
using OwnedNumbering = Owned<ISLocalToGlobalMapping, ISLocalToGlobalMappingDestroy>;
using OwnedNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

/// Sets the PETSc options of one solve while this object exists: the options in the settings of the solve, and those in
/// PETSC_OPTIONS, which take precedence. Other solves do not see them.
class PetscOptionsOfSolve {
 public:
  /// Initialises PETSc, if necessary.
  explicit PetscOptionsOfSolve(const std::string& options);
  PetscOptionsOfSolve(const PetscOptionsOfSolve&) = delete;
  PetscOptionsOfSolve& operator=(const PetscOptionsOfSolve&) = delete;
  ~PetscOptionsOfSolve();

  /// Options that have not been used by any solve so far, nor by the initialisation of PETSc.
  static std::vector<std::string> unused();

 private:
  void noteUse(const std::string& options);

  std::string given_;
  Owned<PetscOptions, PetscOptionsDestroy> options_;
};

/// A matrix of PETSc that is assembled block by block.
class PetscMatrix : public Matrix {
 public:
  /// An empty matrix with space for the entries that the unknowns declare, and with their null spaces.
  explicit PetscMatrix(const Unknowns& unknowns);

  void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) override;
  /// Empties the matrix, calls `fill` to add entries to it, and completes it.
  template <class Fill>
  void assemble(Fill&& fill) {
    check(MatZeroEntries(matrix_));
    fill(*this);
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }
  /// Scales the matrix A to S A S, where S is diagonal, and scales the near-null space for multigrid accordingly.
  void scale(Vec s);
  operator Mat() const { return matrix_; }

 private:
  void numberBlocks(const Unknowns& unknowns);
  void setNullSpaces(const Unknowns& unknowns);

  MPI_Comm ranks_;
  OwnedMat matrix_;
  OwnedNullSpace rigid_;  ///< the rigid-body modes, for the matrix before scaling
};

/// Solves A x = b as (S A S) y = S b, x = S y, where S makes all diagonal entries equal to the largest. Without this
/// scaling, the residuals of weakly held unknowns would not affect the norm, and multigrid would move these unknowns so
/// far that its round-off would stall a Krylov method.
class Balance {
 public:
  /// Constructs the scaling for right-hand sides with the layout of `b`.
  explicit Balance(Vec b);
  /// Scales the matrix; with `isNew`, chooses S by this matrix.
  void scale(PetscMatrix& matrix, bool isNew);
  /// Makes `krylov`, whose matrix has been scaled, accept the unscaled b and return the unscaled x.
  void attach(KSP krylov);

 private:
  void choose(const PetscMatrix& matrix);
  static PetscErrorCode before(KSP, Vec b, Vec, void* balance);
  static PetscErrorCode after(KSP, Vec b, Vec x, void* balance);

  OwnedVec s_, b_;
};

/// A PETSc vector that uses existing memory: the values of the owned unknowns.
class PetscVector {
 public:
  PetscVector(const Unknowns& unknowns, std::span<double> values);
  operator Vec() const { return vector_; }

 private:
  OwnedVec vector_;
};

/// The part of a global vector that a rank uses: its own entries, followed by the ghosts.
class GhostedVector {
 public:
  explicit GhostedVector(const Unknowns& unknowns);
  std::span<double> values() { return values_; }
  /// Copies the values of own entries and ghosts from `all`.
  void take(Vec all);
  /// Adds the values of own entries and ghosts of every rank to `all`.
  void addUp(Vec all);
  /// Sums the values of own and ghost entries over the ranks, in place.
  void addUp(std::span<double> values);

 private:
  std::vector<double> values_;
  OwnedVec vector_;
};

/// Sets method, preconditioner and tolerances, and then applies the user's options. `automatic` is the method that
/// replaces the solver `automatic`.
void configure(KSP krylov, LinearSettings settings, const char* automatic);

/// Runs `work` inside a callback of PETSc; an exception is stored until PETSc has returned.
template <class Work>
PetscErrorCode guarded(std::exception_ptr& thrown, Work&& work) {
  try {
    work();
    return 0;
  } catch (...) {
    thrown = std::current_exception();
    return PETSC_ERR_USER;
  }
}

/// The line search of Newton's method, chooseStep; `context` is a std::exception_ptr.
PetscErrorCode searchAlongStep(SNESLineSearch search, void* context);

/// The reason why a solve ended, in words, and PETSc's name for the reason.
std::string reasonOf(KSPConvergedReason reason);
std::string reasonOf(SNES snes);
/// The residual norms recorded by a Krylov method.
std::vector<double> residualsOf(KSP krylov);

/// Index of the unknown with the largest residual; -1 if another rank owns it.
int worstOf(Vec residual);

Outcome solveLinear(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
                    std::span<double> x);
Outcome solveNewton(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                    std::span<double> u);

}  // namespace tushar::solvers
