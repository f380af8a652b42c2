// Paths of rendered sequences against their truth: driven ones, a camera that stands still, the
// rover's own shadow, a scene half of which moves, sand without features, and an early end.
#include "campaign/odometry/estimate_path.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "campaign/odometry/odometry_files.h"
#include "campaign/odometry/pose_text.h"
#include "campaign/odometry/render_sequence.h"
#include "core/error.h"
#include "core/random.h"
#include "core/test_folder.h"
#include "image_files/png_file.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using vision::GrayImage;

constexpr int kColumns = 160;

// Small images by wide cameras near the ground, in which a pixel is 2 cm of it.
SequenceRequest SmallSequence(const fs::path& folder) {
  SequenceRequest request;
  request.scene.scenario = fs::path(ROCKYARD_SOURCE_DIR) / "scenarios/gestalt/abundance.json";
  request.scene.overrides = {"sensors.stereo.columns=160", "sensors.stereo.rows=128",
                             "sensors.stereo.images.pyramid_level=0",
                             "sensors.stereo.max_disparity_px=40"};
  request.scene.out = folder;
  request.pairs = 8;
  request.step_m = 0.1;
  return request;
}

OdometryRequest PathOf(const fs::path& sequence, const fs::path& out) {
  OdometryRequest request;
  request.sequence = sequence;
  request.cameras = sequence / "cameras.json";
  request.truth = sequence / "poses.txt";
  request.out = out;
  return request;
}

std::string ReadText(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

GrayImage ReadGray(const fs::path& path) {
  return image_files::ToGray(image_files::ReadImage(path)).image;
}

void WritePng(const fs::path& path, const GrayImage& image) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << image_files::EncodePng(image);
}

class EstimatedPath : public testing::Test {
 protected:
  // A way of 0.7 m and one of no length, rendered once for all tests.
  static void SetUpTestSuite() {
    shared_ = new core::TestFolder();
    RenderSequence(SmallSequence(Driven()));
    SequenceRequest standing = SmallSequence(Standing());
    standing.step_m = 0.0;
    standing.pairs = 40;
    RenderSequence(standing);
  }
  static void TearDownTestSuite() { delete shared_; }

  static fs::path Driven() { return shared_->path() / "driven"; }
  static fs::path Standing() { return shared_->path() / "standing"; }
  fs::path out() const { return own_.path() / "out"; }
  const fs::path& own() const { return own_.path(); }

  // Pair `number` of the driven way where `driven` holds of a column, else of the standing one.
  template <typename Condition>
  void WriteMixed(const fs::path& folder, std::int64_t number, const Condition& driven) const {
    for (const char* eye : {"left", "right"}) {
      const std::string name = SequenceImageName(number);
      GrayImage image = ReadGray(Standing() / eye / name);
      const GrayImage moved = ReadGray(Driven() / eye / name);
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          if (driven(x)) image.At(x, y) = moved.At(x, y);
        }
      }
      WritePng(folder / eye / name, image);
    }
  }

 private:
  static inline core::TestFolder* shared_ = nullptr;
  core::TestFolder own_;
};

TEST_F(EstimatedPath, ADriveIsFollowed) {
  OdometryRequest request = PathOf(Driven(), out());
  request.lengths_m = {0.3};
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.Gaps(), 0);
  EXPECT_NEAR(result.Distance_m(), 0.7, 0.01);
  ASSERT_TRUE(result.errors);
  EXPECT_EQ(result.errors->pairs, 8);
  EXPECT_LT(result.errors->end_error_m, 0.01 * result.errors->distance_m);
  EXPECT_LT(result.errors->absolute_rigid_m->rms, result.errors->absolute_first_m->rms + 1e-12);
  ASSERT_TRUE(result.errors->segments);
  EXPECT_EQ(result.errors->segments->segments, 4);  // from pairs 0 to 3: to the first beyond 0.3 m
  EXPECT_LT(result.errors->segments->translation, 0.03);
  for (const char* name :
       {"trajectory.csv", "covariance.csv", "times.csv", "trajectory_kitti.txt",
        "trajectory_tum.txt", "errors.csv", "path.svg", "features.png", "vo.json"}) {
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  }
  EXPECT_EQ(result.files.size(), 9u);
  // What is written is what was found.
  const PoseFile kitti = ReadPoses(out() / "trajectory_kitti.txt");
  const PoseFile tum = ReadPoses(out() / "trajectory_tum.txt");
  ASSERT_EQ(kitti.poses.size(), 8u);
  EXPECT_TRUE(kitti.poses[0].isApprox(math::Transform::Identity()));
  EXPECT_TRUE(kitti.poses[7].isApprox(result.steps[7].X_AB, 1e-12));
  EXPECT_TRUE(tum.poses[7].isApprox(result.steps[7].X_AB, 1e-12));
  EXPECT_EQ((*tum.times_s)[7], 7.0);
}

