// Aligned pairs: rows, overlap, tables, and what is refused.
#include "vision/cameras/rectification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numbers.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

const Cahv kPlainLens{{0, 0, 0}, {0, 0, 1}, {300, 0, 160}, {0, 300, 90}};

// A pair of cameras of one kind, the right one 0.2 m along the rows of the left one, somewhat ahead
// of it, and turned.
CameraModel RightOf(const CameraModel& left) {
  Transform X_LM = Transform::Identity();
  X_LM.linear() =
      (Eigen::AngleAxisd(0.02, Vector3::UnitY()) * Eigen::AngleAxisd(-0.03, Vector3::UnitX()) *
       Eigen::AngleAxisd(0.04, Vector3::UnitZ()))
          .toRotationMatrix();
  X_LM.translation() = Vector3(0.2, -0.015, 0.01);
  return Moved(TestPose() * X_LM * TestPose().inverse(), left);
}

// Where an aligned camera has what the real one sees at p_A, by the real one's ray.
std::optional<Pixel> AlignedPixel(const CameraModel& real, const Cahv& aligned,
                                  const Vector3& p_A) {
  const auto raw = Project(real, p_A);
  if (!raw || !IsInside(real.size, *raw)) return std::nullopt;
  const auto ray = BackProject(real, *raw);
  if (!ray) return std::nullopt;
  return Project(aligned, aligned.C + ray->direction);
}

// Two cameras of a lens that look along z, 0.1 m apart.
template <typename Lens>
std::pair<CameraModel, CameraModel> ParallelPair(const Lens& lens, const ImageSize& size) {
  const Transform X_LR(Eigen::Translation3d(0.1, 0.0, 0.0));
  return {CameraModel{lens, size}, CameraModel{Moved(X_LR, lens), size}};
}

Cahvore Fisheye(double focal_px, double middle_px) {
  const Cahv lens{{0, 0, 0}, {0, 0, 1}, {focal_px, 0, middle_px}, {0, focal_px, middle_px}};
  return {lens, Vector3::UnitZ(), Vector3::Zero(), Vector3::Zero(), CahvoreType::kFisheye, 1.0};
}

struct Residual {
  double row_px = 0.0;
  double table_px = 0.0;
  int points = 0;
};

// Over a grid of points that the aligned left image shows, at depths from nearest_m to 80 times it.
Residual ResidualOf(const CameraModel& left, const CameraModel& right, const RectifiedPair& pair,
                    double nearest_m) {
  Residual residual;
  for (int i = 0; i <= 12; ++i) {
    for (int j = 0; j <= 12; ++j) {
      const Pixel pixel(i * (pair.size.columns - 1) / 12.0, j * (pair.size.rows - 1) / 12.0);
      const auto ray = BackProject(pair.left, pixel);
      for (const double range : {1.0, 2.0, 8.0, 80.0}) {
        const Vector3 p_A = pair.left.C + range * nearest_m * ray->direction;
        const auto in_left = AlignedPixel(left, pair.left, p_A);
        const auto in_right = AlignedPixel(right, pair.right, p_A);
        if (!in_left || !in_right) continue;
        ++residual.points;
        residual.row_px = std::max(residual.row_px, std::fabs(in_left->y() - in_right->y()));
        const auto source = SourceOf(left, pair.left, pixel, range * nearest_m);
        EXPECT_TRUE(source);
        if (!source) continue;
        residual.table_px = std::max(residual.table_px, (*source - *Project(left, p_A)).norm());
      }
    }
  }
  return residual;
}

// Whether all lines of sight meet in one point.
bool IsCentral(const CameraModel& camera) {
  const auto* cahvore = std::get_if<Cahvore>(&camera.lens);
  return cahvore == nullptr || cahvore->E == Vector3::Zero();
}

