#include "report/navigation_drawing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/count_of.h"
#include "core/says.h"
#include "report/step_scene.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using core::CountOf;
using messages::MotionKind;
using messages::NavigationView;
using testing::HasSubstr;
using testing::Not;

// 4 x 2 cells; the lower row is known (255 255 0 0), the upper row is not.
NavigationView Sample() {
  NavigationView view;
  view.estimate = {.x_m = 0.4, .y_m = 0.2, .heading_rad = 0.0, .distance_m = 0.0};
  view.goal = {0.7, 0.3};
  view.map = {
      .x0_m = 0.0, .y0_m = 0.0, .xstep_m = 0.2, .ystep_m = 0.2, .nx = 4, .ny = 2, .cells = {}};
  for (const int goodness : {255, 255, 0, 0}) {
    view.map.cells.push_back({.has_data = true,
                              .elevation_m = goodness == 0 ? 0.3 : -0.1,
                              .known = true,
                              .goodness = static_cast<std::uint8_t>(goodness),
                              .certainty = 255});
  }
  view.map.cells.resize(8);
  for (const double curvature : {-2.0, 0.0, 2.0}) {
    view.forward.push_back({.motion = {MotionKind::kArc, curvature, 1},
                            .hazard = 200.0,
                            .hazard_certainty = 255.0,
                            .waypoint = 100.0,
                            .merged = 157.0,
                            .best = curvature >= 0.0,
                            .chosen = curvature > 0.0});
    view.backward.push_back({.motion = {MotionKind::kArc, curvature, -1}});
  }
  return view;
}

// On the ground under a level camera 0.5 m up, 100 x 100 px of 90 x 90 degrees.
StepScene SampleScene() {
  StepScene scene;
  scene.X_WR.translation() << 0.4, 0.2, 0.0;
  scene.believed = {0.5, 0.2, 0.0};
  scene.rover_length_m = 0.2;
  scene.rover_width_m = 0.1;
  scene.goal = {3.0, 0.3};
  scene.goal_radius_m = 0.5;
  scene.camera = PinholeCamera{.eye = {-1.0, 0.0, 0.5},
                               .focal_columns_px = 50.0,
                               .focal_rows_px = 50.0,
                               .columns_px = 100.0,
                               .rows_px = 100.0};
  return scene;
}

