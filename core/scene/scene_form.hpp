#pragma once

#include "core/input/tag_form.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::scene {

/// The allowed content of a scene, for the schemas that editors use: the forms of the outermost tag, one for each
/// component and method.
input::TagForm sceneForm(const simulation::Catalogue& catalogue);

}  // namespace tushar::scene