TEST_F(EstimatedPath, ADriveIsFollowedByPlacesFromADisparityMapToo) {
  OdometryRequest request = PathOf(Driven(), out());
  request.settings = {"placement.source=disparity_map"};
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.Gaps(), 0);
  EXPECT_LT(result.errors->end_error_m, 0.01 * result.errors->distance_m);
  EXPECT_NE(result.Distance_m(), EstimatePath(PathOf(Driven(), own() / "eye")).Distance_m());
  // More disparities than dense stereo can search.
  request.settings.emplace_back("placement.max_disparity_px=480");
  EXPECT_THROW(EstimatePath(request), core::UserError);
  request.settings.front() = "placement.source=right_eye";
  EXPECT_NO_THROW(EstimatePath(request));
  request.settings = {"placement.map.window_side_px=8"};
  EXPECT_THROW(EstimatePath(request), core::UserError);
}

TEST_F(EstimatedPath, TheSameImagesGiveTheSamePath) {
  EstimatePath(PathOf(Driven(), out()));
  EstimatePath(PathOf(Driven(), own() / "again"));
  for (const char* name : {"trajectory.csv", "covariance.csv", "features.png", "path.svg"}) {
    EXPECT_EQ(ReadText(out() / name), ReadText(own() / "again" / name)) << name;
  }
}

TEST_F(EstimatedPath, PairsAreChosenAndTruthFollowsThem) {
  OdometryRequest request = PathOf(Driven(), out());
  request.first = 1;
  request.every = 2;
  request.count = 3;
  request.prediction = Prediction::kFile;
  request.predicted = Driven() / "wheels.txt";
  const OdometryResult result = EstimatePath(request);
  ASSERT_EQ(result.steps.size(), 3u);
  EXPECT_EQ(result.Gaps(), 0);
  EXPECT_EQ(result.steps[1].pair, 3);
  EXPECT_EQ(result.steps[1].reference, 1);
  EXPECT_NEAR(result.errors->distance_m, 0.4, 0.01);
  EXPECT_LT(result.errors->end_error_m, 0.01);
  request.first = 7;
  EXPECT_THROW(EstimatePath(request), core::UserError);
}

TEST_F(EstimatedPath, TruthWithTimesBelongsToTheNearestPairs) {
  const PoseFile truth = ReadPoses(Driven() / "poses.txt");
  const std::vector<double> times_s{0.0, 1.01, 2.5, 3.0, 4.0, 5.0, 6.0, 6.99};
  std::ofstream(own() / "tum.txt") << TumPoses(truth.poses, times_s);
  OdometryRequest request = PathOf(Driven(), out());
  request.truth = own() / "tum.txt";
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.errors->pairs, 7);  // nothing lies within 0.02 s of pair 2
  EXPECT_NEAR(result.errors->distance_m, 0.7, 0.01);
  EXPECT_LT(result.errors->end_error_m, 0.01);
}

