// Scenarios of places: `terrain --dem`, `--rocks`, `--scan-sites`, `--fit`.

#include <cmath>

#include "app/command.h"
#include "image_files/raster_bytes.h"

namespace rockyard::app {
namespace {

class CliSites : public CommandTest {
 protected:
  // A gentle slope of 50 x 40 nodes of 1 m, rough by a few centimetres.
  void SetUp() override {
    std::vector<double> heights;
    for (int r = 0; r < 50; ++r) {
      for (int c = 0; c < 40; ++c)
        heights.push_back(700.0 - 0.03 * r + 0.02 * std::sin(3.0 * r * c));
    }
    WriteFile(work() / "place.npy", image_files::NpyBytes("<f4", 40, heights));
    WriteFile(work() / "rocks.csv",
              "id,East_m,North_m,D (cm)\n1,1,0.5,30\n2,2,-1,25\n3,500,0,30\n");
  }
  json Written(const std::string& name) const { return json::parse(ReadFile(work() / name)); }
};

TEST_F(CliSites, FromAModelToARun) {
  const CommandResult made = RunTo(0, {"terrain", "--dem", "place.npy", "--cell", "1", "--credit",
                                       "by a test", "--set", "trials=2", "--out", "site.json"});
  EXPECT_EQ(made.err, "  scenario in site.json\n");
  EXPECT_THAT(made.out, StartsWith("site in site.json\n"));
  EXPECT_THAT(made.out, Says("rows 0 to 49", "39.00 m east, 49.00 m north: 40 x 50 nodes of 1 m",
                             "relief", "median", "without data      none", "Hurst exponent",
                             "metres are assumed", "next: rockyard run site.json\n"));
  const json site = Written("site.json");
  EXPECT_EQ(site["trials"], 2);
  EXPECT_EQ(site["terrain"]["arena"]["kind"], "open");
  EXPECT_EQ(site["terrain"]["ground"]["elevation"]["heights_m"].size(), 2000);
  EXPECT_THAT(std::string(site["terrain"]["ground"]["elevation"]["source"]),
              HasSubstr("by a test"));
  EXPECT_THAT(RunTo(0, {"validate", "site.json"}).out, HasSubstr("valid"));
  RunTo(0, {"run", "site.json", "--set", "referee.time_limit_s=1", "--out", "run"});
  EXPECT_EQ(Summary("run")["trials"]["completed"], 2);
}

TEST_F(CliSites, NothingIsOverwritten) {
  WriteFile(work() / "mine.json", "{}");
  const CommandResult there =
      RunTo(2, {"terrain", "--dem", "place.npy", "--cell", "1", "--out", "mine.json"});
  EXPECT_THAT(there.err, HasSubstr("which is there already"));
  EXPECT_EQ(ReadFile(work() / "mine.json"), "{}");
  EXPECT_THAT(RunTo(2, {"terrain", "--dem", "place.npy", "--cell", "1"}).err,
              HasSubstr("--out: is not given"));
  RunTo(2, {"terrain", "--dem", "place.npy", "--cell", "1", "--out", "site.svg"});
  EXPECT_FALSE(fs::exists(work() / "site.svg"));
}

TEST_F(CliSites, WhatWouldBeIgnoredIsRefused) {
  const std::vector<std::string> site{"terrain", "--dem", "place.npy", "--cell", "1"};
  const auto refused = [&](std::vector<std::string> more, const std::string& pair) {
    more.insert(more.begin(), site.begin(), site.end());
    EXPECT_THAT(RunTo(2, more).err, HasSubstr(pair));
  };
  refused({"--trial", "3", "--out", "site.json"}, "--trial excludes --dem");
  refused({"--seed", "3", "--out", "site.json"}, "--seed excludes --dem");
  refused({"--density"}, "--density excludes --dem");
  refused({"--scan-sites", "--out", "site.json"}, "--out excludes --scan-sites");
  EXPECT_THAT(RunTo(2, {"terrain", "--fit", "rocks.csv", "--out", "site.json"}).err,
              HasSubstr("--out excludes --fit"));
  EXPECT_FALSE(fs::exists(work() / "site.json"));
}

TEST_F(CliSites, PartsOfAModel) {
  RunTo(0, {"terrain", "nominal", "--dem", "place.npy", "--cell", "1", "--crop", "10,5,30,31",
            "--start", "-8,3", "--goal", "9,-2", "--no-roughness", "--out", "crop.json"});
  const json crop = Written("crop.json");
  EXPECT_EQ(crop["terrain"]["ground"]["elevation"]["columns"], 31);
  EXPECT_FALSE(crop["terrain"]["ground"].contains("roughness_rms_m"));
  EXPECT_EQ(crop["course"]["start_x_m"], -8);
  EXPECT_EQ(crop["course"]["goal_y_m"], -2);
  RunTo(0, {"terrain", "--dem", "place.npy", "--cell", "1", "--at", "20,25", "--size", "20",
            "--resolution", "2", "--out", "at.json"});
  EXPECT_EQ(Written("at.json")["terrain"]["ground"]["elevation"]["columns"], 21);
  EXPECT_EQ(Written("at.json")["terrain"]["ground"]["roughness_wavelength_m"], 2);
}

TEST_F(CliSites, WhatIsWrongIsTold) {
  const auto error = [&](const Words& more) {
    return RunTo(2, With({"terrain", "--dem", "place.npy", "--out", "site.json"}, more)).err;
  };
  EXPECT_THAT(error({}), Says("place.npy: does not say how large", "--cell 1"));
  EXPECT_THAT(error({"--cell", "1", "--crop", "0,0,10"}), HasSubstr("ROW,COLUMN,ROWS,COLUMNS"));
  EXPECT_THAT(error({"--cell", "1", "--crop", "0,0,10.5,10"}), HasSubstr("whole numbers"));
  EXPECT_THAT(error({"--cell", "1", "--crop", "45,0,10,10"}), HasSubstr("50 rows and 40 columns"));
  EXPECT_THAT(error({"--cell", "1", "--at", "here"}), HasSubstr("LAT,LON"));
  EXPECT_THAT(error({"--cell", "1", "--at", "2,2"}), HasSubstr("not all of which lies"));
  EXPECT_THAT(error({"--cell", "1", "--goal", "400,0"}), HasSubstr("outside of the arena"));
  EXPECT_THAT(error({"--cell", "1", "--rocks", "none.csv"}), HasSubstr("does not exist"));
  EXPECT_THAT(RunTo(2, {"terrain"}).err, HasSubstr("SCENARIO: is not given"));
  EXPECT_THAT(RunTo(2, {"terrain", "--dem", "rocks.csv", "--out", "site.json"}).err,
              HasSubstr("no format of elevation models"));
  EXPECT_FALSE(fs::exists(work() / "site.json"));
}

TEST_F(CliSites, RocksOfACatalogue) {
  const CommandResult made =
      RunTo(0, {"terrain", "nominal", "--rocks", "rocks.csv", "--columns",
                "x=East_m,y=North_m,diameter=D (cm):cm", "--out", "rocks.json"});
  EXPECT_THAT(made.out,
              Says("2 of the catalogue", "1 rocks of the catalogue lie beyond", "have no height"));
  const json listed = Written("rocks.json")["terrain"]["rocks"]["listed"];
  EXPECT_EQ(listed["x_m"], json({1, 2}));
  EXPECT_EQ(listed["diameter_m"], json({0.3, 0.25}));
  RunTo(0, {"terrain", "--rocks", "rocks.csv", "--dem", "place.npy", "--cell", "1", "--rest",
            "--out", "both.json"});
  EXPECT_EQ(Written("both.json")["terrain"]["rocks"]["listed"]["rest"], "moore");
  WriteFile(work() / "bad.csv", "x,y,d\n1,3,x\n2,3\n");
  const CommandResult bad = RunTo(2, {"terrain", "--rocks", "bad.csv", "--out", "bad.json"});
  EXPECT_THAT(bad.err, Says("bad.csv: line 2: \"x\" is no number for diameter",
                            "bad.csv: line 3: has 2 columns"));
}

TEST_F(CliSites, SitesBySlopes) {
  const Words scan{"terrain", "--dem", "place.npy", "--cell", "1", "--scan-sites", "--size", "15"};
  const CommandResult all = RunTo(0, With(scan, {"--count", "2"}));
  EXPECT_THAT(all.out, Says("20 windows of 15 m", "--crop", "--at"));
  EXPECT_EQ(std::count(all.out.begin(), all.out.end(), '\n'), 4);
  EXPECT_THAT(RunTo(0, With(scan, {"--slope-median", "40..50"})).out, HasSubstr("none has such"));
  EXPECT_THAT(RunTo(2, With(scan, {"--slope-median", "4"})).err, HasSubstr("LOW..HIGH"));
  EXPECT_THAT(RunTo(2, With(scan, {"--slope-median", "4..2"})).err, HasSubstr("above its end"));
}

TEST_F(CliSites, WhichLawFits) {
  std::string table = "diameter_m\n";
  for (int i = 0; i < 40; ++i)
    table += std::to_string(0.1 * std::pow(1.0 - i / 40.5, -0.376)) + "\n";
  WriteFile(work() / "sizes.csv", table);
  const CommandResult fit = RunTo(0, {"terrain", "--fit", "sizes.csv", "--area", "50",
                                      "--min-diameter", "0.1", "--max-diameter", "1"});
  EXPECT_THAT(fit.out, Says("Moore", "Golombek"));
  EXPECT_THAT(RunTo(2, {"terrain", "--fit", "sizes.csv"}).err, HasSubstr("--area"));
}

}  // namespace
}  // namespace rockyard::app
