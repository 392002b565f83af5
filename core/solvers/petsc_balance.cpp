#include <cmath>
#include <vector>

#include "core/solvers/petsc_objects.hpp"

namespace tushar::solvers {

namespace {

/// The vectors of a null space, multiplied by S^-1 and orthonormalised.
std::vector<OwnedVec> motionsOver(Vec s, MatNullSpace space) {
  PetscBool hasConstant = PETSC_FALSE;
  PetscInt count = 0;
  const Vec* given = nullptr;
  check(MatNullSpaceGetVecs(space, &hasConstant, &count, &given));
  const PetscInt constants = hasConstant ? 1 : 0;
  std::vector<OwnedVec> motions(constants + count);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    check(VecDuplicate(s, motions[k].address()));
    if (hasConstant && k == 0)
      check(VecSet(motions[k], 1));
    else
      check(VecCopy(given[k - constants], motions[k]));
    check(VecPointwiseDivide(motions[k], motions[k], s));
    for (std::size_t before = 0; before < k; ++before) {
      PetscScalar along = 0;
      check(VecDot(motions[k], motions[before], &along));
      check(VecAXPY(motions[k], -along, motions[before]));
    }
    check(VecNormalize(motions[k], nullptr));
  }
  return motions;
}

}  // namespace

void PetscMatrix::scale(Vec s) {
  check(MatDiagonalScale(matrix_, s, s));
  if (!rigid_) return;
  const std::vector<OwnedVec> motions = motionsOver(s, rigid_);
  const std::vector<Vec> vectors(motions.begin(), motions.end());
  OwnedNullSpace scaled;
  check(
      MatNullSpaceCreate(ranks_, PETSC_FALSE, static_cast<PetscInt>(vectors.size()), vectors.data(), scaled.address()));
  check(MatSetNearNullSpace(matrix_, scaled));
}

Balance::Balance(Vec b) {
  check(VecDuplicate(b, s_.address()));
  check(VecDuplicate(b, b_.address()));
}

void Balance::scale(PetscMatrix& matrix, bool isNew) {
  if (isNew) choose(matrix);
  matrix.scale(s_);
}

/// Chooses s_i = (max_k |a_kk| / |a_ii|)^(1/2), and s_i = 1 where a_ii is 0.
void Balance::choose(const PetscMatrix& matrix) {
  check(MatGetDiagonal(matrix, s_));
  check(VecAbs(s_));
  PetscReal greatest = 0;
  check(VecMax(s_, nullptr, &greatest));
  PetscInt count = 0;
  PetscScalar* values = nullptr;
  check(VecGetLocalSize(s_, &count));
  check(VecGetArray(s_, &values));
  for (PetscInt k = 0; k < count; ++k) values[k] = values[k] > 0 ? std::sqrt(greatest / values[k]) : 1.0;
  check(VecRestoreArray(s_, &values));
}

void Balance::attach(KSP krylov) {
  check(KSPSetPreSolve(krylov, before, this));
  check(KSPSetPostSolve(krylov, after, this));
}

PetscErrorCode Balance::before(KSP, Vec b, Vec, void* balance) {
  const Balance& self = *static_cast<Balance*>(balance);
  if (const PetscErrorCode code = VecCopy(b, self.b_)) return code;
  return VecPointwiseMult(b, b, self.s_);
}

PetscErrorCode Balance::after(KSP, Vec b, Vec x, void* balance) {
  const Balance& self = *static_cast<Balance*>(balance);
  if (const PetscErrorCode code = VecCopy(self.b_, b)) return code;
  return VecPointwiseMult(x, x, self.s_);
}

}  // namespace tushar::solvers