TEST(RectificationTest, RowsAreEpipolarLinesOfEveryModel) {
  std::vector<NamedCamera> cameras = ModelCameras();
  for (NamedCamera named : ModelCameras()) {
    if (IsCentral(named.camera)) continue;
    std::get<Cahvore>(named.camera.lens).E.setZero();
    named.name += " without a moving pupil";
    cameras.push_back(named);
  }
  for (const NamedCamera& named : cameras) {
    const CameraModel right = RightOf(named.camera);
    // A pupil that moves by millimetres needs distance: no table holds for all ranges.
    const double nearest_m = IsCentral(named.camera) ? 0.5 : 100.0;
    for (const RectifiedField field : {RectifiedField::kOverlap, RectifiedField::kLeft}) {
      const auto pair = Rectify(named.camera, right, {.field = field});
      ASSERT_TRUE(pair.ok()) << named.name << pair.problems().front().reason;
      EXPECT_NEAR(pair->baseline_m, std::sqrt(0.04 + 0.015 * 0.015 + 1e-4), 1e-12);
      const Residual residual = ResidualOf(named.camera, right, *pair, nearest_m);
      EXPECT_GT(residual.points, 120) << named.name;
      EXPECT_LT(residual.row_px, IsCentral(named.camera) ? 1e-6 : 0.01) << named.name;
      EXPECT_LT(residual.table_px, 1e-6) << named.name;
      // At its own range a table holds nearby as well.
      EXPECT_LT(ResidualOf(named.camera, right, *pair, 0.4).table_px, 1e-6) << named.name;
    }
  }
}

TEST(RectificationTest, RowsAreEpipolarLinesOfFlightPairs) {
  struct Case {
    const char* left;
    const char* right;
    double nearest_m;  // pupils that move by millimetres, at f = 2800 px, ask for kilometres
  };
  const Case cases[] = {
      {"MER2_NAVCAM_LEFT_sol767", "MER2_NAVCAM_RIGHT_sol767", 1.0},
      {"M2020_HAZFLA", "M2020_HAZFRA", 5000.0},
      {"M2020_HAZFLB", "M2020_HAZFRB", 5000.0},
  };
  for (const Case& test : cases) {
    const CameraModel left = FlightCamera(test.left);
    const CameraModel right = FlightCamera(test.right);
    const auto pair = Rectify(left, right, {.largest_angle_rad = 1.1});
    ASSERT_TRUE(pair.ok()) << test.left << pair.problems().front().reason;
    const Residual residual = ResidualOf(left, right, *pair, test.nearest_m);
    EXPECT_GT(residual.points, 200) << test.left;
    EXPECT_LT(residual.row_px, 0.01) << test.left;
    EXPECT_LT(residual.table_px, 1e-4) << test.left;
  }
}

TEST(RectificationTest, TheBaselineOfTheMerNavcamsIsThePublishedOne) {
  const auto pair =
      Rectify(FlightCamera("MER2_NAVCAM_LEFT_sol767"), FlightCamera("MER2_NAVCAM_RIGHT_sol767"));
  ASSERT_TRUE(pair.ok());
  const core::JsonValue data = LoadCameraData("published_geometry.json");
  EXPECT_NEAR(pair->baseline_m, data.Find("mer_baseline_m")->number(), 1e-12);
  // Resolution and field are those of the images: 1024 x 1024 pixels over 45 deg.
  EXPECT_NEAR(pair->focal_px, 512.0 / std::tan(math::DegToRad(22.5)), 30.0);
  EXPECT_NEAR(pair->size.columns, 1024, 120);
  EXPECT_NEAR(pair->size.rows, 1024, 120);
}

TEST(RectificationTest, TheCamerasShareAllButTheirCentres) {
  const CameraModel left = ModelCameras()[1].camera;
  const CameraModel right = RightOf(left);
  const auto pair = Rectify(left, right);
  ASSERT_TRUE(pair.ok());
  EXPECT_EQ(pair->left.A, pair->right.A);
  EXPECT_EQ(pair->left.H, pair->right.H);
  EXPECT_EQ(pair->left.V, pair->right.V);
  EXPECT_EQ(pair->left.C, CentreOf(left));
  EXPECT_EQ(pair->right.C, CentreOf(right));
  const Vector3 h = (pair->left.H - pair->left.H.dot(pair->left.A) * pair->left.A);
  const Vector3 v = (pair->left.V - pair->left.V.dot(pair->left.A) * pair->left.A);
  EXPECT_NEAR(h.norm(), pair->focal_px, 1e-9);
  EXPECT_NEAR(v.norm(), pair->focal_px, 1e-9);
  EXPECT_LT(h.normalized().cross((pair->right.C - pair->left.C).normalized()).norm(), 1e-12);
  EXPECT_GT(h.cross(v).dot(pair->left.A), 0.0);
  // The images keep the resolution of 300 to 310 px that the real ones have, 305 in the mean, but
  // for the distortion in the middle.
  EXPECT_NEAR(pair->focal_px, 305.0, 3.0);
}

