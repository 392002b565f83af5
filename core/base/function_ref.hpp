#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace tushar {

/// A reference to a function object that can be called while it is const, and must outlive it: a parameter for
/// functions that are compiled once, not again for each object that they call. Copies refer to the same object.
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
