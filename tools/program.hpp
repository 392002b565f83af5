#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar {

/// What sus does with the words of its command line, for the components and modules that it knows. The exit code.
int runProgram(int count, char** words, const simulation::Catalogue& known);

}  // namespace tushar
