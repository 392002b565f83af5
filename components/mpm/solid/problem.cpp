#include "components/mpm/solid/problem.hpp"

#include "components/mpm/solid/uintah_words.hpp"

namespace tushar::mpm::solid {

std::vector<std::string> Solids::foreignLabels() const {
  std::vector<std::string> labels = uintahsLabels;
  labels.insert(labels.end(), labelsOfSomeScenes.begin(), labelsOfSomeScenes.end());
  return labels;
}

simulation::OtherNames Solids::otherNames() const { return olderLabels; }

}  // namespace tushar::mpm::solid
