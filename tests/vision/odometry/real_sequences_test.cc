// Motions between real images, where their folder is given (ROCKYARD_REAL_SEQUENCES of CMake, with
// kitti_excerpt_a and euroc_v1_01_pairs): licences keep both out of this repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "math/pose.h"
#include "vision/cameras/camera_model.h"
#include "vision/cameras/rectification.h"
#include "vision/each_pixel.h"
#include "vision/odometry/odometer.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/refine_match.h"
#include "vision/stereo/rectification_table.h"

namespace rockyard::vision {
namespace {

using math::Transform;

// Ten frames of a drive in KITTI's layout (Geiger, Lenz and Urtasun 2012).
struct KittiExcerpt {
  RectifiedPair cameras;
  std::vector<AlignedImages> images;
  std::vector<Transform> X_WC;  // camera: x right, y down, z ahead
};

std::vector<double> NumbersOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::vector<double> numbers;
  for (double number = 0.0; file >> number;) numbers.push_back(number);
  return numbers;
}

GrayImage ReadGray(const std::filesystem::path& path) {
  return image_files::ToGray(image_files::ReadImage(path)).image;
}

KittiExcerpt ReadKittiExcerpt(const std::filesystem::path& folder) {
  KittiExcerpt excerpt;
  const std::vector<double> P = NumbersOf(folder / "calib.txt");  // P0, then P1
  const std::vector<double> poses = NumbersOf(folder / "poses.txt");
  for (std::size_t i = 0; i + 12 <= poses.size(); i += 12) {
    Transform X = Transform::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        X.matrix()(row, column) = poses[i + static_cast<std::size_t>(4 * row + column)];
      }
    }
    X.linear() = Eigen::Quaterniond(X.linear()).normalized().toRotationMatrix();
    excerpt.X_WC.push_back(X);
    const std::string name = "00000" + std::to_string(i / 12) + ".png";
    excerpt.images.push_back(
        {ReadGray(folder / "image_l" / name), ReadGray(folder / "image_r" / name)});
  }
  RectifiedPair& pair = excerpt.cameras;
  pair.focal_px = P[0];
  pair.baseline_m = -P[15] / P[12];
  pair.left.H = {P[0], 0.0, P[2]};
  pair.left.V = {0.0, P[5], P[6]};
  pair.right = pair.left;
  pair.right.C = {pair.baseline_m, 0.0, 0.0};
  pair.size = {excerpt.images[0].left.width(), excerpt.images[0].left.height()};
  return excerpt;
}

const std::filesystem::path kFolder = ROCKYARD_REAL_SEQUENCES;

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

MotionResult MotionBetween(const RectifiedPair& cameras, const AlignedImages& first,
                           const AlignedImages& second) {
  VisualOdometer odometer({}, cameras, {}, {25, 0});
  odometer.Add(first);
  return odometer.Add(second).result;
}

std::vector<double> BaselineErrors_m() {
  const core::JsonValue json = core::LoadJsonFile(kFolder / "kitti_excerpt_a/opencv_baseline.json");
  std::vector<double> errors_m;
  for (const core::JsonValue& pair : json.Find("pairs")->list()) {
    errors_m.push_back(pair.Find("err_translation_m")->number());
  }
  return errors_m;
}

// Whether errors of the way are as small as they should be: 3 cm, and 2 % of the way.
bool IsGood(double error_m, double way_m) { return error_m < std::max(0.03, 0.02 * way_m); }

