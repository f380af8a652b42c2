#include "report/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/error.h"

namespace rockyard::report {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
 protected:
  AtomicFile()
      : folder_(fs::temp_directory_path() / ("rockyard-atomic-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~AtomicFile() override { fs::remove_all(folder_); }

  static std::string Read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(AtomicFile, WritesAndReplaces) {
  const std::string large(3'000'000, 'x');
  WriteFileAtomically(folder_ / "a", large);
  EXPECT_EQ(Read(folder_ / "a"), large);
  WriteFileAtomically(folder_ / "a", "short\n");
  EXPECT_EQ(Read(folder_ / "a"), "short\n");
  EXPECT_EQ(Files(), 1) << "no temporary file stays";
}

TEST_F(AtomicFile, FailsWithTheNameAndLeavesNothing) {
  fs::create_directories(folder_ / "taken" / "inside");
  try {
    WriteFileAtomically(folder_ / "taken", "text");
    FAIL();
  } catch (const core::UserError& error) {
    EXPECT_EQ(error.problems().front().path, (folder_ / "taken").string());
  }
  EXPECT_EQ(Files(), 1);
  EXPECT_THROW(WriteFileAtomically(folder_ / "no" / "such", "text"), core::UserError);
  EXPECT_THROW(WriteFileAtomically("/proc/rockyard", "text"), core::UserError);
}

}  // namespace
}  // namespace rockyard::report