// A cube of 0.2 m; from above its base.
SceneRock Cube(double x_m, double y_m) {
  SceneRock rock;
  for (const double z_m : {0.0, 0.2}) {
    for (const auto& [dx_m, dy_m] : {std::pair{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}) {
      rock.surface_W.push_back({x_m + dx_m, y_m + dy_m, z_m});
      if (z_m == 0.0) rock.outline_W.push_back(rock.surface_W.back());
    }
  }
  return rock;
}

TEST(NavigationSvg, DrawsMapsVotesAndTheChoice) {
  const std::string svg = NavigationSvg({"trial 3 <b>&", Sample(), {}});
  EXPECT_THAT(svg, core::Says("trial 3 &lt;b&gt;&amp;: forward +2.00 /m (vote 157)",
                              "dark -0.10 m, light 0.30 m"));
  EXPECT_EQ(CountOf(svg, "<polyline"), 6) << "every arc";
  EXPECT_EQ(CountOf(svg, "stroke-width=\"4\""), 1) << "the chosen one";
  EXPECT_EQ(CountOf(svg, "fill=\"#009e73\""), 2) << "two arcs share the best vote";
  EXPECT_EQ(CountOf(svg, "stroke=\"#009e73\""), 1);
  // Background, three panels; cells in runs: two of elevation, two of goodness, one of certainty;
  // three rows of six votes; two underlines, one frame; the plan of the course and its scale.
  EXPECT_EQ(CountOf(svg, "<rect"), 1 + 3 + 5 + 18 + 2 + 1 + 2);
}

TEST(NavigationSvg, DrawsTheCourseWithThePathSoFar) {
  StepScene scene = SampleScene();
  scene.camera.reset();
  scene.waypoints = {{1.5, 0.2}, {2.0, -0.2}};
  scene.true_path = {
      {{0.0, 0.0, 0.0}, {0.4, 0.2, 0.0}}, {{1.0, 0.0, 0.0}, {1.2, 0.0, 0.0}}, {{1.3, 0.0, 0.0}}};
  scene.believed_path = {{{0.0, 0.0, 0.0}, {0.5, 0.2, 0.0}}};
  scene.rocks = {Cube(2.0, 0.3), Cube(60.0, 0.0), Cube(1.0, 0.0)};
  for (math::Vector3& corner : scene.rocks[2].outline_W) corner.x() = 1.0 + 0.01 * corner.y();
  NavigationView view = Sample();
  view.forward.clear();
  view.backward.clear();
  const std::string svg = NavigationSvg({"t", view, scene});
  EXPECT_EQ(CountOf(svg, "<polyline points"), 3) << "pieces of both paths, but for a single place";
  // The rock that is in sight, the map's window, the rover.
  EXPECT_EQ(CountOf(svg, "<polygon"), 3);
  EXPECT_EQ(CountOf(svg, "rgb(70,70,70)"), 1);
  EXPECT_EQ(CountOf(svg, "<title>waypoint"), 2);
  EXPECT_EQ(CountOf(svg, "<title>start"), 1);
  EXPECT_EQ(CountOf(svg, "<title>goal"), 1);
  EXPECT_THAT(svg, core::Says("no camera", "true path"));
}

// From the start to the goal's far side there are 3.5 m, with 0.3 m at each end in a frame of 582
// px: 142.0 px a metre. The goal lies 0.8 m from the right edge, in the middle of 416 px.
TEST(NavigationSvg, TheCourseIsToScale) {
  NavigationView view = Sample();
  const std::string svg = NavigationSvg({"t", view, SampleScene()});
  EXPECT_THAT(svg, core::Says("<circle cx=\"468.4\" cy=\"208.0\"", "r=\"71.0\""));
  // The window of 0.8 m x 0.4 m, 0.1 m further ahead than the map has it: the rover believes itself
  // there. Its left edge is 0.1 m from the start.
  EXPECT_THAT(svg, HasSubstr("<polygon points=\"56.8,"));
}

// Turned to the left, the rover believes the map ahead of it to lie further along y. Of 4.4 m in
// 582 px the corners (0.1, -0.2), (0.1, 0.6) and (-0.3, 0.6) m are these.
TEST(NavigationSvg, TheMapsWindowTurnsWithThePoseThatIsBelieved) {
  NavigationView view = Sample();
  view.estimate = {.x_m = 0.2, .y_m = 0.1, .heading_rad = 0.0, .distance_m = 0.0};
  StepScene scene = SampleScene();
  scene.believed = {0.0, 0.0, 0.5 * std::numbers::pi};
  const std::string window = "<polygon points=\"92.6,274.1 92.6,168.3 39.7,168.3 ";
  EXPECT_THAT(NavigationSvg({"t", view, scene}), HasSubstr(window));
  view.map.x0_m = view.map.y0_m = 0.0;
  view.estimate = {
      .x_m = 0.1, .y_m = 0.6, .heading_rad = -0.5 * std::numbers::pi, .distance_m = 0.0};
  view.map.xstep_m = 0.1;
  view.map.ystep_m = 0.4;
  scene.believed = {0.0, 0.0, 0.0};
  // Ahead is -y in the map: its corner (0, 0) lies 0.6 m ahead and 0.1 m to the right, as W has it.
  EXPECT_THAT(CoursePanel(scene, view, {0.0, 0.0, 582.0, 416.0}),
              HasSubstr("<polygon points=\"148.9,262.1 148.9,208.0 40.6,208.0 "));
}

// 142.0 px a metre: of 0.2 m eight corners show, of 0.04 m four.
TEST(CoursePanel, SmallRocksHaveFourCorners) {
  const auto corners = [](double diameter_m) {
    StepScene scene = SampleScene();
    SceneRock& rock = scene.rocks.emplace_back();
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * std::numbers::pi * (i + 0.5);
      rock.outline_W.push_back({1.5 + 0.5 * diameter_m * std::cos(angle),
                                0.3 + 0.5 * diameter_m * std::sin(angle), 0.0});
    }
    const std::string svg = CoursePanel(scene, Sample(), {0.0, 0.0, 582.0, 416.0});
    const std::size_t end = svg.find("rgb(70,70,70)");
    return CountOf(svg.substr(svg.rfind("points=", end), end - svg.rfind("points=", end)), ",");
  };
  EXPECT_EQ(corners(0.2), 8);
  EXPECT_EQ(corners(0.04), 4);
}

