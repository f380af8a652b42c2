// Paths on the report page: how they are simplified, and what the page is given.
#include "report/page_tracks.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/page_data.h"
#include "sample_run.h"

namespace rockyard::report {
namespace {

using nlohmann::json;

PathPiece Wave() {
  PathPiece piece;
  for (int i = 0; i <= 1000; ++i) piece.push_back({0.01 * i, 0.2 * std::sin(0.01 * i), 0.0});
  return piece;
}

double Nearest_m(const math::Pose2& point, const PathPiece& line) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const double share = static_cast<double>(k) / kSteps;
      const math::Pose2 on{line[i - 1].x_m + share * (line[i].x_m - line[i - 1].x_m),
                           line[i - 1].y_m + share * (line[i].y_m - line[i - 1].y_m), 0.0};
      nearest_m = std::min(nearest_m, Apart_m(point, on));
    }
  }
  return nearest_m;
}

TEST(Simplified, NoPointIsFurtherOffThanTheTolerance) {
  const PathPiece wave = Wave();
  const PathPiece kept = Simplified({wave}, 0.01).front();
  EXPECT_LT(kept.size(), 40u);
  EXPECT_EQ(kept.front().x_m, wave.front().x_m);
  EXPECT_EQ(kept.back().x_m, wave.back().x_m);
  double furthest_m = 0.0;
  for (const math::Pose2& point : wave) {
    furthest_m = std::max(furthest_m, Nearest_m(point, kept));
  }
  EXPECT_LE(furthest_m, 0.0105);
  EXPECT_GT(furthest_m, 0.004);  // no more points than are needed
}

TEST(Simplified, ALineKeepsItsEndsAndAWayThereAndBackItsTurn) {
  const TracePath line{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(line, 0.01).front().size(), 2u);
  const TracePath back{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(back, 0.01).front().size(), 3u);
  const TracePath closed{{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(closed, 0.01).front().size(), 3u);
  EXPECT_EQ(Simplified({{}, {{1.0, 2.0, 0.0}}}, 0.01).size(), 2u);
}

TEST(Thinned, AsManyPointsAsAllowedAreNotThinnedFurther) {
  const TracePath path{Wave()};
  const std::size_t finest = Thinned(path, 100000).front().size();
  EXPECT_EQ(Thinned(path, finest).front().size(), finest);
  EXPECT_LT(Thinned(path, finest - 1).front().size(), finest);
}

TEST(PageTracks, AreWholeCentimetresWithoutRepeats) {
  const PageTrack track{
      7,
      {{{0.0, 0.0, 0.0}, {0.001, 0.0, 0.0}, {1.234, -0.5, 0.0}}, {{2.0, 1.0, 0.0}}},
      {{1.0, 2.0, 0.125}}};
  EXPECT_EQ(json::parse(PageTracksJson(std::vector{track})), json::parse(R"([
    {"trial": 7, "pieces_cm": [[0, 0, 123, -50], [200, 100]], "rocks_cm": [100, 200, 13]}])"));
}

TEST(PageTracks, TheCourseIsWhereDrivesLead) {
  const PageCourse course{.rover = "R \"2\"",
                          .start = {0.5, 1.0, 2.0},
                          .goal = {7.6, -0.25},
                          .goal_radius_m = 0.65,
                          .waypoints = {{3.0, 4.0}},
                          .mirror_lines_m = {-1.1, 1.1}};
  EXPECT_EQ(json::parse(PageCourseJson(course)), json::parse(R"({"rover": "R \"2\"",
    "start": [0.5, 1], "goal": [7.6, -0.25], "goal_radius_m": 0.65, "waypoints": [[3, 4]],
    "mirror_lines_m": [-1.1, 1.1]})"));
}

TEST(PageEndings, CountOutcomesWithTheirDetailsMostFirst) {
  EXPECT_EQ(json::parse(PageEndingsJson(SampleRecords())), json::parse(R"([
    {"outcome": "goal_reached", "detail": "arrived", "count": 2, "limit": false},
    {"outcome": "false_goal", "detail": "believed, \"only\"", "count": 1, "limit": false},
    {"outcome": "no_path", "detail": "nowhere to go", "count": 1, "limit": false},
    {"outcome": "time_limit", "detail": "too long", "count": 1, "limit": true},
    {"outcome": "simulator_fault", "detail": "blew up", "count": 1, "limit": false}])"));
}

}  // namespace
}  // namespace rockyard::report
