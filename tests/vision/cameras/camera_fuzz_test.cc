// Damaged files of cameras are read or refused in words, and nothing else. The study of many cases
// is camera_fuzz_study.cc.
#include <gtest/gtest.h>

#include <map>

#include "vision/cameras/mutated_cameras.h"

namespace rockyard::vision {
namespace {

constexpr std::uint64_t kSeed = 2311;

// The seeds themselves are in order, or the mutations would test the first check only.
TEST(CameraFileFuzzTest, TheSeedsAreRead) {
  for (const CameraSeed& file : CameraSeeds()) {
    const CameraVerdict verdict = JudgeCamera(file);
    EXPECT_EQ(verdict.outcome, CameraOutcome::kRead) << file.name << ": " << verdict.what;
  }
}

TEST(CameraFileFuzzTest, DamagedFilesAreReadOrRefusedInWords) {
  const std::vector<CameraSeed> seeds = CameraSeeds();
  std::map<CameraOutcome, int> counts;
  for (std::uint32_t number = 0; number < 3000; ++number) {
    const CameraSeed file = MutatedCamera(seeds, kSeed, number);
    const CameraVerdict verdict = JudgeCamera(file);
    ASSERT_NE(verdict.outcome, CameraOutcome::kFailed)
        << "case " << number << ", " << file.name << ": " << verdict.what;
    ++counts[verdict.outcome];
  }
  // Both answers occur, or the damage would test one side only.
  EXPECT_GT(counts[CameraOutcome::kRead], 150);
  EXPECT_GT(counts[CameraOutcome::kRefused], 1500);
}

}  // namespace
}  // namespace rockyard::vision
