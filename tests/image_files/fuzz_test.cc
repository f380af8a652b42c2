// Damaged image files are read or refused in words, and nothing else. tests/fuzz has a million, but
// no planetary ones.
#include <gtest/gtest.h>

#include <map>

#include "core/test_folder.h"
#include "image_files/mutated_files.h"
#include "image_files/planetary.h"

namespace rockyard::image_files {
namespace {

constexpr std::uint64_t kSeed = 2310;

class ImageFuzzTest : public testing::Test {
 protected:
  core::TestFolder own_;
  const std::vector<SeedFile> files_ = SeedFiles(own_.path());
};

// The seeds themselves are in order, or the mutations would test the first check only.
TEST_F(ImageFuzzTest, TheSeedsAreRead) {
  for (const SeedFile& file : files_) {
    const bool missing = PlanetaryKindOf(file.bytes) && FindGdal().reader == nullptr;
    const bool refused = missing || file.name == "inks.jpg";
    const Verdict verdict = JudgeFile(file, own_.path());
    EXPECT_EQ(verdict.outcome, refused ? Outcome::kRefused : Outcome::kRead)
        << file.name << ": " << verdict.what;
  }
}

TEST_F(ImageFuzzTest, DamagedFilesAreReadOrRefusedInWords) {
  std::map<Outcome, int> counts;
  constexpr std::uint32_t kCases = 800;
  for (std::uint32_t number = 0; number < kCases; ++number) {
    const SeedFile file = MutatedFile(files_, kSeed, number);
    const Verdict verdict = JudgeFile(file, own_.path());
    ASSERT_NE(verdict.outcome, Outcome::kFailed)
        << "case " << number << ", " << file.name << ": " << verdict.what;
    ++counts[verdict.outcome];
  }
  // Both answers occur, or the damage would test one side only.
  EXPECT_GT(counts[Outcome::kRead], 20);
  EXPECT_GT(counts[Outcome::kRefused], 400);
}

}  // namespace
}  // namespace rockyard::image_files