// Two parallel linear cameras are aligned as they are: nothing but the origin of pixels changes.
TEST(RectificationTest, AnAlignedPairStaysAsItIs) {
  const auto [left, right] = ParallelPair(kPlainLens, {321, 181});
  const auto pair = Rectify(left, right);
  ASSERT_TRUE(pair.ok());
  EXPECT_NEAR(pair->focal_px, 300.0, 1e-9);
  EXPECT_NEAR(pair->size.columns, 321, 1);
  EXPECT_NEAR(pair->size.rows, 181, 1);
  for (int column = 2; column < 320; column += 50) {
    const auto source = SourceOf(left, pair->left, Pixel(column, 60));
    ASSERT_TRUE(source);
    EXPECT_NEAR(source->x(), column, 0.51);
    EXPECT_NEAR(source->y(), 60, 0.51);
  }
}

TEST(RectificationTest, TheOverlapIsWhatBothSee) {
  // The right one looks 0.2 rad further to the right. The left one sees slopes from -0.5 to 0.5.
  const Cahv lens{{0, 0, 0}, {0, 0, 1}, {300, 0, 150}, {0, 300, 90}};
  const ImageSize size{301, 181};
  Transform X_LR = Transform::Identity();
  X_LR.linear() = Eigen::AngleAxisd(0.2, Vector3::UnitY()).toRotationMatrix();
  X_LR.translation() = Vector3(0.1, 0, 0);
  const CameraModel left{lens, size};
  const CameraModel right{Moved(X_LR, lens), size};
  const auto overlap = Rectify(left, right);
  const auto whole = Rectify(left, right, {.field = RectifiedField::kLeft});
  ASSERT_TRUE(overlap.ok() && whole.ok());
  // A', square to the baseline, is the left axis.
  const double right_begins = std::tan(0.2 - std::atan(0.5));
  EXPECT_NEAR(overlap->size.columns - 1, overlap->focal_px * (0.5 - right_begins), 2.0);
  EXPECT_NEAR(whole->size.columns - 1, whole->focal_px, 2.0);
  EXPECT_EQ(overlap->focal_px, whole->focal_px);
  // In the middle row the left image's edges are the edges of its own field.
  const auto slope = [](const RectifiedPair& pair, double column) {
    const auto ray = BackProject(pair.left, {column, MiddleOf(pair.size).y()});
    return std::atan2(ray->direction.x(), ray->direction.z());
  };
  EXPECT_NEAR(slope(*whole, 0), std::atan(-0.5), 0.01);
  EXPECT_NEAR(slope(*overlap, 0), std::atan(-0.5) + 0.2, 0.01);
  EXPECT_NEAR(slope(*overlap, overlap->size.columns - 1), std::atan(0.5), 0.01);
}

TEST(RectificationTest, ASizeHoldsTheWholeFieldInItsMiddle) {
  const CameraModel left = ModelCameras()[1].camera;
  const CameraModel right = RightOf(left);
  const auto natural = Rectify(left, right);
  const auto sized = Rectify(left, right, {.size = {256, 256}});
  ASSERT_TRUE(natural.ok() && sized.ok());
  EXPECT_EQ(sized->size, (ImageSize{256, 256}));
  // The wider side decides.
  EXPECT_NEAR(sized->focal_px / natural->focal_px, 255.0 / (natural->size.columns - 1), 0.002);
  const auto middle = BackProject(sized->left, MiddleOf(sized->size));
  const auto same = BackProject(natural->left, MiddleOf(natural->size));
  EXPECT_LT((middle->direction - same->direction).norm(), 1e-9);
  const auto chosen = Rectify(left, right, {.focal_px = 100.0});
  ASSERT_TRUE(chosen.ok());
  EXPECT_EQ(chosen->focal_px, 100.0);
  EXPECT_NEAR(chosen->size.columns, natural->size.columns * 100.0 / natural->focal_px, 2.0);
}

