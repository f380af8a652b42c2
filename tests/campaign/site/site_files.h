// Files of places for tests: models of known surfaces, catalogues.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/test_folder.h"
#include "image_files/raster_bytes.h"

namespace rockyard::campaign {

// Files in a folder of the test's own.
class SiteTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(own_.path() / name, std::ios::binary) << bytes;
    return own_.path() / name;
  }

  // A NumPy file of a surface: height(row, column), row 0 in the north.
  template <typename Height>
  std::filesystem::path WriteModel(std::size_t rows, std::size_t columns,
                                   const Height& height) const {
    std::vector<double> values;
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns; ++c) {
        values.push_back(height(static_cast<double>(r), static_cast<double>(c)));
      }
    }
    return Write("model.npy", image_files::NpyBytes("<f8", columns, values));
  }

  core::TestFolder own_;
};

// The problems that `action` throws; none, with a failure of the test, where it does not.
template <typename Action>
std::vector<core::Problem> ProblemsOf(const Action& action) {
  try {
    action();
  } catch (const core::UserError& error) {
    for (const core::Problem& problem : error.problems()) EXPECT_FALSE(problem.suggestion.empty());
    return error.problems();
  }
  ADD_FAILURE() << "is taken";
  return {core::Problem{}};
}

}  // namespace rockyard::campaign
