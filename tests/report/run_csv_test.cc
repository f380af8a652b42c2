#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

#include "report/csv.h"
#include "report/result_table.h"
#include "report/run_files.h"
#include "sample_run.h"
#include "truth/end_cause.h"

namespace rockyard::report {
namespace {

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
