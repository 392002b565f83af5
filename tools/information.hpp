#pragma once

#include "core/base/error.hpp"
#include "core/simulation/catalogue.hpp"
#include "tools/arguments.hpp"

namespace tushar {

/// Prints information about sus itself: version, lists, manuals, schemas, completion. Returns the exit code. Throws
/// InputError for a scene whose paths are asked for and that cannot be read.
ExitCode answer(const Arguments& arguments, const simulation::Catalogue& known);

}  // namespace tushar
