// The scene of a decision against the simulation that it was taken in.
#include <gtest/gtest.h>

#include <optional>

#include "campaign/scan_capture.h"
#include "experiments/drive/drive_experiment.h"
#include "scenario/scenario.h"
#include "scenario/shipped.h"
#include "sensing/stereo_view.h"

namespace rockyard::campaign {
namespace {

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
