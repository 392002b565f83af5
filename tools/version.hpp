#pragma once

#include <string>

#include "core/output/run_log.hpp"

namespace tushar {

/// The commit from which the program was configured, in 12 digits; `unknown` outside a clone.
extern const char* const buildCommit;
/// The compiler flags of the whole program.
extern const char* const buildFlags;

/// Version, commit, compiler and libraries; without PETSc, which is loaded only for a solve, and without facts about a
/// run.
output::RunRecord buildRecord();

/// The same information including PETSc, one item per line.
std::string versionText();

}  // namespace tushar
