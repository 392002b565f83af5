#pragma once

#include <string>
#include <vector>

namespace tushar {

/// A script with which bash completes the arguments of sus: options, scenes, folders of runs, the `manuals` for
/// --describe and, after --set, the paths of tags in the scene.
std::string bashCompletion(const std::vector<std::string>& options, const std::vector<std::string>& manuals);

}  // namespace tushar
