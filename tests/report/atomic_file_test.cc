#include "report/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::report {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  static std::string Read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(AtomicFileTest, WritesAndReplaces) {
  const std::string large(3'000'000, 'x');
  WriteFileAtomically(folder_ / "a", large);
  EXPECT_EQ(Read(folder_ / "a"), large);
  WriteFileAtomically(folder_ / "a", "short\n");
  EXPECT_EQ(Read(folder_ / "a"), "short\n");
  EXPECT_EQ(Files(), 1) << "no temporary file stays";
}

// Pieces of a line each, more than are held at once; without Commit, as after an exception, the old
// file stays.
TEST_F(AtomicFileTest, WritesPieceByPiece) {
  const std::string line(999, 'x');
  std::string all;
  WriteFileAtomically(folder_ / "a", [&](const TextSink& out) {
    for (int i = 0; i < 3000; ++i) {
      out(line + "\n");
      all += line + "\n";
    }
    EXPECT_FALSE(fs::exists(folder_ / "a"));
  });
  EXPECT_EQ(Read(folder_ / "a"), all);
  const auto fails = [&](const TextSink& out) {
    out(all);
    throw std::runtime_error("half way");
  };
  EXPECT_THROW(WriteFileAtomically(folder_ / "a", fails), std::runtime_error);
  EXPECT_EQ(Read(folder_ / "a"), all);
  EXPECT_EQ(Files(), 1) << "no temporary file stays";
}

// Whoever may write in the folder could foresee the name that the temporary file had before.
TEST_F(AtomicFileTest, FollowsNoPlantedLink) {
  std::ofstream(folder_ / "victim") << "mine";
  fs::create_symlink(folder_ / "victim", folder_ / ("a.tmp-" + std::to_string(getpid())));
  WriteFileAtomically(folder_ / "a", "text");
  EXPECT_EQ(Read(folder_ / "a"), "text");
  EXPECT_EQ(Read(folder_ / "victim"), "mine");
}

TEST_F(AtomicFileTest, RemovesWhatAKilledOneLeft) {
  std::ofstream(folder_ / "a.tmp-0123456789abcdef") << "half";
  WriteFileAtomically(folder_ / "a", "text");
  EXPECT_EQ(Files(), 1);
}

TEST_F(AtomicFileTest, FailsWithTheNameAndLeavesNothing) {
  fs::create_directories(folder_ / "taken" / "inside");
  EXPECT_THAT(core::ProblemsIn([&] { WriteFileAtomically(folder_ / "taken", "text"); }),
              core::OneProblem((folder_ / "taken").string()));
  EXPECT_EQ(Files(), 1);
  EXPECT_THROW(WriteFileAtomically(folder_ / "no" / "such", "text"), core::UserError);
  EXPECT_THROW(WriteFileAtomically("/proc/rockyard", "text"), core::UserError);
}

}  // namespace
}  // namespace rockyard::report
