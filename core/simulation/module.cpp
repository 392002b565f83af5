#include "core/simulation/module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "core/base/missing.hpp"
#include "core/simulation/module_interface.hpp"

namespace tushar::simulation {

namespace {

namespace fs = std::filesystem;

/// The modules of this program that were found by openModules().
struct OwnModules {
  fs::path folder;
  std::map<std::string, Catalogue> loaded;  ///< the contents of each loaded module
};
OwnModules& ownModules() {
  static OwnModules modules;
  return modules;
}

/// The reason why a file cannot be a shared library. Empty if it may be one, or if it cannot be read; in this case
/// dlopen reports the error.
std::string whyNoLibrary(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  ElfW(Ehdr) head{};
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!std::equal(head.e_ident, head.e_ident + SELFMAG, ELFMAG)) return "it is not a shared library";
  // The table of sections is at the end of a file. If pages were missing, dlopen would end the program by SIGBUS.
  const std::uintmax_t end = head.e_shoff + std::uintmax_t(head.e_shnum) * head.e_shentsize;
  return !in || fs::file_size(file) < end ? "the file is truncated" : "";
}

/// Opens a shared library and returns its card. Throws std::runtime_error if it is not a module or is incompatible.
const ModuleCard& open(const fs::path& file) {
  if (const std::string why = whyNoLibrary(file); !why.empty())
    throw std::runtime_error(fmt::format("{} is not a module of Tushar: {}", file.string(), why));
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const std::string problem = handle ? "" : dlerror();
  // A module for another version may call functions that do not exist here; lazy binding lets its card be read
  // nevertheless.
  if (!handle) handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const auto* card = handle ? static_cast<const ModuleCard*>(dlsym(handle, "tusharModule")) : nullptr;
  if (handle && !card)
    throw std::runtime_error(fmt::format("{} is not a module of Tushar: it has no symbol tusharModule", file.string()));
  if (const std::string misfit = card ? misfitOf(card->abi) : ""; !misfit.empty())
    throw std::runtime_error(
        fmt::format("the module {} does not match this program: {}; rebuild it", file.string(), misfit));
  if (!problem.empty())
    throw std::runtime_error(fmt::format("the module {} cannot be loaded: {}", file.string(), problem));
  return *card;
}

/// The contents of one of this program's modules, which is loaded if necessary.
const Catalogue& loadOwn(const std::string& name) {
  std::map<std::string, Catalogue>& loaded = ownModules().loaded;
  if (const auto found = loaded.find(name); found != loaded.end()) return found->second;
  const fs::path file = ownModules().folder / fmt::format("tushar_{}.so", name);
  if (!fs::exists(file)) buildMissing(name);
  if (!fs::exists(file))
    throw std::runtime_error(
        fmt::format("the module {} is missing: there is no {}; install Tushar again", name, file.string()));
  return loaded.emplace(name, open(file).kinds()).first->second;
}

/// Reads lines such as `heat component heat`: name of a module, kind of entry, name of the entry.
void addOwnModules(Catalogue& catalogue) {
  std::ifstream index(ownModules().folder / "index.txt");
  if (!index) throw std::runtime_error(fmt::format("{}: cannot be read", (ownModules().folder / "index.txt").string()));
  std::map<std::string, Module> modules;
  for (std::string line; std::getline(index, line);) {
    std::istringstream words(line);
    std::string module, kind, name;
    words >> module >> kind >> name;
    modules[module].name = module;
    if (kind == "component") modules[module].components.push_back(name);
    if (kind == "analysis") modules[module].analyses.push_back(name);
  }
  for (const auto& [name, module] : modules) catalogue.addModule(module, [name = name] { return loadOwn(name); });
}

/// The shared libraries in the folders of TUSHAR_PLUGINS, sorted by name.
std::vector<std::string> filesOfUser() {
  std::vector<std::string> files;
  const char* const folders = std::getenv("TUSHAR_PLUGINS");
  std::istringstream all(folders ? folders : "");
  for (std::string folder; std::getline(all, folder, ':');) {
    if (folder.empty()) continue;
    if (!fs::is_directory(folder))
      throw std::runtime_error(fmt::format("TUSHAR_PLUGINS: there is no folder {}", folder));
    const std::size_t before = files.size();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".so") files.push_back(entry.path().string());
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  }
  return files;
}

void addFile(Catalogue& catalogue, const std::string& file) {
  if (!fs::exists(file)) throw std::runtime_error(fmt::format("there is no module {}", file));
  const Catalogue kinds = open(fs::absolute(file)).kinds();
  try {
    catalogue.add(kinds);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("the module {} cannot be added: {}", file, error.what()));
  }
}

}  // namespace

std::string misfitOf(const ModuleAbi& module) {
  constexpr ModuleAbi own = abiWith(TUSHAR_INTERFACE);
  using Text = std::string_view;
  if (Text(module.version) != own.version)
    return fmt::format("it was built for Tushar {}, but this is {}", module.version, own.version);
  if (Text(module.compiler) != own.compiler)
    return fmt::format("it was compiled by {}, but this program was compiled by {}", module.compiler, own.compiler);
  if (module.checks != own.checks)
    return fmt::format("it was compiled with{} TUSHAR_CHECKS, but this program was compiled with{} it",
                       module.checks ? "" : "out", own.checks ? "" : "out");
  if (module.alignment != own.alignment)
    return fmt::format("it was compiled for vectors of {} bytes, but this program for {} bytes: use the same -march",
                       module.alignment, own.alignment);
  if (Text(module.interface) != own.interface) return "it was built with different headers of the same version";
  return "";
}

Catalogue openModules(const std::vector<std::string>& files) {
  ownModules().folder = libraryFolder() / "modules";
  Catalogue catalogue;
  addOwnModules(catalogue);
  for (const std::string& file : filesOfUser()) addFile(catalogue, file);
  for (const std::string& file : files) addFile(catalogue, file);
  return catalogue;
}

void loadModule(const std::string& name) {
  if (!ownModules().folder.empty()) loadOwn(name);
}

}  // namespace tushar::simulation