TEST(NavigationSvg, DrawsTheViewWithTheGrid) {
  StepScene scene = SampleScene();
  NavigationView view = Sample();
  const auto cells_drawn = [&] {
    return CountOf(NavigationSvg({"t", view, scene}), "fill-opacity=\"0.55\"");
  };
  EXPECT_EQ(cells_drawn(), 4) << "of the cells that hold points";
  view.map.cells[1].known = false;
  EXPECT_EQ(cells_drawn(), 3) << "the other one has an outline alone";
  EXPECT_EQ(CountOf(NavigationSvg({"t", view, scene}), "fill=\"none\" stroke=\"#777\""), 1);
  // Goodness 255 and 0, as in the map of goodness.
  EXPECT_THAT(NavigationSvg({"t", view, scene}), HasSubstr("fill=\"#fde725\" fill-opacity"));
  EXPECT_THAT(NavigationSvg({"t", view, scene}), HasSubstr("fill=\"#440154\" fill-opacity"));
  // Turned round, the camera has them behind it.
  scene.camera->axis = -scene.camera->axis;
  EXPECT_EQ(cells_drawn(), 0);
}

// In R, as the camera sees it: what counts is where the map lies from the believed pose.
TEST(CameraPanel, TheGridLiesWhereTheRoverBelievesIt) {
  const StepScene scene = SampleScene();
  const SvgFrame frame{0.0, 0.0, 400.0, 400.0};
  NavigationView lower = Sample();
  lower.attitude.z_m = -0.1;
  EXPECT_NE(CameraPanel(scene, lower, frame), CameraPanel(scene, Sample(), frame));
  NavigationView raised = Sample();
  for (messages::MapCellView& cell : raised.map.cells) cell.elevation_m += 0.1;
  EXPECT_EQ(CameraPanel(scene, lower, frame), CameraPanel(scene, raised, frame));
  NavigationView elsewhere = Sample();
  elsewhere.estimate.x_m += 1.0;
  elsewhere.map.x0_m += 1.0;
  EXPECT_EQ(CameraPanel(scene, elsewhere, frame), CameraPanel(scene, Sample(), frame));
  for (double messages::AttitudeEstimate::*angle :
       {&messages::AttitudeEstimate::roll_rad, &messages::AttitudeEstimate::pitch_rad}) {
    NavigationView tilted = Sample();
    tilted.attitude.*angle = 0.2;
    EXPECT_NE(CameraPanel(scene, tilted, frame), CameraPanel(scene, Sample(), frame));
  }
}

// Whatever the rover believes.
TEST(CameraPanel, RocksStandWhereTheyTrulyAre) {
  StepScene scene = SampleScene();
  scene.rocks = {Cube(2.0, 0.2)};
  const SvgFrame frame{0.0, 0.0, 400.0, 400.0};
  const NavigationView nothing_seen;
  const std::string before = CameraPanel(scene, nothing_seen, frame);
  scene.believed.x_m += 1.0;
  EXPECT_EQ(CameraPanel(scene, nothing_seen, frame), before);
  scene.X_WR.translation().x() += 1.0;
  EXPECT_NE(CameraPanel(scene, nothing_seen, frame), before);
  scene.rocks = {Cube(3.0, 0.2)};
  EXPECT_EQ(CameraPanel(scene, nothing_seen, frame), before);
}

