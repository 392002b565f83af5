#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace tushar {

/// An object of any type on the heap, shared by all copies of this handle. With std::shared_ptr or std::unique_ptr, the
/// compiler would generate several classes for each type of object.
class SharedObject {
 public:
  static constexpr std::size_t alignment = 64;

  SharedObject() = default;
  template <class Object>
  static SharedObject of(Object object) {
    static_assert(alignof(Object) <= alignment);
    return {::new (room(sizeof(Object))) Object(std::move(object)), destroyerOf<Object>()};
  }
  const void* get() const { return object_.get(); }

 private:
  using Destroy = void (*)(void*);

  SharedObject(void* object, Destroy destroy);
  static void* room(std::size_t size);
  static void release(void* object);
  template <class Object>
  static constexpr Destroy destroyerOf() {
    if constexpr (std::is_trivially_destructible_v<Object>)
      return release;
    else
      return [](void* object) {
        std::destroy_at(static_cast<Object*>(object));
        release(object);
      };
  }

  std::shared_ptr<const void> object_;
};

/// Any function object that can be called as const with these arguments. Works like std::function, but for each type of
/// object the compiler generates one function instead of five, which matters because there are thousands of tasks and
/// tags.
template <class Signature>
class SharedFunction;

template <class Result, class... Arguments>
class SharedFunction<Result(Arguments...)> {
 public:
  SharedFunction() = default;
  template <class Function>
  requires(!std::is_same_v<Function, SharedFunction>) SharedFunction(Function function)
      : object_(SharedObject::of(std::move(function))), call_(call<Function>) {}

  Result operator()(Arguments... arguments) const {
    return call_(object_.get(), std::forward<Arguments>(arguments)...);
  }
  explicit operator bool() const { return call_ != nullptr; }

 private:
  template <class Function>
  static Result call(const void* object, Arguments... arguments) {
    return (*static_cast<const Function*>(object))(std::forward<Arguments>(arguments)...);
  }

  SharedObject object_;
  Result (*call_)(const void*, Arguments...) = nullptr;
};

}  // namespace tushar
