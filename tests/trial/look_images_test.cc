// Images of looks, from the cameras to a navigator: the bytes and the cameras that on-board stereo
// works with, who gets them, and what they cost.
#include <cmath>
#include <memory>
#include <optional>

#include "core/refusals.h"
#include "sensing/stereo_rig.h"
#include "trial/clock/compute_profile.h"
#include "trial/eyes/stereo_eyes.h"
#include "trial/shipped_trials.h"
#include "trial/sight/stereo_reader.h"
#include "trial/toy_terrain_sensor.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using messages::LookDirection;
using navigation::LookReading;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr core::TrialKey kKey{11, 4};
// Small, and more columns than rows, so that a row that is taken for a column shows.
const Overrides kSmallImages = {"sensors.stereo.fidelity=image", "sensors.stereo.columns=48",
                                "sensors.stereo.rows=40", "sensors.stereo.images.pyramid_level=1",
                                "rover.fidelity=quasi_static"};

// Level ground, as the cameras and the reader of a drive see it from its start.
struct LevelLook {
  LevelLook(const Overrides& overrides, LookDirection direction)
      : drive(Gestalt("abundance", kSmallImages + overrides)),
        cameras(drive, kKey),
        data(StereoEyes(drive, kKey, cameras)
                 .Look({terrain::Ground(), {}, {}}, math::Transform::Identity(), direction, 3)),
        order{.direction = direction, .number = 3},
        images(StereoReader(drive).Images(order, data).value()) {}

  DriveParams drive;
  RoverCameras cameras;
  LookData data;
  LookOrder order;
  messages::LookImages images;
};

struct Place {
  double column = 0.0;
  double row = 0.0;
};

// The equations of messages::LinearCamera.
Place Projected(const messages::LinearCamera& camera, const Vector3& p_R) {
  const Vector3 v = p_R - camera.C_R;
  return {v.dot(camera.H_R) / v.dot(camera.A_R), v.dot(camera.V_R) / v.dot(camera.A_R)};
}

TEST(LookImagesTest, HoldTheBytesThatAreMatched) {
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const LevelLook look({}, direction);
    const auto& taken = std::get<sensing::StereoImages>(look.data);
    EXPECT_EQ(look.images.number, 3);
    EXPECT_EQ(look.images.direction, direction);
    EXPECT_NE(look.images.left.grey, look.images.right.grey);
    const auto hold = [](const messages::LookImage& image, const vision::GrayImage& of) {
      EXPECT_EQ(image.width, 96);
      EXPECT_EQ(image.height, 80);
      ASSERT_EQ(image.grey.size(), of.values().size());
      for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
          ASSERT_EQ(image.At(column, row), of.At(column, row)) << column << " " << row;
        }
      }
    };
    hold(look.images.left, taken.left);
    hold(look.images.right, taken.right);
  }
}

// By hand: eyes 12 cm apart, 0.40 m ahead of R and 0.45 m up, look 45 deg down, so that their axes
// meet the ground 0.85 m ahead. Farther is higher in an image, to the left is nearer its left edge;
// behind, left of the image is the rover's right.
TEST(LookImagesTest, CamerasShowKnownPointsAtTheirPixels) {
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const LevelLook look({}, direction);
    const double side = direction == LookDirection::kAhead ? 1.0 : -1.0;
    const auto shows = [&](const messages::LookImage& image, double eye_m) {
      const Place middle = Projected(image.camera, {side * 0.85, side * eye_m, 0.0});
      EXPECT_NEAR(middle.column, 47.5, 1e-9);
      EXPECT_NEAR(middle.row, 39.5, 1e-9);
      EXPECT_LT(Projected(image.camera, {side * 1.2, side * eye_m, 0.0}).row, 35.0);
      EXPECT_LT(Projected(image.camera, {side * 0.85, side * (eye_m + 0.1), 0.0}).column, 45.0);
      // The edges of the field of view, 110 x 90 deg: half a pixel beyond the outermost centres.
      const Vector3 down = Vector3(side, 0.0, -1.0).normalized();
      const Vector3 right(0.0, -side, 0.0);
      const Vector3 edge = image.camera.C_R + down + std::tan(0.5 * 110.0 * M_PI / 180.0) * right;
      EXPECT_NEAR(Projected(image.camera, edge).column, 95.5, 1e-9);
      EXPECT_NEAR(image.camera.A_R.norm(), 1.0, 1e-12);
    };
    shows(look.images.left, 0.06);
    shows(look.images.right, -0.06);
  }
}

// Mean difference of the greys at which the points are seen in the two images.
double MeanGreyDifference(const messages::LookImages& images, const std::vector<Vector3>& points) {
  double sum = 0.0;
  double count = 0.0;
  const auto grey = [](const messages::LookImage& image, const Vector3& p_R) -> std::optional<int> {
    const Place at = Projected(image.camera, p_R);
    const auto column = static_cast<int>(std::lround(at.column));
    const auto row = static_cast<int>(std::lround(at.row));
    if (column < 0 || column >= image.width || row < 0 || row >= image.height) return {};
    return image.At(column, row);
  };
  for (const Vector3& p_R : points) {
    const auto left = grey(images.left, p_R);
    const auto right = grey(images.right, p_R);
    if (!left || !right) continue;
    sum += std::abs(*left - *right);
    count += 1.0;
  }
  EXPECT_GT(count, 200.0);
  return sum / count;
}

