#pragma once

#include "core/input/tag_form.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::scene {

/// The allowed content of a scene, for the schemas of editors: the outermost tag in each of its forms, which depend on
/// the component and its method.
input::TagForm sceneForm(const simulation::Catalogue& catalogue);

}  // namespace tushar::scene
