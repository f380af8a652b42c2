#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/error.h"

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

}  // namespace
}  // namespace rockyard::core