// A near rock keeps its outline; a far one, of which a field holds a thousand, takes little room.
TEST(CameraPanel, SmallRocksHaveFewCorners) {
  StepScene scene = SampleScene();
  const auto corners = [&scene](double x_m) {
    SceneRock& rock = scene.rocks.emplace_back();
    for (int i = 0; i < 64; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 64;
      rock.surface_W.push_back({x_m, 0.2 + 0.1 * std::cos(angle), 0.1 + 0.1 * std::sin(angle)});
    }
    const std::string svg = CameraPanel(scene, NavigationView(), {0.0, 0.0, 400.0, 400.0});
    scene.rocks.clear();
    const std::size_t end = svg.find("#c9bfb4");
    return CountOf(svg.substr(svg.rfind("<polygon", end), end - svg.rfind("<polygon", end)), ",");
  };
  EXPECT_EQ(corners(0.4), 64);
  EXPECT_LT(corners(6.0), 16);
  EXPECT_GE(corners(6.0), 4);
}

TEST(NavigationSvg, NearerRocksCoverFartherOnes) {
  StepScene scene = SampleScene();
  scene.rocks = {Cube(1.0, 0.2), Cube(3.0, 0.2), Cube(2.0, 0.2), Cube(-5.0, 0.2), Cube(90.0, 0.2)};
  NavigationView view = Sample();
  const std::string svg = NavigationSvg({"t", view, scene});
  // Silhouettes in the order of drawing: each starts at its left edge, and near ones are wider.
  std::vector<double> left;
  for (std::size_t at = svg.find("#c9bfb4"); at != std::string::npos;
       at = svg.find("#c9bfb4", at + 1)) {
    const std::size_t points = svg.rfind("points=\"", at) + 8;
    left.push_back(std::stod(svg.substr(points)));
  }
  ASSERT_EQ(left.size(), 3u) << "the one behind is left out, and the one that would be a dot";
  EXPECT_GT(left[0], left[1]);
  EXPECT_GT(left[1], left[2]);
}

TEST(NavigationSvg, TheLeftmostTurnStandsLeft) {
  NavigationView view = Sample();
  view.backward.clear();
  const std::string svg = NavigationSvg({"t", view, {}});
  // The only frame stands around the first vote of its block: label and gap before it.
  EXPECT_THAT(svg, HasSubstr("<rect x=\"85.0\""));
}

TEST(NavigationSvg, NothingSeenYet) {
  NavigationView view;
  const std::string svg = NavigationSvg({"empty", view, {}});
  EXPECT_THAT(svg, core::Says("elevation: no data", "empty: nothing"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(NavigationCsv, LeavesUnknownFieldsEmpty) {
  const std::string csv = MapCsv(Sample().map);
  EXPECT_THAT(csv, core::Says("x_m,y_m,elevation_m,goodness,certainty\n0.1,0.1,-0.1,255,255\n",
                              ",0.1,0.3,0,255\n"));
  EXPECT_EQ(CountOf(csv, ",,,\n"), 4);
  const std::string votes = VotesCsv(Sample());
  EXPECT_THAT(votes,
              core::Says("\nforward,2,1,200,255,100,157,1,1\n", "\nbackward,-2,-1,0,0,0,0,0,0\n"));
}

TEST(NavigationCsv, PointsOfACloud) {
  messages::PointCloud cloud;
  cloud.points_R = {{0.5, -0.25, 0.125}};
  EXPECT_EQ(CloudCsv(cloud), "x_m,y_m,z_m\n0.5,-0.25,0.125\n");
}

TEST(ChosenText, NamesTurns) {
  NavigationView view;
  view.point_turns.push_back(
      {.motion = {MotionKind::kTurnInPlace, 0.0, -1}, .merged = 12.0, .chosen = true});
  EXPECT_EQ(ChosenText(view), "turn right (vote 12)");
}

double Luminance(const image_files::Rgb& c) {
  return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
}

TEST(RampColour, GrowsLighterAllTheWayAndClamps) {
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GE(Luminance(RampColour(0.01 * i)), Luminance(RampColour(0.01 * (i - 1)))) << i;
  }
  EXPECT_EQ(RampColour(-3.0), RampColour(0.0));
  EXPECT_EQ(RampColour(3.0), RampColour(1.0));
}

}  // namespace
}  // namespace rockyard::report
