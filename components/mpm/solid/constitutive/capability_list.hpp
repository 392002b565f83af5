#pragma once

#include <concepts>

namespace tushar::mpm::solid {

/// A list of optional capabilities, which are types of namespace capability. A type T lists its own as
/// `T::Capabilities`.
///
/// A capability has a member template `check<T>()`, whose assertions compare the capabilities that T lists with the
/// members that it has.
template <class... Names>
struct CapabilityList {
  template <class Capability>
  static constexpr bool contains = (std::same_as<Capability, Names> || ...);

  /// Always true; otherwise compilation stops with a message about a member of T that contradicts its capabilities. The
  /// list itself contains all capabilities that a type of this kind may name.
  template <class T>
  static consteval bool check() {
    static_assert(T::Capabilities::areAmong(CapabilityList()),
                  "Capabilities must list only capabilities of this kind of model, from namespace capability");
    return (Names::template check<T>() && ...);
  }
  template <class... Others>
  static consteval bool areAmong(CapabilityList<Others...>) {
    return (CapabilityList<Others...>::template contains<Names> && ...);
  }
};

/// Whether T lists a capability.
template <class T, class Capability>
inline constexpr bool providesCapability = T::Capabilities::template contains<Capability>;

/// A name that T and `Name` both have is ambiguous here: `requires { &Both<T, Name>::x; }` is true if and only if T has
/// no member x, of any type and access.
template <class T, class Name>
struct Both : T, Name {};

/// Pointer to a const member function of T. Member<T, ...>{&T::f} compiles only if f has exactly this signature.
template <class T, class Result, class... Arguments>
using Member = Result (T::*)(Arguments...) const;

}  // namespace tushar::mpm::solid
