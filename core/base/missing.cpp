#include "core/base/missing.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace tushar {

namespace {

double secondsSpent = 0;

}  // namespace

std::filesystem::path libraryFolder() {
  Dl_info found;
  if (!dladdr(reinterpret_cast<const void*>(&libraryFolder), &found))
    throw std::runtime_error("the folder that contains the modules is unknown");
  return std::filesystem::canonical(found.dli_fname).parent_path();
}

void buildMissing(const std::string& name) {
  const std::filesystem::path script = libraryFolder() / "build_missing";
  if (!std::filesystem::exists(script)) return;
  const auto started = std::chrono::steady_clock::now();
  const int status = std::system(fmt::format("'{}' tushar_{} 1>&2", script.string(), name).c_str());
  secondsSpent += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (status != 0) throw std::runtime_error(fmt::format("tushar_{} was not built", name));
}

double secondsOfBuilds() { return secondsSpent; }

}  // namespace tushar
