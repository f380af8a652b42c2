// JSON values where memory runs out. A program of its own, as it replaces operator new for all of
// it. Only a library with the fault that the copy of a JSON value goes around fails without that.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "core/json_text.h"
#include "core/json_value.h"

// So many allocations of this thread still succeed; below zero: all.
static thread_local int allocations_left = -1;

// Not inlined: the compiler would see new meet free, and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace rockyard::core {
namespace {

TEST(JsonMemory, AValueIsCopiedOrLeftAsItWas) {
  const std::string text(40, 'x');
  const JsonValue value = ParseJson(
      "{\"list\": [1, \"" + text + "\", {\"key\": [true]}], \"" + text + "\": null}", "value");
  int failed = 0;
  for (bool copied = false; !copied; failed += copied ? 0 : 1) {
    ASSERT_LT(failed, 100);
    JsonValue target(text);
    try {
      allocations_left = failed;
      target = value;
      copied = true;
    } catch (const std::bad_alloc&) {
      allocations_left = -1;
      EXPECT_EQ(target.text(), text) << failed;
    }
    allocations_left = -1;
    if (copied) {
      EXPECT_EQ(DumpJson(target), DumpJson(value));
    }
  }
  EXPECT_GT(failed, 5);
}

}  // namespace
}  // namespace rockyard::core
