#include <gtest/gtest.h>

#include <array>

#include "core/text.h"

namespace rockyard::core {
namespace {

TEST(SpellingTest, EditDistanceOfKnownPairs) {
  EXPECT_EQ(EditDistance("", ""), 0u);
  EXPECT_EQ(EditDistance("", "abc"), 3u);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(EditDistance("trials", "trails"), 1u);  // neighbours swapped
  EXPECT_EQ(EditDistance("saturday", "sunday"), 3u);
}

TEST(SpellingTest, NearestFindsTheClosestCandidateOnly) {
  constexpr std::array<std::string_view, 3> kNames = {"seed", "trials", "terrain"};
  EXPECT_EQ(Nearest("trails", kNames), "trials");
  EXPECT_EQ(Nearest("sed", kNames), "seed");
  EXPECT_EQ(Nearest("completely_else", kNames), "");
  EXPECT_EQ(Nearest(std::string(100000, 'x'), kNames), "");
}

TEST(SpellingTest, SuggestionListsEverything) {
  constexpr std::array<std::string_view, 2> kNames = {"open", "walled"};
  EXPECT_EQ(Suggest("waled", kNames), "did you mean \"walled\"? one of: open, walled");
  EXPECT_EQ(Suggest("zzzzzzzz", kNames), "one of: open, walled");
  EXPECT_EQ(Suggest("opn", std::span(kNames).first(1)), "did you mean \"open\"?");
  EXPECT_EQ(Suggest("x", {}), "");
}

}  // namespace
}  // namespace rockyard::core