// Points that on-board stereo finds look alike at their places in both images; where the images are
// swapped they do not.
TEST(LookImagesTest, CamerasAndImagesFitThePointsOfStereo) {
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    LevelLook look({}, direction);
    const std::vector<Vector3> points =
        StereoReader(look.drive).Points(look.order, look.data).points_R;
    const double right = MeanGreyDifference(look.images, points);
    std::swap(look.images.left.grey, look.images.right.grey);
    EXPECT_LT(2.0 * right, MeanGreyDifference(look.images, points));
  }
}

// Cameras are believed where the points are: a wrong mount moves both, and no byte.
TEST(LookImagesTest, AWrongMountMovesTheCamerasAsThePoints) {
  const LevelLook right({}, LookDirection::kAhead);
  const LevelLook wrong({"perception.calibration.stereo_front.z_m=0.02",
                         "perception.calibration.stereo_front.pitch_deg=2"},
                        LookDirection::kAhead);
  EXPECT_EQ(wrong.images.left.grey, right.images.left.grey);
  const auto points = [](const LevelLook& look) {
    return StereoReader(look.drive).Points(look.order, look.data).points_R;
  };
  const std::vector<Vector3> here = points(right);
  const std::vector<Vector3> there = points(wrong);
  ASSERT_GT(here.size(), 200U);
  ASSERT_EQ(here.size(), there.size());
  double moved_m = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    for (const auto eye : {&messages::LookImages::left, &messages::LookImages::right}) {
      const Place before = Projected((right.images.*eye).camera, here[i]);
      const Place after = Projected((wrong.images.*eye).camera, there[i]);
      ASSERT_NEAR(before.column, after.column, 1e-6);
      ASSERT_NEAR(before.row, after.row, 1e-6);
    }
    moved_m = std::max(moved_m, (there[i] - here[i]).norm());
  }
  EXPECT_GT(moved_m, 0.02);
}

TEST(LookImagesTest, WithoutCamerasThatTakeImagesThereAreNone) {
  const DriveParams drive = Gestalt("abundance", {"sensors.stereo.fidelity=error_model"});
  EXPECT_FALSE(StereoReader(drive).Images({}, ModelledStereo{}).has_value());
  EXPECT_FALSE(ToyReader().Images({}, messages::PointCloud{}).has_value());
}

struct PhotographerParams {
  LookReading reads = LookReading::kNothing;
  bool images = true;
  bool on_the_move = false;
  struct Seen {
    std::vector<messages::LookImages> images;
    std::vector<messages::PointCloud> clouds;
    std::vector<double> late_s;  // from the look to its answer
    int reports = 0;
  };
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();

  void Visit(core::FieldVisitor&) {}
};

// Looks ahead and behind by turns, three times, and gives up.
class Photographer final : public navigation::Navigator {
 public:
  explicit Photographer(const PhotographerParams& params) : params_(params) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    PhotographerParams::Seen& seen = *params_.seen;
    EXPECT_EQ(input.images != nullptr, input.look != nullptr && params_.images);
    seen.reports += input.report != nullptr ? 1 : 0;
    if (input.cloud != nullptr) seen.clouds.push_back(*input.cloud);
    if (input.images != nullptr) {
      EXPECT_EQ(input.images->number, input.look->number);
      seen.images.push_back(*input.images);
      seen.late_s.push_back(input.time_s - input.look->time_s);
    }
    answers_ += input.look != nullptr ? 1 : 0;
    if (answers_ == 3) return {.status = navigation::NavigatorStatus::kGaveUp};
    return {.look = answers_ == 1 ? LookDirection::kBehind : LookDirection::kAhead,
            .motion = {.kind = messages::MotionKind::kArc},
            .looks_on_the_move = params_.on_the_move};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}

 private:
  PhotographerParams params_;
  int answers_ = 0;
};

DriveParams WithPhotographer(const PhotographerParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<PhotographerParams>(
      {.name = "photographer",
       .doc = "looks and gives up",
       .traits = [](const PhotographerParams& p) -> navigation::NavigatorTraits {
         navigation::NavigatorTraits traits(p.reads, navigation::CostOfLook{0.25},
                                            {"goal_tolerance_m", 0.1});
         traits.images = p.images;
         traits.looks_on_the_move = p.on_the_move;
         return traits;
       },
       .make = [](const PhotographerParams& p, const navigation::NavigatorSetup&)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Photographer>(p); }},
      params);
  const Overrides all =
      kSmallImages + kShortAndEmpty + Overrides{"navigation.navigator=photographer"} + overrides;
  return scenario::Shipped("gestalt/abundance", all, defaults).drive;
}