// Every pair 1 to 3 frames apart, both ways round; those one apart beside OpenCV's. One motion for
// all of them, the mean of one frame to the next, is the negative control.
TEST(KittiTest, EveryPairMovedAsSurveyed) {
  const KittiExcerpt drive = ReadKittiExcerpt(kFolder / "kitti_excerpt_a");
  const auto frames = static_cast<int>(drive.images.size());
  ASSERT_EQ(frames, 10);
  const double mean_m = drive.X_WC[0].inverse().operator*(drive.X_WC[9]).translation().z() / 9.0;
  std::vector<double> of_neighbours_m;
  int good_by_mean = 0, pairs = 0;
  for (int apart = 1; apart <= 3; ++apart) {
    std::vector<double> errors_m, turns_deg;
    for (int first = 0; first < frames; ++first) {
      for (const int second : {first - apart, first + apart}) {
        if (second < 0 || second >= frames) continue;
        const auto i = static_cast<std::size_t>(first);
        const auto j = static_cast<std::size_t>(second);
        const Transform truth = drive.X_WC[i].inverse() * drive.X_WC[j];
        const MotionResult found = MotionBetween(drive.cameras, drive.images[i], drive.images[j]);
        ++pairs;
        ASSERT_TRUE(found.motion) << first << " to " << second << ": "
                                  << static_cast<int>(*found.reason);
        const auto error = ErrorOf(found.motion->X_FS, truth);
        EXPECT_TRUE(IsGood(error.head<3>().norm(), truth.translation().norm()))
            << first << " to " << second << ": " << error.transpose();
        errors_m.push_back(error.head<3>().norm());
        turns_deg.push_back(math::RadToDeg(error.tail<3>().norm()));
        const math::Vector3 by_mean(0.0, 0.0, mean_m);
        good_by_mean += IsGood((truth.translation() - by_mean).norm(), truth.translation().norm());
      }
    }
    if (apart == 1) of_neighbours_m = errors_m;
    RecordProperty("median_mm_" + std::to_string(apart), std::to_string(1e3 * Median(errors_m)));
    RecordProperty("largest_mm_" + std::to_string(apart),
                   std::to_string(1e3 * *std::max_element(errors_m.begin(), errors_m.end())));
    RecordProperty("median_turn_deg_" + std::to_string(apart), std::to_string(Median(turns_deg)));
  }
  EXPECT_EQ(pairs, 48);
  EXPECT_LE(Median(of_neighbours_m), 1.25 * Median(BaselineErrors_m()));
  EXPECT_LT(good_by_mean, pairs / 4);
}

struct Euroc {
  RectifiedPair cameras;
  std::vector<AlignedImages> raw;
  std::vector<AlignedImages> aligned;
  Transform X_01 = Transform::Identity();  // of the body
};

Transform TransformOf(const core::JsonValue& rows) {
  Transform X = Transform::Identity();
  for (int i = 0; i < 16; ++i) {
    X.matrix()(i / 4, i % 4) = rows.list()[static_cast<std::size_t>(i)].number();
  }
  X.linear() = Eigen::Quaterniond(X.linear()).normalized().toRotationMatrix();
  return X;
}

CameraModel EurocCamera(const core::JsonValue& json) {
  const auto number = [&](const char* key, std::size_t i) {
    return json.Find(key)->list()[i].number();
  };
  BrownPinhole camera{TransformOf(*json.Find("T_body_cam")), number("fu_fv_cu_cv", 0),
                      number("fu_fv_cu_cv", 1), number("fu_fv_cu_cv", 2), number("fu_fv_cu_cv", 3)};
  camera.k1 = number("dist", 0);
  camera.k2 = number("dist", 1);
  camera.p1 = number("dist", 2);
  camera.p2 = number("dist", 3);
  return {camera, {752, 480}};
}

GrayImage Align(const GrayImage& image, const CameraModel& real, const Cahv& aligned,
                const ImageSize& size) {
  Image<SourcePosition> positions(size.columns, size.rows, {-10.0, -10.0});
  ForEachPixel(size.columns, size.rows, [&](int x, int y) {
    const auto source = SourceOf(real, aligned, Pixel(x, y));
    if (source) positions.At(x, y) = {source->x(), source->y()};
  });
  return RectificationTable(positions, image.width(), image.height()).Rectify(image);
}

