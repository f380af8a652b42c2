#include "report/line_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "report/atomic_file.h"
#include "report/result_table.h"
#include "report/run_files.h"
#include "sample_run.h"
#include "truth/end_cause.h"

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

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  static std::string Read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(AtomicFileTest, WritesAndReplaces) {
  const std::string large(3'000'000, 'x');
  WriteFileAtomically(folder_ / "a", large);
  EXPECT_EQ(Read(folder_ / "a"), large);
  WriteFileAtomically(folder_ / "a", "short\n");
  EXPECT_EQ(Read(folder_ / "a"), "short\n");
  EXPECT_EQ(Files(), 1) << "no temporary file stays";
}

// Pieces of a line each, more than are held at once; without Commit, as after an exception, the old
// file stays.
TEST_F(AtomicFileTest, WritesPieceByPiece) {
  const std::string line(999, 'x');
  std::string all;
  WriteFileAtomically(folder_ / "a", [&](const TextSink& out) {
    for (int i = 0; i < 3000; ++i) {
      out(line + "\n");
      all += line + "\n";
    }
    EXPECT_FALSE(fs::exists(folder_ / "a"));
  });
  EXPECT_EQ(Read(folder_ / "a"), all);
  const auto fails = [&](const TextSink& out) {
    out(all);
    throw std::runtime_error("half way");
  };
  EXPECT_THROW(WriteFileAtomically(folder_ / "a", fails), std::runtime_error);
  EXPECT_EQ(Read(folder_ / "a"), all);
  EXPECT_EQ(Files(), 1) << "no temporary file stays";
}

// Whoever may write in the folder could foresee the name that the temporary file had before.
TEST_F(AtomicFileTest, FollowsNoPlantedLink) {
  std::ofstream(folder_ / "victim") << "mine";
  fs::create_symlink(folder_ / "victim", folder_ / ("a.tmp-" + std::to_string(getpid())));
  WriteFileAtomically(folder_ / "a", "text");
  EXPECT_EQ(Read(folder_ / "a"), "text");
  EXPECT_EQ(Read(folder_ / "victim"), "mine");
}

TEST_F(AtomicFileTest, RemovesWhatAKilledOneLeft) {
  std::ofstream(folder_ / "a.tmp-0123456789abcdef") << "half";
  WriteFileAtomically(folder_ / "a", "text");
  EXPECT_EQ(Files(), 1);
}

TEST_F(AtomicFileTest, FailsWithTheNameAndLeavesNothing) {
  fs::create_directories(folder_ / "taken" / "inside");
  EXPECT_THAT(core::ProblemsIn([&] { WriteFileAtomically(folder_ / "taken", "text"); }),
              core::OneProblem((folder_ / "taken").string()));
  EXPECT_EQ(Files(), 1);
  EXPECT_THROW(WriteFileAtomically(folder_ / "no" / "such", "text"), core::UserError);
  EXPECT_THROW(WriteFileAtomically("/proc/rockyard", "text"), core::UserError);
}

using Row = std::vector<std::string>;

// A reader of its own for RFC 4180.
std::vector<Row> Parse(const std::string& csv) {
  std::vector<Row> rows;
  Row row;
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (quoted) {
      if (c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
        field += csv[++i];
      } else if (c == '"') {
        quoted = false;
      } else {
        field += c;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(std::exchange(field, ""));
      if (c == '\n') rows.push_back(std::exchange(row, {}));
    } else {
      field += c;
    }
  }
  EXPECT_TRUE(field.empty() && row.empty()) << "the last line has no end";
  return rows;
}

double Number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

// What a spreadsheet would run ("=HYPERLINK(...)", "@SUM(...)", "-2+3+cmd|...") is text to it.
TEST(CsvField, IsNoFormula) {
  for (const char* formula : {"=1+1", "@SUM(A1)", "+1+1", "-2+3", "\t=1", "--", "+-", "=="}) {
    EXPECT_EQ(CsvField(formula), "'" + std::string(formula));
  }
  EXPECT_EQ(CsvField("=f(1,\"x\")"), "\"'=f(1,\"\"x\"\")\"");
  EXPECT_EQ(CsvField("\r=1"), "\"'\r=1\"");
}

TEST(CsvField, LeavesNumbersSignsAndPlainTexts) {
  for (const char* text :
       {"-1.5", "+3", "-1e-300", "-5e-324", "+0.25", "-", "+", "=", "@", "", "a=b", " =1"}) {
    EXPECT_EQ(CsvField(text), text);
  }
}

