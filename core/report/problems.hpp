#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace tushar::report {

/// The problems of a scene as JSON, for programs: a list of objects with `file`, `line` and `column` (from 1; 0 if
/// there is no line), `path` of the tag, `message` and, if there is a nearest word, `suggestion`; and `number`, if
/// `numberOf` returns one.
std::string toJson(const std::vector<InputProblem>& problems,
                   const std::function<std::string(const InputProblem&)>& numberOf = {});

}  // namespace tushar::report
