// The corpus of each reader (tests/fuzz/README.md): read or refused, no more.
#include "fuzz/readers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/files.h"

namespace rockyard {
namespace {

namespace fs = std::filesystem;

class ReaderTest : public testing::TestWithParam<Reader> {};

TEST_P(ReaderTest, CorpusIsReadOrRefused) {
  int accepted = 0;
  int refused = 0;
  const fs::path folder =
      fs::path(ROCKYARD_SOURCE_DIR) / "tests/data/readers" / std::string(GetParam().name);
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string bytes = core::ReadWholeFile(file.path(), 1 << 20, "a file of the corpus");
    try {
      ++(Accepts(GetParam(), bytes) ? accepted : refused);
    } catch (const std::exception& error) {
      ADD_FAILURE() << file.path() << ": " << error.what();
    }
  }
  EXPECT_GE(accepted, 1);
  EXPECT_GE(refused, 5);
}

INSTANTIATE_TEST_SUITE_P(All, ReaderTest, testing::ValuesIn(Readers().begin(), Readers().end()),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace rockyard
