// Files of a test, and what a reader says of one that it refuses.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/test_folder.h"

namespace rockyard::image_files {

// Files in a folder of the test's own.
class ImageFilesTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  core::TestFolder own_;
  const std::filesystem::path& folder_ = own_.path();
};

// The one problem that `read` throws; empty, with a failure of the test, where it does not.
template <typename Read>
core::Problem RefusalOf(const Read& read) {
  try {
    read();
  } catch (const core::UserError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    EXPECT_FALSE(error.problems().front().suggestion.empty());
    return error.problems().front();
  }
  ADD_FAILURE() << "is read";
  return {};
}

}  // namespace rockyard::image_files
