#include "core/solvers/input.hpp"

namespace tushar::solvers {

const input::Schema<LinearSettings>& linearSchema() {
  static const input::Schema<LinearSettings> schema =
      input::Schema<LinearSettings>("Solver", "How linear systems are solved.")
          .choice("solver", &LinearSettings::solver,
                  {{"cg", "cg"}, {"gmres", "gmres"}, {"fgmres", "fgmres"}, {"bicgstab", "bcgs"}, {"direct", "preonly"}},
                  "cg", "Krylov method; direct: none, the preconditioner lu or cholesky solves")
          .ours()
          .choice("preconditioner", &LinearSettings::preconditioner,
                  {{"gamg", "gamg"}, {"hypre", "hypre"}, {"jacobi", "jacobi"}, {"ilu", "ilu"}, {"lu", "lu"},
                   {"cholesky", "cholesky"}, {"none", "none"}},
                  "gamg", "algebraic multigrid of PETSc or of hypre, or one for small systems")
          .ours()
          .value("tolerance", &LinearSettings::tolerance, 1e-10, "1", "residual over right-hand side",
                 input::positive(), input::atMost(0.1))
          .ours()
          .value("maxiterations", &LinearSettings::maxIterations, 1000, "1", "more of them are a failure",
                 input::atLeast(1))
          .ours()
          .value("petsc", &LinearSettings::petsc, "", "1", "options in PETSc's language; sus -petsc wins")
          .ours()
          .check([](const LinearSettings& read, const input::Element& element, input::Diagnostics& diagnostics) {
            if (read.solver == "preonly" && read.preconditioner != "lu" && read.preconditioner != "cholesky")
              diagnostics.error(element, "preconditioner: found '" + read.preconditioner +
                                             "', but with <solver> direct it solves the system: take lu or cholesky");
          });
  return schema;
}

}  // namespace tushar::solvers