// Errors of pairs that share nothing, in units of their covariance, do not exceed what it says:
// chi-squared with 6 x 20 degrees of freedom, alpha 1e-6. The negative control holds the same
// motions against a camera that has moved by 2 mm each time.
TEST_F(EstimatedPath, ACameraThatStandsStillErrsAsItsCovarianceSays) {
  OdometryRequest request = PathOf(Standing(), out());
  request.settings = {"keyframe.max_way_m=0"};
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.Gaps(), 0);
  math::Transform moved = math::Transform::Identity();
  moved.translation().x() = 0.002;
  double standing = 0.0;
  double control = 0.0;
  for (std::size_t i = 1; i < result.steps.size(); i += 2) {
    const vision::Motion& motion = *result.steps[i].result.motion;
    standing += vision::NormalizedErrorSquared(motion, math::Transform::Identity());
    control += vision::NormalizedErrorSquared(motion, moved);
  }
  const double most = core::ChiSquaredQuantile(1.0 - 1e-6, 6 * 20);
  EXPECT_LT(standing, most);
  EXPECT_GT(control, most);
}

// Against a keyframe errors do not add up: after forty pairs it is as good as after one.
TEST_F(EstimatedPath, ACameraThatStandsStillDoesNotDrift) {
  const OdometryResult result = EstimatePath(PathOf(Standing(), out()));
  for (const PathStep& step : result.steps) {
    EXPECT_EQ(step.reference, 0);
    EXPECT_LT(step.X_AB.translation().norm(), 0.001);
  }
}

// The rover's shadow lies before it and moves with it.
TEST_F(EstimatedPath, TheRoversOwnShadowIsNotFollowed) {
  SequenceRequest low_sun = SmallSequence(own() / "shadow");
  low_sun.scene.overrides.insert(low_sun.scene.overrides.end(),
                                 {"sensors.sun.elevation_deg=20", "sensors.sun.azimuth_deg=180"});
  RenderSequence(low_sun);
  const OdometryResult result = EstimatePath(PathOf(own() / "shadow", out()));
  EXPECT_EQ(result.Gaps(), 0);
  EXPECT_LT(result.errors->end_error_m, 0.01 * result.errors->distance_m);
}

// A third of the columns moves otherwise: the motion is that of the larger part, whichever that is.
TEST_F(EstimatedPath, TheLargerPartOfAMovingSceneCounts) {
  for (const bool most_driven : {false, true}) {
    const fs::path folder = own() / (most_driven ? "driven" : "standing");
    for (std::int64_t pair = 0; pair < 2; ++pair) {
      WriteMixed(folder, pair,
                 [&](int column) { return (column < kColumns * 2 / 3) == most_driven; });
    }
    OdometryRequest request = PathOf(folder, own() / "path");
    request.cameras = Driven() / "cameras.json";
    request.truth.clear();
    const OdometryResult result = EstimatePath(request);
    ASSERT_EQ(result.Gaps(), 0);
    EXPECT_NEAR(result.Distance_m(), most_driven ? 0.1 : 0.0, 0.005);
  }
}

TEST_F(EstimatedPath, SandWithoutFeaturesHasNoMotionAndSaysSo) {
  GrayImage blank(kColumns, 128, 120);
  for (std::int64_t pair = 0; pair < 3; ++pair) {
    WritePng(own() / "blank/left" / SequenceImageName(pair), blank);
    blank.At(40, 40) = 121;
    WritePng(own() / "blank/right" / SequenceImageName(pair), blank);
  }
  OdometryRequest request = PathOf(own() / "blank", out());
  request.cameras = Driven() / "cameras.json";
  request.truth.clear();
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.Gaps(), 2);
  EXPECT_EQ(*result.steps[2].result.reason, vision::NoMotion::kFewFeatures);
  EXPECT_FALSE(result.steps[2].covariance);
  EXPECT_EQ(result.Distance_m(), 0.0);
  EXPECT_THAT(ReadText(out() / "trajectory.csv"), HasSubstr(",0,few_features,"));
  EXPECT_THAT(ReadText(out() / "covariance.csv"), HasSubstr("\n2,1,,,,"));
}

