#include "fuzz/mutations.h"

namespace rockyard {
namespace {

TEST(MutationsLongTest, ManyElevationModels) { EXPECT_GT(ReadMutated("elevation", 20000, 2), 500); }

TEST(MutationsLongTest, ManyCatalogues) { EXPECT_GT(ReadMutated("catalogue", 20000, 2), 500); }

}  // namespace
}  // namespace rockyard
