#include "report/line_text.h"

#include <gtest/gtest.h>

#include <string>

namespace rockyard::report {
namespace {

TEST(Printable, HasNoControlCharacters) {
  EXPECT_EQ(Printable("a\nb\tc\x1b[31m\x7f"), "a b?c?[31m?");
  EXPECT_EQ(Printable("caf\u00e9"), "caf\u00e9");
}

TEST(Cut, CountsCodePointsAndCutsNone) {
  EXPECT_EQ(Columns("caf\u00e9"), 4u);
  EXPECT_EQ(Cut("abcdef", 6), "abcdef");
  EXPECT_EQ(Cut("abcdefg", 6), "abc...");
  EXPECT_EQ(Cut("\u00e9\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9...");
  EXPECT_EQ(Cut("\u00e9\u00e9\u00e9\u00e9", 4), "\u00e9\u00e9\u00e9\u00e9");
  EXPECT_EQ(Cut("abcd", 3), "...");
  EXPECT_EQ(Cut("", 3), "");
}

}  // namespace
}  // namespace rockyard::report