// The wheels' poses fill the gap.
TEST_F(EstimatedPath, AFileOfPosesFillsGaps) {
  const fs::path folder = own() / "gap";
  fs::copy(Driven(), folder, fs::copy_options::recursive);
  WritePng(folder / "left" / SequenceImageName(4), GrayImage(kColumns, 128, 120));
  OdometryRequest request = PathOf(folder, out());
  request.prediction = Prediction::kFile;
  request.predicted = folder / "wheels.txt";
  const OdometryResult result = EstimatePath(request);
  EXPECT_EQ(result.Gaps(), 2);  // to the blank pair and from it
  EXPECT_LT(result.errors->end_error_m, 0.02);
  EXPECT_TRUE(result.steps[3].covariance);
  EXPECT_FALSE(result.steps[7].covariance);
  request.prediction = Prediction::kNone;
  EXPECT_GT(EstimatePath(request).errors->end_error_m, 0.15);
}

TEST_F(EstimatedPath, AnEarlyEndLeavesAShorterPath) {
  int asked = 0;
  const Stop stop{.wanted = [&] { return ++asked > 3; }};
  const OdometryResult result = EstimatePath(PathOf(Driven(), out()), {}, stop);
  EXPECT_EQ(result.outcome, Outcome::kInterrupted);
  EXPECT_EQ(result.steps.size(), 3u);
  EXPECT_EQ(ReadPoses(out() / "trajectory_kitti.txt").poses.size(), 3u);
  EXPECT_NEAR(result.errors->distance_m, 0.2, 0.01);

  asked = 0;
  const SequenceResult sequence = RenderSequence(SmallSequence(own() / "short"), {}, stop);
  EXPECT_EQ(sequence.outcome, Outcome::kInterrupted);
  EXPECT_EQ(sequence.pairs, 3);
  EXPECT_EQ(ReadPoses(own() / "short/poses.txt").poses.size(), 3u);
  EXPECT_EQ(ReadTimes(own() / "short/times.txt").size(), 3u);
}

// Wherever it is cut off, in the middle of a line too, a path goes on to the same end; a pair that
// nobody can read is a gap on the way.
TEST_F(EstimatedPath, WhatWasCutOffEndsAsIfItHadNotBeen) {
  const fs::path folder = own() / "hurt";
  fs::copy(Driven(), folder, fs::copy_options::recursive);
  fs::resize_file(folder / "right" / SequenceImageName(5), 1000);
  OdometryRequest request = PathOf(folder, out());
  request.settings = {"keyframe.max_way_m=0.25"};
  const OdometryResult whole = EstimatePath(request);
  ASSERT_EQ(whole.steps.size(), 8u);
  EXPECT_EQ(*whole.steps[5].result.reason, vision::NoMotion::kNoImages);
  EXPECT_EQ(whole.Gaps(), 1);
  EXPECT_THAT(whole.notes,
              testing::Contains(AllOf(HasSubstr("images of 1 pairs"), HasSubstr("000005.png"))));
  EXPECT_LT(whole.errors->end_error_m, 0.02);
  const std::string journal = ReadText(out() / "journal.jsonl");
  const std::string maker = ReadText(out() / "made_by.json");
  std::size_t line = 0;
  for (std::size_t pairs = 0; pairs < 8; ++pairs, line = journal.find('\n', line) + 1) {
    request.out = own() / std::to_string(pairs);
    request.existing = ExistingFiles::kResume;
    fs::create_directory(request.out);
    std::ofstream(request.out / "made_by.json") << maker;
    std::ofstream(request.out / "journal.jsonl") << journal.substr(0, line + 100);
    std::vector<std::int64_t> told;
    const OdometryResult rest = EstimatePath(
        request, [&](std::int64_t done, std::int64_t, std::int64_t) { told.push_back(done); });
    EXPECT_EQ(told.size(), 8 - pairs);
    EXPECT_EQ(rest.notes, whole.notes);
    for (const char* name : {"trajectory.csv", "covariance.csv", "errors.csv", "path.svg"}) {
      EXPECT_EQ(ReadText(request.out / name), ReadText(out() / name)) << pairs << " " << name;
    }
  }
  // What no path has: another pair, a reference that was not seen, a reason that there is not.
  const std::string line_0 = journal.substr(0, journal.find('\n') + 1);
  const auto changed = [&](const std::string& from, const std::string& to) {
    const std::size_t at = line_0.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return std::string(line_0).replace(at, from.size(), to);
  };
  for (const std::string& text :
       {std::string("{}\n"), line_0 + line_0, changed("\"reference\":0", "\"reference\":1"),
        changed("\"reference\":0", "\"reference\":-1"),
        changed("\"reason\":null", "\"reason\":8")}) {
    std::ofstream(request.out / "journal.jsonl") << text;
    EXPECT_THROW(EstimatePath(request), core::UserError) << text;
  }
  request.first = 5;
  request.out = own() / "first";
  EXPECT_THROW(EstimatePath(request), core::UserError);  // there is nothing to begin with
  EXPECT_FALSE(fs::exists(request.out));
}