TEST(RectificationTest, AFisheyesFieldEndsAtTheLargestAngle) {
  const auto [left, right] = ParallelPair(Fisheye(100, 160), {321, 321});
  const auto pair = Rectify(left, right, {.largest_angle_rad = 1.0});
  ASSERT_TRUE(pair.ok());
  EXPECT_NEAR(pair->size.columns, 2.0 * 100.0 * std::tan(1.0), 2.0);
  EXPECT_NEAR(pair->size.rows, 2.0 * 100.0 * std::tan(1.0), 2.0);
}

// Of a lens that sees around itself few rays lie before the plane at all.
TEST(RectificationTest, AFieldBeyondARightAngleIsKeptToTheLargestAngleToo) {
  const auto [left, right] = ParallelPair(Fisheye(45, 157), {315, 315});
  const auto pair = Rectify(left, right, {.largest_angle_rad = 1.2});
  ASSERT_TRUE(pair.ok());
  EXPECT_NEAR(pair->size.columns, 2.0 * 45.0 * std::tan(1.2), 2.0);
}

TEST(RectificationTest, SourcesAreInsideOfTheImageOrNowhere) {
  const CameraModel left = ModelCameras()[1].camera;
  const auto pair = Rectify(left, RightOf(left), {.field = RectifiedField::kLeft});
  ASSERT_TRUE(pair.ok());
  int outside = 0, inside = 0;
  for (int column = -20; column < pair->size.columns + 20; column += 5) {
    for (int row = -20; row < pair->size.rows + 20; row += 5) {
      const auto source = SourceOf(left, pair->left, Pixel(column, row));
      outside += source ? 0 : 1;
      inside += source ? 1 : 0;
      EXPECT_TRUE(!source || IsInside(left.size, *source));
    }
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(inside, 1000);
  EXPECT_FALSE(SourceOf(left, pair->left, {100, 100}, -1.0));
  EXPECT_FALSE(SourceOf(left, pair->left, {100, 100}, core::kNaN));
}

TEST(RectificationTest, NoTableHoldsBehindTheCamera) {
  // A fisheye that sees what is behind it, too.
  const Cahvore fisheye = Fisheye(300, 1000);
  const CameraModel real{fisheye, {2001, 2001}};
  EXPECT_TRUE(SourceOf(real, fisheye.linear, {1300, 1000}, 2.0));
  EXPECT_FALSE(SourceOf(real, fisheye.linear, {1300, 1000}, -2.0));
}

// A moving pupil: points elsewhere than at the range of the table are off as the header says.
TEST(RectificationTest, ATableOfAMovingPupilHoldsAtItsRange) {
  Cahvore moving = Fisheye(300, 320);
  moving.E = Vector3(0.01, 0.0, 0.0);
  const Cahv& lens = moving.linear;
  const CameraModel real{moving, {641, 641}};
  const double theta = 0.9;
  const Vector3 direction(std::sin(theta), 0, std::cos(theta));
  const auto aligned_pixel = Project(lens, direction);
  const Vector3 p_A = 2.0 * direction;
  const auto at_range = SourceOf(real, lens, *aligned_pixel, 2.0);
  const auto far = SourceOf(real, lens, *aligned_pixel);
  ASSERT_TRUE(at_range && far);
  EXPECT_LT((*at_range - *Project(real, p_A)).norm(), 1e-9);
  const double s_m = (theta / std::sin(theta) - 1.0) * 0.01;
  const double expected_px = 300.0 * s_m * std::sin(theta) / 2.0;
  EXPECT_NEAR((*far - *at_range).norm(), expected_px, 0.05 * expected_px);
}

std::string RefusalOf(const CameraModel& left, const CameraModel& right,
                      const RectificationOptions& options = {}) {
  const auto pair = Rectify(left, right, options);
  if (pair.ok()) return "accepted";
  return pair.problems().front().path + " " + pair.problems().front().reason;
}

TEST(RectificationTest, SingularPairsAreRefusedWithTheReason) {
  const CameraModel left{kPlainLens, {321, 181}};
  const auto moved = [&](const Vector3& shift, const Eigen::AngleAxisd& turn) {
    Transform X_LR = Transform::Identity();
    X_LR.linear() = turn.toRotationMatrix();
    X_LR.translation() = shift;
    return Moved(X_LR, left);
  };
  const Eigen::AngleAxisd none(0.0, Vector3::UnitX());
  EXPECT_EQ(RefusalOf(left, moved({0.1, 0, 0}, none)), "accepted");
  EXPECT_EQ(RefusalOf(left, left), "baseline is 0 m long");
  EXPECT_EQ(RefusalOf(left, moved({0.01, 0, 0.1}, none)),
            "baseline is 5.7 deg from the direction in which the cameras look");
  EXPECT_EQ(RefusalOf(left, moved({0.01, 0, -0.1}, none)),
            "baseline is 5.7 deg from the direction in which the cameras look");
  EXPECT_EQ(RefusalOf(left, moved({-0.1, 0.02, 0}, none)),
            "baseline leads to the left: the eyes are swapped");
  EXPECT_EQ(RefusalOf(left, moved({0, 0.1, 0}, none)),
            "baseline is 90 deg from the rows of the images");
  EXPECT_EQ(RefusalOf(left, moved({0.1, 0, 0}, Eigen::AngleAxisd(2.0, Vector3::UnitY()))),
            "right looks 115 deg away from where the left one looks");
  // The left one sees up to 28 deg, the right one begins at 60 - 28 deg.
  EXPECT_EQ(RefusalOf(left, moved({0.1, 0, 0},
                                  Eigen::AngleAxisd(math::DegToRad(60.0), Vector3::UnitY()))),
            "field is empty: the cameras see nothing in common");
  // Just about nothing in common.
  const double edge_rad = 2.0 * std::atan(160.0 / 300.0) - 0.002;
  EXPECT_EQ(RefusalOf(left, moved({0.1, 0, 0}, Eigen::AngleAxisd(edge_rad, Vector3::UnitY()))),
            "field is less than 2 pixels wide or high");

  Cahv bad = kPlainLens;
  bad.C.x() = core::kNaN;
  EXPECT_EQ(RefusalOf({bad, left.size}, left), "left sees nothing in the middle of its image");
  bad = kPlainLens;
  bad.V.y() = core::kInfinity;
  EXPECT_EQ(RefusalOf(left, {bad, left.size}), "right sees nothing in the middle of its image");
  bad = kPlainLens;
  bad.H = bad.V;
  EXPECT_EQ(RefusalOf(left, {bad, left.size}), "right sees nothing in the middle of its image");
  bad = kPlainLens;
  bad.H.x() = -bad.H.x();
  EXPECT_EQ(RefusalOf({bad, left.size}, left), "left shows a mirror image");
  EXPECT_EQ(RefusalOf(left, {kPlainLens, {0, 5}}), "right has no pixels");
}

TEST(RectificationTest, OptionsBeyondReasonAreRefused) {
  const auto [left, right] = ParallelPair(kPlainLens, {321, 181});
  EXPECT_EQ(RefusalOf(left, right, {.focal_px = 20000.0}), "size would be 21333 x 12000 pixels");
  EXPECT_EQ(RefusalOf(left, right, {.focal_px = -1.0}), "focal_px is -1");
  EXPECT_EQ(RefusalOf(left, right, {.focal_px = core::kNaN}), "focal_px is nan");
  EXPECT_EQ(RefusalOf(left, right, {.size = {20000, 10}}), "size is 20000 x 10 pixels");
  EXPECT_EQ(RefusalOf(left, right, {.size = {10, 0}}), "size is 10 x 0 pixels");
  EXPECT_EQ(RefusalOf(left, right, {.size = {-10, -10}}), "size is -10 x -10 pixels");
  EXPECT_EQ(RefusalOf(left, right, {.largest_angle_rad = 1.6}), "largest_angle_rad is 1.6");
  EXPECT_EQ(RefusalOf(left, right, {.largest_angle_rad = 0.0}), "largest_angle_rad is 0");
}

}  // namespace
}  // namespace rockyard::vision
