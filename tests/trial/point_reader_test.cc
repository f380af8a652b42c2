// A reader of images that no file of rockyard knows reads the looks of a trial, in place of
// on-board stereo; scenarios that name none do not notice that there are readers.
#include "perception/point_reader.h"

#include <memory>

#include "core/refusals.h"
#include "navigation/navigator_fault.h"
#include "scenario/load.h"
#include "trial/shipped_trials.h"
#include "trial/sight/stereo_reader.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using messages::LookDirection;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr core::TrialKey kKey{11, 4};
const Overrides kSmallImages = {"sensors.stereo.fidelity=image", "sensors.stereo.columns=48",
                                "sensors.stereo.rows=40", "sensors.stereo.images.pyramid_level=1",
                                "rover.fidelity=quasi_static"};

struct FlatParams {
  double height_m = 0.0;
  bool fails = false;
  bool fails_to_begin = false;
  struct Seen {
    std::vector<messages::LookImages> images;
    perception::PointReaderSetup setup;
  };
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();

  void Visit(core::FieldVisitor& v) {
    v.Real("height_m", height_m, core::Assumed("of the ground", {}, {-1.0, 1.0}));
    v.Boolean("fails", fails, core::Setting("it fails at a look"));
  }
};

// Takes all that it sees for level ground: each fourth pixel gives the point of its line of sight.
class Flat final : public perception::PointReader {
 public:
  explicit Flat(const FlatParams& params) : params_(params) {}

  std::vector<Vector3> Points(const messages::LookImages& images) const override {
    params_.seen->images.push_back(images);
    if (params_.fails) {
      throw navigation::NavigatorFault(navigation::FaultKind::kThrew, "it saw the Earth");
    }
    const messages::LinearCamera& eye = images.left.camera;
    const double ahead = images.direction == LookDirection::kAhead ? 1.0 : -1.0;
    std::vector<Vector3> points;
    for (int row = 0; row < images.left.height; row += 4) {
      for (int column = 0; column < images.left.width; column += 4) {
        Vector3 ray = (eye.V_R - row * eye.A_R).cross(eye.H_R - column * eye.A_R);
        if (ray.x() * ahead < 0.0) ray = -ray;
        if (ray.z() > -0.1 * ray.norm()) continue;
        points.push_back(eye.C_R + (params_.height_m - eye.C_R.z()) / ray.z() * ray);
      }
    }
    return points;
  }

 private:
  FlatParams params_;
};

perception::PointReaderDescription<FlatParams> DescribeFlat() {
  return {.name = "flat",
          .doc = "level ground",
          .make = [](const FlatParams& p, const perception::PointReaderSetup& setup)
              -> std::unique_ptr<perception::PointReader> {
            if (p.fails_to_begin) {
              throw navigation::NavigatorFault(navigation::FaultKind::kThrew, "it lies asleep");
            }
            p.seen->setup = setup;
            return std::make_unique<Flat>(p);
          }};
}

DriveParams WithFlat(const FlatParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.perception.readers.Add<FlatParams>(DescribeFlat(), params);
  const Overrides all =
      kSmallImages + kShortAndEmpty + Overrides{"perception.reader=flat"} + overrides;
  return scenario::Shipped("gestalt/abundance", all, defaults).drive;
}

sensing::StereoImages Blank() {
  return {vision::GrayImage(96, 80, 7), vision::GrayImage(96, 80, 9), 0.0};
}

// The navigator gets what the reader made of the images that it got.
TEST(AddedReader, MakesTheCloudOfALook) {
  const FlatParams params;
  const DriveParams drive = WithFlat(params, {"perception.flat.height_m=0.25"});
  const StereoReader reader(drive);
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const messages::PointCloud cloud =
        reader.Points({.direction = direction, .number = 5}, Blank());
    EXPECT_EQ(cloud.number, 5);
    EXPECT_EQ(cloud.direction, direction);
    ASSERT_GT(cloud.points_R.size(), 100U);
    for (const Vector3& p : cloud.points_R) {
      EXPECT_NEAR(p.z(), 0.25, 1e-12);
      EXPECT_EQ(p.x() > 0.0, direction == LookDirection::kAhead);
    }
    const messages::LookImages& got = params.seen->images.back();
    EXPECT_EQ(got.number, 5);
    EXPECT_EQ(got.direction, direction);
    EXPECT_EQ(got.left.At(95, 79), 7);
    EXPECT_EQ(got.right.At(95, 79), 9);
  }
  const perception::PointReaderSetup& setup = params.seen->setup;
  EXPECT_EQ(setup.max_range_m, drive.sensors.stereo.max_range_m);
  EXPECT_EQ(setup.rover.length_m, drive.rover.geometry.length_m);
  EXPECT_EQ(setup.look_cpu_s, drive.navigation.limits.decision_cpu_s);
  EXPECT_EQ(setup.drive_cpu_s, drive.navigation.limits.drive_cpu_s);
}

