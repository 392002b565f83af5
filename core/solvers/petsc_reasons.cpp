#include <fmt/format.h>

#include "core/solvers/petsc_objects.hpp"

// Descriptions of the reasons why solves end. A reason that is not described here is shown by PETSc's name alone.

namespace tushar::solvers {

namespace {

const char* wordsOf(KSPConvergedReason reason) {
  switch (reason) {
    case KSP_DIVERGED_ITS:
      return "more iterations than allowed";
    case KSP_DIVERGED_DTOL:
      return "the residual grows";
    case KSP_DIVERGED_BREAKDOWN:
    case KSP_DIVERGED_BREAKDOWN_BICG:
      return "the Krylov method broke down, which happens if the matrix is singular";
    case KSP_DIVERGED_NONSYMMETRIC:
      return "the matrix is not symmetric, which the method requires";
    case KSP_DIVERGED_INDEFINITE_PC:
      return "the preconditioner is not positive definite, which the method requires";
    case KSP_DIVERGED_INDEFINITE_MAT:
      return "the matrix is not positive definite, which the method requires";
    case KSP_DIVERGED_NANORINF:
      return "a value became infinite or NaN";
    case KSP_DIVERGED_PC_FAILED:
      return "the preconditioner could not be built, which happens if the matrix is singular";
    default:
      return "";
  }
}

const char* wordsOf(SNESConvergedReason reason) {
  switch (reason) {
    case SNES_DIVERGED_MAX_IT:
      return "more iterations than allowed";
    case SNES_DIVERGED_FNORM_NAN:
      return "the residual became infinite or NaN";
    case SNES_DIVERGED_LINE_SEARCH:
      return "no fraction of the last Newton step reduces the residual";
    case SNES_DIVERGED_FUNCTION_DOMAIN:
      return "the residual is undefined after the last step";
    default:
      return "";
  }
}

std::string withWords(const char* words, const char* word) {
  return *words ? fmt::format("{} ({})", words, word) : std::string(word);
}

}  // namespace

std::string reasonOf(KSPConvergedReason reason) { return withWords(wordsOf(reason), KSPConvergedReasons[reason]); }

std::string reasonOf(SNES snes) {
  SNESConvergedReason reason;
  check(SNESGetConvergedReason(snes, &reason));
  if (reason != SNES_DIVERGED_LINEAR_SOLVE) return withWords(wordsOf(reason), SNESConvergedReasons[reason]);
  KSP krylov = nullptr;
  KSPConvergedReason linear;
  check(SNESGetKSP(snes, &krylov));
  check(KSPGetConvergedReason(krylov, &linear));
  return "a linear solve failed, " + reasonOf(linear);
}

std::vector<double> residualsOf(KSP krylov) {
  PetscInt count = 0;
  const PetscReal* history = nullptr;
  check(KSPGetResidualHistory(krylov, &history, &count));
  return {history, history + count};
}

}  // namespace tushar::solvers
