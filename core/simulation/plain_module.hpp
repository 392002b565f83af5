#pragma once

#include <string>
#include <string_view>

#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// Describes the analysis module `name`, which has no tags of its own; `manual` is a sentence for its manual. `make`
/// throws std::invalid_argument, with a sentence, where the module cannot measure the run; the run then ends with an
/// InputError that names the module's tag.
AnalysisKind plainModule(std::string name, std::string sentence, std::string_view manual, MakeAnalysis make);

}  // namespace tushar::simulation
