#include "core/solvers/input.hpp"

namespace tushar::solvers {

namespace {

/// The schema of the tag; settings that a scene omits are taken from `defaults`.
input::Schema<LinearSettings> schemaOf(const LinearSettings& defaults) {
  return input::Schema<LinearSettings>("Solver", "How linear systems are solved.")
      .choice("solver", &LinearSettings::solver,
              {{"automatic", "automatic"},
               {"cg", "cg"},
               {"gmres", "gmres"},
               {"fgmres", "fgmres"},
               {"bicgstab", "bcgs"},
               {"direct", "preonly"}},
              defaults.solver,
              "Krylov method; direct: the preconditioner, lu or cholesky, solves the system; automatic: direct with lu "
              "for a small system on one rank, and otherwise gmres for Newton's method and cg for others; on several "
              "levels, gmres and lu replace cg and cholesky")
      .ours()
      .choice("preconditioner", &LinearSettings::preconditioner,
              {{"multigrid", "multigrid"},
               {"gamg", "gamg"},
               {"hypre", "hypre"},
               {"jacobi", "jacobi"},
               {"ilu", "ilu"},
               {"lu", "lu"},
               {"cholesky", "cholesky"},
               {"none", "none"}},
              defaults.preconditioner,
              "multigrid: geometric for cells of one level, and otherwise hypre; gamg, hypre: algebraic "
              "multigrid of PETSc or hypre; the others are for small systems")
      .ours()
      .value("tolerance", &LinearSettings::tolerance, defaults.tolerance, "1",
             "largest residual, relative to the right-hand side", input::positive(), input::atMost(0.1))
      .ours()
      .value("maxiterations", &LinearSettings::maxIterations, defaults.maxIterations, "1",
             "largest number of iterations; the solve fails if it needs more", input::atLeast(1))
      .ours()
      .value("petsc", &LinearSettings::petsc, "", "1", "PETSc options; those of sus --petsc take precedence")
      .ours()
      .check([](const LinearSettings& read, const input::Element& element, input::Diagnostics& diagnostics) {
        if (read.solver == "preonly" && read.preconditioner != "lu" && read.preconditioner != "cholesky")
          diagnostics.error(element,
                            "preconditioner: found '" + read.preconditioner +
                                "', but with <solver> direct the preconditioner solves the system: use lu or cholesky");
      });
}

}  // namespace

const input::Schema<LinearSettings>& linearSchema() {
  static const input::Schema<LinearSettings> schema = schemaOf({});
  return schema;
}

const input::Schema<LinearSettings>& tangentSchema() {
  static const input::Schema<LinearSettings> schema = schemaOf(NewtonSettings{}.linear);
  return schema;
}

}  // namespace tushar::solvers
