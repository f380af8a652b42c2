// Damaged images of a cylinder are refused or missed in words, or it is found.
#include <gtest/gtest.h>

#include <map>

#include "campaign/cylinder/painted_files.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

TEST(CylinderFuzzTest, DamagedImagesAreRefusedOrMissedInWords) {
  const core::TestFolder own;
  const DamagedPairs pairs(own.path());
  std::map<CylinderOutcome, int> counts;
  for (std::uint32_t number = 0; number < 40; ++number) {
    const CylinderVerdict verdict = pairs.Judge(27, number);
    ASSERT_NE(verdict.outcome, CylinderOutcome::kFailed)
        << "case " << number << ": " << verdict.what;
    ++counts[verdict.outcome];
  }
  EXPECT_GT(counts[CylinderOutcome::kFound], 2);
  EXPECT_GT(counts[CylinderOutcome::kRefused], 10);
}

}  // namespace
}  // namespace rockyard::campaign
