#pragma once

#include <string>

namespace tushar {

/// The commit that was configured, in 12 digits; `unknown` outside a clone.
extern const char* const buildCommit;

/// Version, buildCommit, compiler and libraries, a line each.
std::string versionText();

}  // namespace tushar
