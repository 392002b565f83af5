#pragma once

namespace tushar::simulation {

class Catalogue;

/// Properties that must be equal in a module and in the program that loads it.
struct ModuleAbi {
  const char* version;    ///< version of Tushar
  const char* compiler;   ///< name and version of the compiler
  const char* interface;  ///< a hash of the headers of core
  int checks;             ///< 1 if every index into a view is checked
  int alignment;          ///< alignment of vectors [bytes]
};

/// The card that a shared library exports as `extern "C" const ModuleCard tusharModule`; tushar_module() of CMake
/// writes it.
struct ModuleCard {
  ModuleAbi abi;
  const char* name;
  Catalogue (*kinds)();  ///< function that returns the contents of the module; called once
};

#ifdef TUSHAR_CHECKS
inline constexpr int checksEveryIndex = 1;
#else
inline constexpr int checksEveryIndex = 0;
#endif
#ifdef __clang__
inline constexpr const char* compilerName = __VERSION__;
#else
inline constexpr const char* compilerName = "GCC " __VERSION__;
#endif

/// The ABI with which the calling source file is compiled.
constexpr ModuleAbi abiWith(const char* interface) {
  return {TUSHAR_VERSION, compilerName, interface, checksEveryIndex, __BIGGEST_ALIGNMENT__};
}

}  // namespace tushar::simulation
