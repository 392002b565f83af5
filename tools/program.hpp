#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar {

/// Opens everything that a scene can pick, and the modules in the files that --load names.
using OpenCatalogue = std::function<simulation::Catalogue(const std::vector<std::string>& files)>;

/// What sus does with the words of its command line. The exit code.
int runProgram(int count, char** words, const OpenCatalogue& open);

}  // namespace tushar
