#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace tushar {

/// A reference to a function object, which must be callable as const and outlive the reference. A function with such a
/// parameter is compiled only once, not again for each type of object passed to it. Copies refer to the same object.
template <class Signature>
class FunctionRef;

template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Function>
  requires(std::is_object_v<Function> && !std::is_same_v<Function, FunctionRef> &&
           std::is_invocable_r_v<Result, const Function&, Arguments...>) FunctionRef(const Function& function)
      : object_(std::addressof(function)), call_([](const void* object, Arguments... arguments) -> Result {
          return (*static_cast<const Function*>(object))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

 private:
  const void* object_;
  Result (*call_)(const void*, Arguments...);
};

}  // namespace tushar
