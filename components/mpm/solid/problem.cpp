#include "components/mpm/solid/problem.hpp"

#include "components/mpm/solid/uintah_words.hpp"

namespace tushar::mpm::solid {

std::vector<std::string> Solids::foreignLabels() const { return uintahsLabels; }

simulation::OtherNames Solids::otherNames() const { return olderLabels; }

}  // namespace tushar::mpm::solid
