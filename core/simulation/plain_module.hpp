#pragma once

#include <string>
#include <string_view>

#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// Describes the analysis module `name`, which has no tags of its own; `sentence` describes it in lists, and `manual`
/// in its manual. `make` throws std::invalid_argument, with a message, if the module cannot measure the run; the run
/// then ends with an InputError that names the module's tag.
AnalysisKind plainModule(std::string name, std::string sentence, std::string_view manual, MakeAnalysis make);

}  // namespace tushar::simulation
