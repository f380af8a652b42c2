#include "campaign/report_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "campaign/output_folder.h"
#include "campaign/report_replays.h"
#include "campaign/scan_capture.h"
#include "experiments/drive/drive_experiment.h"
#include "scenario/scenario.h"
#include "scenario/shipped.h"
#include "sensing/stereo_view.h"
#include "terrain/ground.h"

namespace rockyard::campaign {
namespace {

using testing::ElementsAre;

TEST(UniqueLabels, AreAsShortAsTheyCanBe) {
  EXPECT_THAT(UniqueLabels({{"a", "x/a"}, {"b", "x/b"}}), ElementsAre("a", "b"));
  EXPECT_THAT(UniqueLabels({{"a", "x/a"}, {"a", "y/a"}, {"b", "y/b"}}),
              ElementsAre("x/a", "y/a", "b"));
}

TEST(UniqueLabels, GetANumberWhereNothingElseTellsThemApart) {
  EXPECT_THAT(UniqueLabels({{"a"}, {"a"}, {"a (2)"}}), ElementsAre("a", "a (2)", "a (2) (2)"));
  EXPECT_TRUE(UniqueLabels({}).empty());
}

// The longer name of one may be the short name of another.
TEST(UniqueLabels, DifferWhateverTheNames) {
  const auto labels = UniqueLabels({{"a", "b"}, {"a", "c"}, {"b", "d"}});
  EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), 3u);
}

TEST(ShellWord, IsQuotedWhereAShellWouldReadMore) {
  EXPECT_EQ(ShellWord("results/runs/a-1_b.json"), "results/runs/a-1_b.json");
  EXPECT_EQ(ShellWord("k=0.004,n=a"), "k=0.004,n=a");
  EXPECT_EQ(ShellWord("my run"), "'my run'");
  EXPECT_EQ(ShellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(ShellWord("$(rm -r x)"), "'$(rm -r x)'");
  EXPECT_EQ(ShellWord(""), "''");
  EXPECT_EQ(ShellWord("-x"), "-x");
  EXPECT_EQ(ShellWord("caf\u00e9"), "'caf\u00e9'");
}

TEST(ShellWord, OfWhatATerminalWouldNotShowIsWrittenInNumbers) {
  EXPECT_EQ(ShellWord("a\u202eb"), "$'a\\342\\200\\256b'");
  EXPECT_EQ(ShellWord("\n'\\ \x7f"), "$'\\012\\047\\134 \\177'");
}

TEST(ShellPath, IsNoOption) {
  EXPECT_EQ(ShellPath("-x"), "./-x");
  EXPECT_EQ(ShellPath("--help me"), "'./--help me'");
  EXPECT_EQ(ShellPath("a-x"), "a-x");
  EXPECT_EQ(ShellPath("/-x"), "/-x");
}

TEST(WorstTrials, OfSeveralCellsTheFurthestFromTheGoalComeFirst) {
  const auto trial = [](std::uint64_t number, double distance_m) {
    ChosenTrial worst;
    worst.record.trial = number;
    worst.goal_distance_m = distance_m;
    return worst;
  };
  const auto worst = Worst({trial(1, 2.0), trial(2, 5.0), trial(3, 5.0), trial(4, 1.0)}, 3);
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].record.trial, 2u);
  EXPECT_EQ(worst[1].record.trial, 3u);
  EXPECT_EQ(worst[2].record.trial, 1u);
}

// The map of a place shows heights around the course, roughness apart, every trial the same ones.
TEST(CourseOf, AnElevationModelHasItsContours) {
  StoredRun run;
  const scenario::Scenario site = scenario::Shipped("sites/crater_wall");
  run.identity.resolved = scenario::ResolvedJson(site);
  const auto course = CourseOf(run);
  ASSERT_TRUE(course);
  ASSERT_GT(course->contours.size(), 5u);
  EXPECT_GT(course->contour_interval_m, 0.0);
  terrain::GroundParams smooth = site.drive.terrain.ground;
  smooth.roughness_rms_m = 0.0;
  const terrain::Ground ground(smooth, {});
  double farthest_m = 0.0;
  for (const report::PageContour& contour : course->contours) {
    for (const messages::Goal& point : contour.line) {
      // A rough ground would be off by its 0.03 m.
      ASSERT_NEAR(ground.Height(point.x_m, point.y_m), contour.height_m, 0.015);
      farthest_m = std::max(farthest_m, std::abs(point.y_m));
    }
  }
  EXPECT_NEAR(farthest_m, 4.0, 0.05) << "4 m beside the course, though the arena is wider";
  run.identity.resolved = scenario::ResolvedJson(scenario::Shipped("pathfinder/nominal"));
  EXPECT_THAT(CourseOf(run)->contours, testing::IsEmpty());
}

