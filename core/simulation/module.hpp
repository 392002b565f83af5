#pragma once

#include "core/simulation/catalogue.hpp"
#include "core/simulation/module_card.hpp"

namespace tushar::simulation {

/// The reason why this program cannot load a module with this ABI; empty if it can.
std::string misfitOf(const ModuleAbi& module);

/// A catalogue of all modules of this program and of the user, each loaded when it is first needed. The user's modules
/// are the given files, and the files in the folders of TUSHAR_PLUGINS, which are separated by `:`. Throws
/// std::runtime_error with a sentence for each file that cannot be loaded.
Catalogue openModules(const std::vector<std::string>& files);

/// Loads a module of this program, which then registers itself. Does nothing in a program without openModules(),
/// because such a program is linked with all modules. Throws std::runtime_error if the module does not exist.
void loadModule(const std::string& name);

}  // namespace tushar::simulation
