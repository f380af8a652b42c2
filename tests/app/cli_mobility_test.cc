// rockyard mobility: its files, its text, and what is said of input that cannot be meant.

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliMobility : public CommandTest {
 protected:
  static Words Mobility(const Words& more = {}) {
    return With({"mobility", Scenario("nominal"), "--slopes", "0:20:10", "--draws", "2",
                 "--no-steps", "--threads", "1", "--set", "terrain.ground.soil.law=bekker"},
                more);
  }

  // Exit code 2, these words, and nothing written.
  void ExpectRefused(const Words& words, const Words& said) const {
    const CommandResult result = RunTo(2, words);
    for (const std::string& word : said) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(work() / "out"));
  }

  static std::size_t Count(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
      ++count;
    }
    return count;
  }
};

TEST_F(CliMobility, WritesChartsAndTables) {
  WriteFile(work() / "points.csv",
            "soil,slope_deg,slip\nmars_drift,10,0.25\nlandscaping_sand,10,0.2\n");
  const CommandResult result = RunTo(0, Mobility({"--out", "out", "--points", "points.csv"}));
  EXPECT_THAT(result.out,
              Says("mobility of nominal", "wheel law bekker", "slip below 80 %", "landscaping_sand",
                   "mars_drift", "hard_ground", "charts in out/mobility.svg"));
  EXPECT_THAT(result.err, HasSubstr("9/9 curves"));

  const std::string svg = ReadFile(work() / "out/mobility.svg");
  for (const char* title : {"Slip straight up", "Side slip across, heading held",
                            "Drawbar pull of a wheel, mean load", "Mean sinkage, up"}) {
    for (const char* soil : {"landscaping sand", "mars drift", "hard ground"}) {
      const std::string curve = std::string("data-curve=\"") + title + ": " + soil + "\"";
      EXPECT_EQ(Count(svg, curve), 1U) << curve;
    }
  }
  EXPECT_EQ(Count(svg, "<polygon"), 10U * 3U - 2U)
      << "a band for each curve, but across for drift, on which a drawn soil lets it turn off";
  EXPECT_EQ(Count(svg, "<circle"), 2U) << "measured points";
  EXPECT_THAT(svg, Says("slope [deg]", "slip [%]", "torque [Nm]", "power [W]"));

  const std::string csv = ReadFile(work() / "out/slopes.csv");
  EXPECT_THAT(csv, StartsWith("soil,load,way,slope_deg,state,slip,slip_low,slip_high,side_slip_deg,"
                              "side_slip_deg_low,side_slip_deg_high,sinkage_mm,"));
  EXPECT_THAT(csv, HasSubstr("load_left_front_N"));
  EXPECT_EQ(Count(csv, "\n"), 1U + 3U * 3U * 3U);
  EXPECT_THAT(ReadFile(work() / "out/limits.csv"),
              Says("slip_limit_slope_deg", "largest_slope_deg"));
  EXPECT_THAT(ReadFile(work() / "out/wheel.csv"), HasSubstr("pull_per_load"));
}

TEST_F(CliMobility, JsonIsOneObjectOfColumns) {
  const json said = json::parse(RunTo(0, Mobility({"--json", "--soil", "mars_drift"})).out);
  EXPECT_EQ(said["schema_version"], 1);
  EXPECT_EQ(said["rover"], "nominal");
  EXPECT_EQ(said["draws"], 2);
  EXPECT_EQ(said["soils"]["mars_drift"]["law"], "bekker");
  for (const char* table : {"slopes", "wheel", "limits"}) {
    const std::size_t rows = said[table]["soil"].size();
    ASSERT_EQ(said["columns"][table].size(), said[table].size());
    for (const json& column : said["columns"][table]) {
      EXPECT_EQ(said[table][column["name"].get<std::string>()].size(), rows) << column;
      EXPECT_TRUE(column.contains("unit") && column.contains("what")) << column;
    }
  }
  EXPECT_EQ(said["slopes"]["slope_deg"], json::parse("[0,10,20,0,10,20,0,10,20]"));
  EXPECT_TRUE(said["limits"]["largest_step_m"][0].is_null());
}

TEST_F(CliMobility, ARoverThatSlidesSaysSo) {
  const CommandResult result =
      RunTo(0, {"mobility", Scenario("nominal"), "--slopes", "45", "--draws", "0", "--no-steps",
                "--soil", "landscaping_sand", "--set", "terrain.ground.soil.law=bekker"});
  EXPECT_THAT(result.out, Says("45", "100.0", "slides"));
}

TEST_F(CliMobility, RefusesBeforeAnythingIsWritten) {
  ExpectRefused(Mobility({"--out", "out", "--soil", "marsdrift"}),
                {"did you mean \"mars_drift\"?"});
  ExpectRefused(Mobility({"--out", "out", "--slip-limit", "2"}), {"--slip-limit"});
  ExpectRefused(Mobility({"--out", "out", "--points", "none.csv"}), {"none.csv"});
  ExpectRefused(Mobility({"--out", "out", "--set", "rover.mass.chassis_com_x_m=0.9"}),
                {"chassis_com_x_m"});
  for (const char* slopes : {"steep", "0:25", "25:0:1", "0:25:0", "0:25:1e-9", "0,,5", "70"}) {
    ExpectRefused({"mobility", Scenario("nominal"), "--slopes", slopes, "--out", "out"},
                  {"--slopes", "0:25:1"});
  }
  ExpectRefused({"mobility", "nomnal", "--out", "out"}, {"nomnal"});
  WriteFile(work() / "file", "");
  RunTo(2, Mobility({"--out", "file"}));
}

TEST_F(CliMobility, KeepsWhatItDidNotMake) {
  fs::create_directories(work() / "out");
  WriteFile(work() / "out/slopes.csv", "mine");
  const Words words = Mobility({"--out", "out", "--soil", "mars_drift"});
  RunTo(2, words);
  EXPECT_EQ(ReadFile(work() / "out/slopes.csv"), "mine");
  RunTo(0, With(words, {"--force"}));
  EXPECT_EQ(ReadFile(work() / "out/old-1/slopes.csv"), "mine");
}

TEST_F(CliMobility, IsInterrupted) {
  const pid_t process =
      Start({"mobility", Scenario("nominal"), "--out", "out", "--draws", "1000", "--threads", "1"});
  usleep(300'000);
  kill(process, SIGINT);
  const CommandResult result = WaitTo(130, process);
  EXPECT_THAT(result.err, HasSubstr("nothing is written"));
  EXPECT_FALSE(fs::exists(work() / "out"));
}

}  // namespace
}  // namespace rockyard::app