TEST(CsvField, ReadsBackWithoutItsFirstApostrophe) {
  for (const std::string text : {"=1,2", "'quoted'", "''", "'", "it's", "-x", "plain", "-4"}) {
    std::string read = Parse(CsvField(text) + "\n").at(0).at(0);
    if (read.starts_with('\'')) read.erase(0, 1);
    EXPECT_EQ(read, text);
  }
}

TEST(ResultTable, WritesItsRowsInEveryForm) {
  ResultTable table("name,low,high,count,whole");
  table.Add("=a|b", statistics::Interval{0.5, std::nan("")}, 3, true);
  table.Add("c");
  EXPECT_EQ(table.Csv(), "name,low,high,count,whole\n'=a|b,0.5,,3,1\nc,,,,\n");
  EXPECT_EQ(table.Csv("count as n,name"), "n,name\n3,'=a|b\n,c\n");
  EXPECT_EQ(table.Json("name,high,low as l,whole"),
            R"([{"name":"=a|b","high":null,"l":0.5,"whole":true},)"
            R"({"name":"c","high":null,"l":null,"whole":null}])");
  EXPECT_EQ(ResultTable("a,b").Csv(), "a,b\n");
}

TEST(TrialsCsv, ReadsBackToTheSameRecords) {
  std::vector<truth::Record> records = SampleRecords();
  records[0].values[0] = 0.1 + 0.2;
  records[0].detail = "a, \"b\"\nc";
  records[2].detail = truth::Info(truth::EndCause::kGaveUp).sentence;
  const auto rows = Parse(WrittenBy(TrialsCsv, SampleSchema(), records));
  ASSERT_EQ(rows.size(), records.size() + 1);
  EXPECT_EQ(rows[0].front(), "trial");
  EXPECT_EQ(rows[0][rows[0].size() - 2], "cause");
  EXPECT_EQ(rows[0].back(), "detail");
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Row& row = rows[i + 1];
    ASSERT_EQ(row.size(), SampleSchema().size() + 4);
    EXPECT_EQ(row[0], std::to_string(records[i].trial));
    EXPECT_EQ(row[1], truth::Name(records[i].outcome));
    EXPECT_EQ(row.back(), records[i].detail);
    EXPECT_EQ(row[row.size() - 2], i == 2 ? "gave_up" : "");
    for (std::size_t j = 0; j < SampleSchema().size(); ++j) {
      const bool defined = j < records[i].values.size() && std::isfinite(records[i].values[j]);
      EXPECT_EQ(row[j + 2].empty(), !defined);
      if (!defined) continue;
      EXPECT_EQ(std::bit_cast<std::uint64_t>(Number(row[j + 2])),
                std::bit_cast<std::uint64_t>(records[i].values[j]));
    }
  }
}

// Ends at 4 (no path), 6 (time limit), 8 and 8 (goal), 9 (believed goal); the fault is left out.
TEST(DistanceCdfCsv, ByHand) {
  const auto rows = Parse(WrittenBy(DistanceCdfCsv, SampleSchema(), SampleRecords()));
  ASSERT_EQ(rows.size(), 5U);
  const double distance[] = {4.0, 6.0, 8.0, 9.0};
  const double ecdf[] = {0.2, 0.4, 0.8, 1.0};
  // Of five: no path and the time limit compete, two arrive, and the last.
  const double goal[] = {0.0, 0.0, 0.4, 0.6};
  const double failure[] = {0.2, 0.4, 0.4, 0.4};
  const char* at_risk[] = {"5", "4", "3", "1"};
  const double limit[] = {0.0, 0.2, 0.2, 0.2};  // time was over at 6
  for (std::size_t i = 0; i < 4; ++i) {
    const Row& row = rows[i + 1];
    EXPECT_EQ(Number(row[0]), distance[i]);
    EXPECT_DOUBLE_EQ(Number(row[1]), ecdf[i]);
    EXPECT_LE(Number(row[2]), ecdf[i]);
    EXPECT_GE(Number(row[3]), ecdf[i]);
    EXPECT_NEAR(Number(row[4]), goal[i], 1e-12);
    EXPECT_NEAR(Number(row[7]), failure[i], 1e-12);
    EXPECT_EQ(row[8], at_risk[i]);
    EXPECT_DOUBLE_EQ(Number(row[9]), limit[i]);
  }
}

TEST(DistanceCdfCsv, WithoutDistancesOnlyTheHeader) {
  EXPECT_EQ(Parse(WrittenBy(DistanceCdfCsv, {{"speed", "m/s", ""}}, {})).size(), 1U);
  EXPECT_EQ(Parse(WrittenBy(DistanceCdfCsv, SampleSchema(), {})).size(), 1U);
}

}  // namespace

}  // namespace rockyard::report
