#pragma once

#include <string>

#include "core/output/run_log.hpp"

namespace tushar {

/// The commit from which the program was configured, as 12 digits; `unknown` if it was not in a clone of the
/// repository.
extern const char* const buildCommit;
/// The compiler flags that apply to the whole program.
extern const char* const buildFlags;

/// The record of version, commit, compiler and libraries. It contains nothing about a run, and not PETSc, which is
/// loaded only for a solve.
output::RunRecord buildRecord();

/// The information of buildRecord and the version of PETSc, with one item per line.
std::string versionText();

}  // namespace tushar