TEST(AddedReader, OnlyTheWindowIsHandedOnWhereItIsAskedFor) {
  const DriveParams drive = WithFlat({}, {"sensors.stereo.field_of_view=stripe"});
  const sensing::StripeWindowParams& window = drive.sensors.stereo.stripe_window;
  const messages::PointCloud cloud = StereoReader(drive).Points({}, Blank());
  EXPECT_THAT(cloud.points_R, testing::Not(IsEmpty()));
  for (const Vector3& p : cloud.points_R) {
    EXPECT_TRUE(p.x() >= window.near_m && p.x() <= window.far_m) << p.x();
  }
}

// On level ground it is right, and takes the rover to its goal; where it believes the ground to
// be a step down, the map says so.
TEST(AddedReader, LeadsARoverOverLevelGround) {
  const FlatParams params;
  const DriveParams drive = WithFlat(params);
  const DriveResult result = RunTrial(drive, kKey);
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(static_cast<double>(params.seen->images.size()), result.record.image_sets);
  EXPECT_THAT(Differences(result, RunTrial(drive, kKey)), IsEmpty());
}

TEST(AddedReader, AFailureEndsTheDriveAsAFaultOfSoftware) {
  for (const bool begins : {true, false}) {
    const DriveResult result = RunTrial(WithFlat({.fails = true, .fails_to_begin = !begins}), kKey);
    EXPECT_EQ(result.outcome, truth::TrialOutcome::kNavigatorFault);
    EXPECT_THAT(result.detail, HasSubstr(begins ? "it saw the Earth" : "it lies asleep"));
  }
}

TEST(AddedReader, NeedsImagesAndSomebodyWhoWantsItsPoints) {
  const auto problems = [](const Overrides& overrides) {
    return core::ProblemsIn([&] { WithFlat({}, overrides); });
  };
  EXPECT_THAT(problems({}), IsEmpty());
  for (const std::string fidelity : {"ideal", "error_model"}) {
    EXPECT_THAT(problems({"sensors.stereo.fidelity=" + fidelity}),
                core::OneProblem("perception.reader", "is flat", "fidelity image"));
  }
  EXPECT_THAT(problems({"sensors.terrain_sensor=light_stripe"}),
              core::OneProblem("perception.reader", "takes no images", "stereo"));
  EXPECT_THAT(problems({"perception.reader=flatt"}),
              core::OneProblem("perception.reader", "flatt", "flat"));
}

// Where stereo itself reads, nothing is new.
TEST(OwnReader, IsThatOfScenariosThatNameNone) {
  const auto load = [](const Overrides& overrides) {
    return scenario::Shipped("gestalt/abundance_images", overrides);
  };
  const scenario::Scenario plain = load({});
  EXPECT_TRUE(plain.drive.perception.readers.chosen().is_own());
  EXPECT_THAT(plain.drive.perception.readers.names(), ElementsAre("stereo"));
  EXPECT_EQ(scenario::Fingerprint(plain),
            scenario::Fingerprint(load({"perception.reader=stereo"})));
}

TEST(OwnReader, NamesOfOtherGroupsAreTaken) {
  perception::PointReaderSet set;
  for (const char* name : {"stereo", "hazard", "calibration", "visual_odometry"}) {
    auto description = DescribeFlat();
    description.name = name;
    EXPECT_THROW(set.Add(description), core::UserError) << name;
  }
  set.Add(DescribeFlat());
  EXPECT_THAT(set.names(), ElementsAre("stereo", "flat"));
}

}  // namespace
}  // namespace rockyard::trial
