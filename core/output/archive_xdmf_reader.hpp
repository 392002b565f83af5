#pragma once

#include <filesystem>
#include <functional>
#include <pugixml.hpp>
#include <string>

namespace tushar::output {

/// The number of elements that enclose an output: Xdmf, Domain, and the Grid of its block.
constexpr unsigned depthOfOutputs = 3;

/// The name of a block's grid at a step in an XDMF file.
std::string nameAtStep(const std::string& block, int step);

/// The tag that begins the temporal collection of a block in the file.
std::string headOfBlock(const std::string& name);

/// A function that is called for each output of a block in an XDMF file: the name of the block, the step, and the grid.
using TakeOutput = std::function<void(const std::string& block, int step, const pugi::xml_node& grid)>;

/// Reads an XDMF file of an archive, with only one output in memory at a time. Returns false if the file is missing or
/// torn; some outputs may have been taken then.
bool readXdmf(const std::filesystem::path& file, const TakeOutput& take);

}  // namespace tushar::output
