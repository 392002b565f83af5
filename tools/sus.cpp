#include "core/simulation/module.hpp"
#include "tools/program.hpp"

int main(int count, char** words) { return tushar::runProgram(count, words, tushar::simulation::openModules); }
