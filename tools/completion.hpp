#pragma once

#include <string>
#include <vector>

namespace tushar {

/// A script with which bash completes the arguments of sus: `options`, scenes, folders of runs, `manuals` after
/// --describe, and the paths of the scene's tags after --set.
std::string bashCompletion(const std::vector<std::string>& options, const std::vector<std::string>& manuals);

}  // namespace tushar
