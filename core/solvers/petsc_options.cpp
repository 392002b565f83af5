#include <cstdlib>
#include <map>
#include <sstream>

#include "core/solvers/petsc_objects.hpp"

namespace tushar::solvers {

namespace {

/// Every option given to a solve, and whether any solve has used it.
std::map<std::string, bool>& useOfOptions() {
  static std::map<std::string, bool> use;
  return use;
}

/// Whether a word is an option: `-snes_rtol` is an option, `-1e-3` a value.
bool isOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
}

}  // namespace

PetscOptionsOfSolve::PetscOptionsOfSolve(const std::string& options) : given_(options) {
  startPetsc();
  if (const char* given = std::getenv("PETSC_OPTIONS")) given_ += std::string(" ") + given;
  check(PetscOptionsCreate(options_.address()));
  check(PetscOptionsInsertString(options_, given_.c_str()));
  check(PetscOptionsPush(options_));
}

PetscOptionsOfSolve::~PetscOptionsOfSolve() {
  PetscOptionsPop();
  std::istringstream words(given_);
  for (std::string word; words >> word;)
    if (isOption(word)) noteUse(word);
}

void PetscOptionsOfSolve::noteUse(const std::string& option) {
  PetscBool here = PETSC_FALSE, atStart = PETSC_FALSE;
  const char* name = option.c_str() + 1;  // PETSc leaves out the dash
  PetscOptionsUsed(options_, name, &here);
  PetscOptionsUsed(nullptr, name, &atStart);
  useOfOptions()[option] |= here || atStart;
}

std::vector<std::string> PetscOptionsOfSolve::unused() {
  std::vector<std::string> names;
  for (const auto& [name, isUsed] : useOfOptions())
    if (!isUsed) names.push_back(name);
  return names;
}

}  // namespace tushar::solvers
