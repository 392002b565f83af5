#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace tushar::tasks {

class TaskContext;

/// The body of a task: any function object that accepts a TaskContext, stored on the heap; copies share it. It works
/// like std::function, but the compiler generates one function per kind of object instead of five, which matters
/// because the components have thousands.
class TaskBody {
 public:
  TaskBody() = default;
  template <class Function>
  requires(!std::is_same_v<Function, TaskBody>) TaskBody(Function function)
      : function_(keep(std::make_unique<Function>(std::move(function)).release(), destroyerOf<Function>())),
        call_(call<Function>) {}

  void operator()(const TaskContext& context) const { call_(function_.get(), context); }
  explicit operator bool() const { return call_ != nullptr; }

 private:
  using Destroy = void (*)(void*);

  template <class Function>
  static void call(const void* function, const TaskContext& context) {
    (*static_cast<const Function*>(function))(context);
  }
  template <class Function>
  static constexpr Destroy destroyerOf() {
    if constexpr (std::is_trivially_destructible_v<Function> && alignof(Function) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__)
      return release;
    else
      return [](void* function) { delete static_cast<Function*>(function); };
  }
  static std::shared_ptr<const void> keep(void* function, Destroy destroy);
  static void release(void* function);

  std::shared_ptr<const void> function_;
  void (*call_)(const void*, const TaskContext&) = nullptr;
};

}  // namespace tushar::tasks
