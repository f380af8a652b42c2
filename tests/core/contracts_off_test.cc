// Contracts switched off, whatever the build says: conditions are not even evaluated.
#undef ROCKYARD_CONTRACTS
#include <gtest/gtest.h>

#include "core/check.h"

namespace {

[[maybe_unused]] bool Count(int& evaluations) {
  ++evaluations;
  return false;
}

TEST(ContractsOffTest, ConditionsAreNotEvaluated) {
  [[maybe_unused]] int evaluations = 0;
  EXPECT(Count(evaluations));
  ENSURE(Count(evaluations));
  EXPECT_EQ(evaluations, 0);
}

}  // namespace
