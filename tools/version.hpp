#pragma once

#include <string>

#include "core/output/run_log.hpp"

namespace tushar {

/// The commit that was configured, in 12 digits; `unknown` outside a clone.
extern const char* const buildCommit;
/// The compiler flags of the whole program.
extern const char* const buildFlags;

/// Version, commit, compiler and libraries except PETSc, which is loaded only for a solve; nothing about a run.
output::RunRecord buildRecord();

/// The same and PETSc, a line each.
std::string versionText();

}  // namespace tushar
