#include "fuzz/mutations.h"

namespace rockyard {
namespace {

TEST(MutationsTest, SomeElevationModels) {
  testing::internal::CaptureStderr();
  const int accepted = ReadMutated("elevation", 400, 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "GDAL prints nothing";
  EXPECT_GT(accepted, 10);
  EXPECT_LT(accepted, 390);
}

TEST(MutationsTest, SomeCatalogues) {
  const int accepted = ReadMutated("catalogue", 600, 1);
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 580);
}

}  // namespace
}  // namespace rockyard