TEST_F(EstimatedPath, ASequenceThatWasCutOffIsCompleted) {
  const fs::path folder = own() / "part";
  int asked = 0;
  RenderSequence(SmallSequence(folder), {}, {.wanted = [&] { return ++asked > 3; }});
  fs::remove(folder / "right" / SequenceImageName(2));
  SequenceRequest request = SmallSequence(folder);
  EXPECT_THROW(RenderSequence(request), core::UserError);
  request.scene.existing = ExistingFiles::kResume;
  const auto kept = fs::last_write_time(folder / "left" / SequenceImageName(1));
  RenderSequence(request);
  EXPECT_EQ(fs::last_write_time(folder / "left" / SequenceImageName(1)), kept);
  for (const auto& entry : fs::recursive_directory_iterator(Driven())) {
    const fs::path name = entry.path().lexically_relative(Driven());
    if (entry.is_directory()) continue;
    EXPECT_EQ(ReadText(folder / name), ReadText(entry.path())) << name;
  }
}

TEST_F(EstimatedPath, RenderedTruthAndWheels) {
  SequenceRequest request = SmallSequence(own() / "slip");
  request.pairs = 3;
  request.slip = 0.2;
  request.period_s = 0.5;
  std::vector<std::int64_t> told;
  RenderSequence(request, [&](std::int64_t done, std::int64_t planned) {
    told.push_back(done);
    EXPECT_EQ(planned, 3);
  });
  EXPECT_THAT(told, testing::ElementsAre(1, 2, 3));
  const auto poses = ReadPoses(own() / "slip/poses.txt").poses;
  const auto wheels = ReadPoses(own() / "slip/wheels.txt").poses;
  EXPECT_NEAR((poses[1].translation() - poses[0].translation()).norm(), 0.1, 0.005);
  EXPECT_TRUE(wheels[0].isApprox(math::Transform::Identity()));
  EXPECT_NEAR((wheels[1].translation() - wheels[0].translation()).norm(), 0.1 / 0.8, 1e-12);
  EXPECT_TRUE((wheels[1].linear() * wheels[2].linear().transpose())
                  .isApprox(poses[0].linear().transpose() * poses[1].linear() *
                                poses[2].linear().transpose() * poses[0].linear(),
                            1e-9));
  EXPECT_THAT(ReadTimes(own() / "slip/times.txt"), testing::ElementsAre(0.0, 0.5, 1.0));
  request.pairs = 500;
  EXPECT_THROW(RenderSequence(request), core::UserError);  // leaves the arena
}

// To the goal around the rocks: no rock as high as the belly is driven over.
TEST_F(EstimatedPath, ARouteLeadsToTheGoal) {
  SequenceRequest request = SmallSequence(own() / "route");
  request.scene.overrides.emplace_back("course.goal_x_m=1.5");
  request.way = SequenceWay::kRoute;
  request.pairs = 50;
  request.step_m = 0.25;
  request.turn_rad = 0.3;
  const SequenceResult result = RenderSequence(request);
  EXPECT_LT(result.pairs, 50);
  const auto poses = ReadPoses(own() / "route/poses.txt").poses;
  EXPECT_NEAR(poses.back().translation().x(), 1.5, 0.01);
  EXPECT_NEAR(poses.back().translation().y(), 0.0, 0.01);
}

}  // namespace
}  // namespace rockyard::campaign
