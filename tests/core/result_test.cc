#include "core/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/refusals.h"

namespace rockyard::core {
namespace {

Result<int> Parse(const std::string& text) {
  return Attempt([&] {
    if (text.empty()) throw UserError({{"a", "is empty", "say 1"}, {"b", "is empty", ""}});
    return std::stoi(text);
  });
}

TEST(Result, HoldsAValue) {
  const Result<int> result = Parse("7");
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(*result, 7);
  EXPECT_TRUE(result.problems().empty());
}

TEST(Result, HoldsEveryProblem) {
  const Result<int> result = Parse("");
  EXPECT_FALSE(result.ok());
  ASSERT_EQ(result.problems().size(), 2U);
  EXPECT_EQ(result.problems().front().suggestion, "say 1");
}

TEST(Result, ThrowsWhereTheValueIsAskedFor) {
  EXPECT_EQ(Parse("7").OrThrow(), 7);
  EXPECT_EQ(ProblemsIn([] { Parse("").OrThrow(); }).size(), 2U);
}

TEST(Result, MovesWhatCannotBeCopied) {
  auto result = Attempt([] { return std::make_unique<int>(3); });
  EXPECT_EQ(*std::move(result).OrThrow(), 3);
}

// What is no user's error is nobody's value.
TEST(Result, LetsOtherExceptionsPass) { EXPECT_THROW(Parse("seven"), std::invalid_argument); }

}  // namespace
}  // namespace rockyard::core