// The scene of a decision against the simulation that it was taken in.

// The first decision after the rover has moved, and what is left of it when the call is over.
struct Watched {
  report::StepScene scene;
  math::Transform X_WR = math::Transform::Identity();
  messages::NavigationView view;
  std::size_t rocks = 0;
};

scenario::Scenario NarrowCourse() {
  scenario::Scenario scenario = scenario::Shipped("gestalt/narrow_course");
  scenario.drive.referee.time_limit_s = 240.0;
  return scenario;
}

Watched WatchStep(const scenario::Scenario& scenario, std::int64_t number) {
  std::optional<Watched> found;
  truth::Trace trace;
  const auto watch = [&](const trial::WatchedStep& step) {
    if (step.view.step != number) return;
    found = {SceneOf(step, trace), step.X_WR, step.view, step.terrain.rocks().size()};
  };
  const experiments::DriveExperiment drive(scenario.drive, {.step = watch});
  drive.RunTraced(1, 0, trace);
  return found.value();
}

TEST(StepScene, HoldsTheCourseSoFar) {
  const scenario::Scenario scenario = NarrowCourse();
  const Watched watched = WatchStep(scenario, 3);
  const report::StepScene& scene = watched.scene;
  EXPECT_EQ(scene.rocks.size(), watched.rocks);
  EXPECT_EQ(scene.goal.x_m, 5.0);
  EXPECT_EQ(scene.rover_length_m, scenario.drive.rover.geometry.length_m);
  EXPECT_TRUE(scene.X_WR.isApprox(watched.X_WR));
  // Both paths begin at the start and end where the rover stands, and where it believes to.
  ASSERT_EQ(scene.true_path.size(), 1u);
  const math::Pose2 stands = math::ToPose2(watched.X_WR);
  EXPECT_NEAR(scene.true_path[0].front().x_m, 0.0, 0.05);
  EXPECT_NEAR(report::Apart_m(scene.true_path[0].back(), stands), 0.0, 0.02);
  EXPECT_GT(stands.x_m, 0.2);
  const messages::PoseEstimate& estimate = watched.view.estimate;
  EXPECT_NEAR(scene.believed.x_m, estimate.x_m, 1e-9);
  EXPECT_NEAR(scene.believed.heading_rad, estimate.heading_rad, 1e-9);
  EXPECT_NEAR(report::Apart_m(scene.believed_path[0].back(), scene.believed), 0.0, 0.02);
}

// The camera images what a pixel looks at into that pixel, whose middle lies half of one from its
// corner.
TEST(StepScene, TheCameraIsTheLeftOneOfTheFrontPair) {
  const scenario::Scenario scenario = NarrowCourse();
  const report::StepScene scene = WatchStep(scenario, 0).scene;
  ASSERT_TRUE(scene.camera);
  const sensing::StereoView view =
      sensing::MakeStereoView(scenario.drive.sensors.stereo, messages::LookDirection::kAhead);
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, {127.0, 20.0}, {50.0, 127.0}}) {
    const auto seen = report::Project(*scene.camera, view.eye + 1.7 * view.Ray(column, row));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->column, column + 0.5, 1e-9);
    EXPECT_NEAR(seen->row, row + 0.5, 1e-9);
  }
}

TEST(StepScene, ALightStripeIsNoCamera) {
  scenario::Scenario scenario = NarrowCourse();
  scenario.drive.sensors.terrain_sensors.Choose("light_stripe");
  EXPECT_FALSE(WatchStep(scenario, 0).scene.camera);
}

}  // namespace
}  // namespace rockyard::campaign
