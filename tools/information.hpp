#pragma once

#include "core/base/error.hpp"
#include "core/simulation/catalogue.hpp"
#include "tools/arguments.hpp"

namespace tushar {

/// Prints information about sus itself: version, lists, manuals, schemas, completion. Returns the exit code. Throws
/// InputError if paths of a scene are requested and the scene cannot be read.
ExitCode answer(const Arguments& arguments, const simulation::Catalogue& known);

}  // namespace tushar
