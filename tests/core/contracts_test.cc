// Contracts switched on, whatever the build says.
#ifndef ROCKYARD_CONTRACTS
#define ROCKYARD_CONTRACTS
#endif
#include <gmock/gmock.h>

#include "core/check.h"

namespace rockyard::core {
namespace {

using testing::HasSubstr;

std::string MessageOf(void (*act)()) {
  try {
    act();
  } catch (const ContractViolation& violation) {
    return violation.what();
  }
  return {};
}

TEST(ContractsTest, HoldingContractsDoNothing) {
  EXPECT(1 + 1 == 2);
  ENSURE(true);
}

TEST(ContractsTest, BrokenPreconditionNamesFileKindAndCondition) {
  const std::string message = MessageOf([] { EXPECT(1 + 1 == 3); });
  EXPECT_THAT(message, HasSubstr("contracts_test.cc:"));
  EXPECT_THAT(message, HasSubstr("precondition violated: 1 + 1 == 3"));
}

TEST(ContractsTest, BrokenPostconditionSaysSo) {
  EXPECT_THAT(MessageOf([] { ENSURE(false); }), HasSubstr("postcondition violated: false"));
}

TEST(ContractsTest, ViolationIsNoUserError) { EXPECT_THROW(EXPECT(false), std::logic_error); }

}  // namespace
}  // namespace rockyard::core
