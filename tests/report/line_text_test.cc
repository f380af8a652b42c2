#include "report/line_text.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/json_text.h"

namespace rockyard::report {
namespace {

TEST(Printable, HasNoControlCharacters) {
  EXPECT_EQ(Printable("a\nb\tc\x1b[31m\x7f"), "a b?c?[31m?");
  EXPECT_EQ(Printable("caf\u00e9"), "caf\u00e9");
}

// U+202E turns the rest of a line around: "txt.exe" is shown for what ends in "exe.txt".
TEST(Printable, ShowsWhatATerminalWouldHideOrObey) {
  EXPECT_EQ(Printable("a\u202eb"), "a?b");
  for (const char* hidden : {"\u0080", "\u009b", "\u009f", "\u061c", "\u200b", "\u200f", "\u2028",
                             "\u202a", "\u202e", "\u2060", "\u2066", "\u2069", "\u206f", "\ufeff",
                             "\ufff9", "\ufffb", "\U000e0000", "\U000e007f"}) {
    EXPECT_EQ(Printable(hidden), "?");
  }
  for (const char* shown :
       {" ",      "~",          "\u00a0",     "\u061b",     "\u061d",     "\u200a", "\u2010",
        "\u2027", "\u202f",     "\u205f",     "\u2070",     "\ufefe",     "\uff00", "\ufff8",
        "\ufffd", "\U0001f680", "\U000dffff", "\U000e0080", "\U0010ffff", "\u8001"}) {
    EXPECT_EQ(Printable(shown), shown);
  }
}

TEST(Printable, ShowsABadByteAsOne) {
  EXPECT_EQ(Printable("\x9b"
                      "31m"),
            "?31m")
      << "an escape sequence of 8-bit terminals";
  EXPECT_EQ(Printable("caf\xe9"), "caf?");
  EXPECT_EQ(Printable("\xe2\x80"), "??") << "cut off";
  EXPECT_EQ(Printable("\xe2\x80z"), "??z");
  EXPECT_EQ(Printable("\xc0\xaf"), "??") << "longer than needed";
  EXPECT_EQ(Printable("\xc1\xbf"), "??");
  EXPECT_EQ(Printable("\xe0\x9f\xbf"), "???");
  EXPECT_EQ(Printable("\xf0\x8f\xbf\xbf"), "????");
  EXPECT_EQ(Printable("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_EQ(Printable("\xed\xbf\xbf"), "???");
  EXPECT_EQ(Printable("\xf4\x90\x80\x80"), "????") << "beyond Unicode";
  EXPECT_EQ(Printable("\xf5\x80\x80\x80"), "????");
  EXPECT_EQ(Printable(std::string_view("\0", 1)), "?");
}

TEST(PrintableLines, KeepsLinesAndTheColoursOfThisProgram) {
  EXPECT_EQ(PrintableLines("a\n\x1b[1mb\x1b[0m\n"), "a\n\x1b[1mb\x1b[0m\n");
  EXPECT_EQ(PrintableLines("\x1b[8mhidden\x1b[2J\x1b]0;title\x07"), "?[8mhidden?[2J?]0;title?");
  EXPECT_EQ(PrintableLines("a\rb\u202e"), "a?b?");
}

TEST(PrintableJson, SaysTheSame) {
  const std::string json = "{\n  \"a\": \"\u202e\x7f\u009b\U000e0041\u00e9\"\n}\n";
  EXPECT_EQ(PrintableJson(json), "{\n  \"a\": \"\\u202e\\u007f\\u009b\\udb40\\udc41\u00e9\"\n}\n");
  EXPECT_EQ(core::ParseJson(PrintableJson(json), "after").Find("a")->text(),
            core::ParseJson(json, "before").Find("a")->text());
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