Euroc ReadEuroc() {
  const std::filesystem::path folder = kFolder / "euroc_v1_01_pairs";
  const core::JsonValue json = core::LoadJsonFile(folder / "calib_and_poses.json");
  const CameraModel left = EurocCamera(*json.Find("left"));
  const CameraModel right = EurocCamera(*json.Find("right"));
  Euroc euroc;
  euroc.cameras = *Rectify(left, right);
  std::vector<Transform> X_WB;
  for (const std::string number : {"0", "1"}) {
    euroc.raw.push_back({ReadGray(folder / ("left_" + number + ".png")),
                         ReadGray(folder / ("right_" + number + ".png"))});
    const ImageSize& size = euroc.cameras.size;
    euroc.aligned.push_back({Align(euroc.raw.back().left, left, euroc.cameras.left, size),
                             Align(euroc.raw.back().right, right, euroc.cameras.right, size)});
    const core::JsonValue& pose = *json.Find("world_T_body")->Find(number);
    const auto q = [&](std::size_t i) { return pose.Find("q_wxyz")->list()[i].number(); };
    const auto p = [&](std::size_t i) { return pose.Find("p")->list()[i].number(); };
    Transform X = Transform::Identity();
    X.linear() = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
    X.translation() = math::Vector3(p(0), p(1), p(2));
    X_WB.push_back(X);
  }
  euroc.X_01 = X_WB[0].inverse() * X_WB[1];
  return euroc;
}

// Of features that look alike in both eyes, within forty rows and to the left in the right eye, the
// share that lies within `limit_px` of the same row.
double ShareInRow(const AlignedImages& images, double limit_px, int least) {
  const FeatureDetector detector({}, {images.left.width(), images.left.height()});
  const Features left = detector.Detect(images.left);
  const Features right = detector.Detect(images.right);
  int all = 0, in_row = 0;
  for (const FeatureMatch& match : MatchFeatures(images.left, left, images.right, right, {})) {
    const Feature& l = left[static_cast<std::size_t>(match.first)];
    const Feature& r = right[static_cast<std::size_t>(match.second)];
    if (std::abs(l.row - r.row) > 40 || l.column < r.column || l.column > r.column + 100) continue;
    const WindowTemplate window(images.left, Pixel(l.column, l.row));
    const auto found = window.Find(images.right, Pixel(r.column, r.row), {});
    if (!found) continue;
    ++all;
    in_row += std::abs(found->pixel.y() - l.row) < limit_px ? 1 : 0;
  }
  EXPECT_GT(all, least);
  return static_cast<double>(in_row) / std::max(all, 1);
}

TEST(EurocTest, RectifiedRowsAreEpipolarLines) {
  const Euroc euroc = ReadEuroc();
  for (std::size_t i = 0; i < 2; ++i) {
    const double aligned = ShareInRow(euroc.aligned[i], 1.0, 80);
    const double raw = ShareInRow(euroc.raw[i], 1.0, 20);  // the negative control
    // The rest are matches of other corners.
    EXPECT_GT(aligned, 0.85) << i;
    EXPECT_LT(raw, 0.1) << i;
    RecordProperty("share_" + std::to_string(i), std::to_string(aligned));
    RecordProperty("share_raw_" + std::to_string(i), std::to_string(raw));
  }
}

// 37.5 deg at once, both ways round: right (OpenCV is off by 5.4 cm and 1.85 deg) or not found.
TEST(EurocTest, ALargeTurnIsFoundRightOrNotAtAll) {
  const Euroc euroc = ReadEuroc();
  for (const bool reversed : {false, true}) {
    const auto& first = euroc.aligned[reversed ? 1 : 0];
    const auto& second = euroc.aligned[reversed ? 0 : 1];
    const Transform truth = reversed ? euroc.X_01.inverse() : euroc.X_01;
    const MotionResult found = MotionBetween(euroc.cameras, first, second);
    RecordProperty(
        reversed ? "reason_reversed" : "reason",
        found.reason
            ? std::string(
                  core::EnumNames<NoMotion>::kNames[static_cast<std::size_t>(*found.reason)])
            : "found");
    RecordProperty(reversed ? "counts_reversed" : "counts",
                   std::to_string(found.counts.matches) + " " +
                       std::to_string(found.counts.points) + " " +
                       std::to_string(found.counts.consistent));
    if (!found.motion) continue;
    const auto error = ErrorOf(found.motion->X_FS, truth);
    EXPECT_LT(error.head<3>().norm(), 0.08);
    EXPECT_LT(math::RadToDeg(error.tail<3>().norm()), 2.5);
  }
}

}  // namespace
}  // namespace rockyard::vision
