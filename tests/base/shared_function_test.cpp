#include "core/base/shared_function.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/base/function_ref.hpp"

namespace tushar {
namespace {

/// Counts how many of its objects exist.
struct Counted {
  static inline int count = 0;
  Counted() { ++count; }
  Counted(const Counted&) { ++count; }
  ~Counted() { --count; }
};

TEST(SharedFunction, KeepsItsObjectUntilTheLastCopyGoes) {
  SharedFunction<int(int)> add = [held = Counted(), text = std::string(100, 'a')](int x) {
    return static_cast<int>(text.size()) + x;
  };
  SharedFunction<int(int)> copy = add;
  EXPECT_EQ(Counted::count, 1);

  add = {};

  EXPECT_FALSE(add);
  EXPECT_EQ(copy(1), 101);
  copy = {};
  EXPECT_EQ(Counted::count, 0);
}

TEST(SharedFunction, KeepsWideVectorsWhereProcessorsReadThem) {
  struct alignas(64) Wide {
    double number = 7;
    bool operator()() const { return reinterpret_cast<std::uintptr_t>(this) % 64 == 0 && number == 7; }
  };
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(SharedFunction<bool()>(Wide())());
}

int twice(FunctionRef<int(const int&)> function) { return 2 * function(3); }

TEST(FunctionRef, CallsTheObjectItselfNotACopy) {
  int calls = 0;
  const auto count = [&, held = Counted()](auto x) { return ++calls, x; };

  EXPECT_EQ(twice(count), 6);
  EXPECT_EQ(twice([&](int x) { return x + calls; }), 8);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(Counted::count, 1);
}

}  // namespace
}  // namespace tushar