TEST(NavigatorWithImagesTest, GetsTheImagesOfEachLookBesideWhatItReads) {
  for (const LookReading reads :
       {LookReading::kNothing, LookReading::kPoints, LookReading::kHazardReport}) {
    const PhotographerParams params{.reads = reads};
    const DriveResult result = RunTrial(WithPhotographer(params), kKey);
    EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath) << result.detail;
    EXPECT_EQ(result.record.image_sets, 3.0);
    const PhotographerParams::Seen& seen = *params.seen;
    ASSERT_EQ(seen.images.size(), 3U);
    EXPECT_EQ(seen.images[0].direction, LookDirection::kAhead);
    EXPECT_EQ(seen.images[1].direction, LookDirection::kBehind);
    EXPECT_NE(seen.images[0].left.grey, seen.images[2].left.grey) << "noise of another look";
    EXPECT_EQ(seen.clouds.size(), reads == LookReading::kPoints ? 3U : 0U);
    EXPECT_EQ(seen.reports, reads == LookReading::kHazardReport ? 3 : 0);
  }
}

// Nothing of what else it sees, of its time or of its record depends on the images.
TEST(NavigatorWithImagesTest, SeesTheSamePointsWithThemAndWithout) {
  const Overrides computer = {"clock.compute.computer=sapphire_rapids_core"};
  const PhotographerParams with{.reads = LookReading::kPoints};
  const PhotographerParams without{.reads = LookReading::kPoints, .images = false};
  const DriveResult seen = RunTrial(WithPhotographer(with, computer), kKey);
  const DriveResult unseen = RunTrial(WithPhotographer(without, computer), kKey);
  EXPECT_THAT(Differences(seen, unseen), IsEmpty());
  EXPECT_THAT(without.seen->images, IsEmpty());
  ASSERT_EQ(with.seen->clouds.size(), without.seen->clouds.size());
  for (std::size_t i = 0; i < with.seen->clouds.size(); ++i) {
    EXPECT_EQ(with.seen->clouds[i].points_R, without.seen->clouds[i].points_R);
  }
}

// Who reads images alone pays for taking them, and for what it makes of them itself.
TEST(NavigatorWithImagesTest, PaysForMatchingOnlyWhereItReadsWhatIsMatched) {
  const Overrides computer = {"clock.compute.computer=virtex_5_fpga"};
  const LookTime alone = MakeLookTime(WithPhotographer({}, computer));
  const LookTime points = MakeLookTime(WithPhotographer({.reads = LookReading::kPoints}, computer));
  EXPECT_EQ(alone.imaging_s, points.imaging_s);
  EXPECT_GT(alone.imaging_s, 0.0);
  EXPECT_EQ(alone.computing_s, 0.25);
  EXPECT_GT(points.computing_s, 0.25);
  // One that reads nothing at all gets a report if it looks all the same: as ever.
  const LookTime nothing = MakeLookTime(WithPhotographer({.images = false}, computer));
  EXPECT_EQ(nothing.computing_s, points.computing_s);
}

// The images stay with their look until its answer is ready.
TEST(NavigatorWithImagesTest, GetsThemWithTheAnswerToALookOnTheMove) {
  const PhotographerParams params{.on_the_move = true};
  const DriveParams drive =
      WithPhotographer(params, {"clock.compute.computer=virtex_5_fpga",
                                "clock.overlap.imaging=true", "clock.overlap.computing=true"});
  const DriveResult result = RunTrial(drive, kKey);
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath) << result.detail;
  ASSERT_EQ(params.seen->images.size(), 3U);
  const LookTime time = MakeLookTime(drive);
  for (const double late_s : params.seen->late_s) {
    EXPECT_GE(late_s, time.imaging_s + time.computing_s - 1e-9);
  }
  EXPECT_GT(result.record.true_distance_m, 0.01);
}

TEST(NavigatorWithImagesTest, NeedsCamerasThatTakeImages) {
  const auto problems = [](bool images, const Overrides& overrides) {
    return core::ProblemsIn([&] { WithPhotographer({.images = images}, overrides); });
  };
  const Overrides stripe = {"sensors.terrain_sensor=light_stripe"};
  EXPECT_THAT(problems(true, stripe),
              core::OneProblem("sensors.terrain_sensor", "photographer", "fidelity image"));
  EXPECT_THAT(problems(false, stripe), IsEmpty());
  for (const std::string fidelity : {"ideal", "error_model"}) {
    const Overrides modelled = {"sensors.stereo.fidelity=" + fidelity};
    EXPECT_THAT(problems(true, modelled),
                core::OneProblem("sensors.stereo.fidelity", "takes no images", "use image"));
    EXPECT_THAT(problems(false, modelled), IsEmpty());
  }
  EXPECT_THAT(problems(true, {}), IsEmpty());
}

}  // namespace
}  // namespace rockyard::trial
