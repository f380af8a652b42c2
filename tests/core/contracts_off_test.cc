// Contracts switched off, whatever the build says: conditions are compiled, so that nothing that
// only they use is called unused, and never evaluated.
#undef ROCKYARD_CONTRACTS
#include <gtest/gtest.h>

#include "core/check.h"

namespace {

bool Count(int& evaluations) {
  ++evaluations;
  return false;
}

TEST(ContractsOffTest, ConditionsAreNotEvaluated) {
  int evaluations = 0;
  EXPECT(Count(evaluations));
  ENSURE(Count(evaluations));
  EXPECT_EQ(evaluations, 0);
}

}  // namespace
