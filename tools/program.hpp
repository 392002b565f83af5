#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar {

/// A function that loads all components and analyses that a scene can select, including the modules in `files`, which
/// are given by --load.
using OpenCatalogue = std::function<simulation::Catalogue(const std::vector<std::string>& files)>;

/// Runs sus with its command line. Returns the exit code.
int runProgram(int count, char** words, const OpenCatalogue& open);

}  // namespace tushar
