#include "core/machine_error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/json_text.h"
#include "core/json_value.h"

// So many allocations of this thread still succeed; below zero: all.
static thread_local int allocations_left = -1;

void* operator new(std::size_t size) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace rockyard::core {
namespace {

TEST(MachineError, SaysWhichExceptionsAreTheMachines) {
  const auto code = [](std::errc value) { return std::make_error_code(value); };
  EXPECT_TRUE(IsMachineFailure(MachineError("a.png", "cannot be read", "")));
  EXPECT_TRUE(IsMachineFailure(std::bad_alloc()));
  EXPECT_TRUE(IsMachineFailure(std::system_error(code(std::errc::no_space_on_device))));
  EXPECT_TRUE(IsMachineFailure(
      std::filesystem::filesystem_error("rename", code(std::errc::too_many_files_open))));

  EXPECT_FALSE(IsMachineFailure(UserError("a.png", "is no image", "")));
  EXPECT_FALSE(IsMachineFailure(std::bad_array_new_length())) << "a size that is no size";
  EXPECT_FALSE(IsMachineFailure(std::length_error("vector")));
  EXPECT_FALSE(IsMachineFailure(std::runtime_error("the solver blew up")));
  EXPECT_FALSE(IsMachineFailure(std::system_error(code(std::errc::invalid_argument))));
}

TEST(MachineError, AJsonValueIsCopiedOrLeftAsItWas) {
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
