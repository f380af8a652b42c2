// What a reader says of a file that it refuses.
#pragma once

#include <gtest/gtest.h>

#include "core/error.h"

namespace rockyard::image_files {

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
