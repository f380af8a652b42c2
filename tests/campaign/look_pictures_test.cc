// Pictures of a look against places worked out by hand.
#include "campaign/looks/look_pictures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "image_files/png_file.h"
#include "report/xml_text.h"

namespace rockyard::campaign {
namespace {

using image_files::Picture;
using image_files::Rgb;
using math::Vector3;
using messages::LookDirection;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Rgb kRed{255, 0, 0};
constexpr double kFocal_px = 50.0;
constexpr int kSide_px = 64;
constexpr double kMiddle_px = 0.5 * (kSide_px - 1);

// Level cameras 0.5 m high that look along +x, 0.1 m apart.
vision::RectifiedPair LevelPair() {
  const Vector3 forward = Vector3::UnitX();
  const vision::Cahv left{Vector3(0.0, 0.05, 0.5), forward,
                          kFocal_px * Vector3(0.0, -1.0, 0.0) + kMiddle_px * forward,
                          kFocal_px * Vector3(0.0, 0.0, -1.0) + kMiddle_px * forward};
  vision::RectifiedPair pair{left, left, {kSide_px, kSide_px}, kFocal_px, 0.1};
  pair.right.C.y() = -0.05;
  return pair;
}

// Where that left camera images a point, in pixels of the picture enlarged by 8.
vision::Pixel Place(const Vector3& p_R) {
  const double depth_m = p_R.x();
  const double column = kMiddle_px - kFocal_px * (p_R.y() - 0.05) / depth_m;
  const double row = kMiddle_px - kFocal_px * (p_R.z() - 0.5) / depth_m;
  return {8.0 * (column + 0.5) - 0.5, 8.0 * (row + 0.5) - 0.5};
}

CapturedLook LookOf(std::int64_t number, LookDirection direction) {
  CapturedLook look;
  look.pair = LevelPair();
  look.sight.left = vision::GrayImage(kSide_px, kSide_px, 40);
  look.sight.disparities =
      vision::DisparityImage(kSide_px, kSide_px, vision::Dropped(vision::Drop::kPeak));
  look.matching.correlator.min_disparity_px = 0;
  look.matching.correlator.disparities = 11;
  look.cloud.number = number;
  look.cloud.direction = direction;
  return look;
}

// Pixels of a colour, and the smallest rectangle around them.
struct Patch {
  int pixels = 0;
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
};

Patch PatchOf(const Picture& picture, const Rgb& colour) {
  Patch patch;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture.At(x, y) != colour) continue;
      ++patch.pixels;
      patch.left = std::min(patch.left, x);
      patch.right = std::max(patch.right, x);
      patch.top = std::min(patch.top, y);
      patch.bottom = std::max(patch.bottom, y);
    }
  }
  return patch;
}

std::vector<std::int64_t> Numbers(const std::vector<CapturedLook>& looks) {
  std::vector<std::int64_t> numbers;
  for (const CapturedLook& look : looks) numbers.push_back(look.cloud.number);
  return numbers;
}

TEST(LookMemoryTest, ADecisionRestsOnItsLookAndTheOneAheadBeforeOneBehind) {
  LookMemory memory;
  memory.Add(LookOf(0, LookDirection::kAhead));
  EXPECT_THAT(Numbers(memory.LooksOf({0, LookDirection::kAhead, {}})), ElementsAre(0));
  EXPECT_THAT(Numbers(memory.LooksOf({0, LookDirection::kAhead, {}})), IsEmpty());
  for (const std::int64_t number : {1, 2}) memory.Add(LookOf(number, LookDirection::kAhead));
  memory.Add(LookOf(3, LookDirection::kBehind));
  EXPECT_THAT(Numbers(memory.LooksOf({3, LookDirection::kBehind, {}})), ElementsAre(2, 3));
  // One that was not waited for, and one that is still under way.
  for (const std::int64_t number : {4, 5, 6}) memory.Add(LookOf(number, LookDirection::kAhead));
  EXPECT_THAT(Numbers(memory.LooksOf({5, LookDirection::kAhead, {}})), ElementsAre(5));
  EXPECT_THAT(Numbers(memory.LooksOf({6, LookDirection::kAhead, {}})), ElementsAre(6));
}

TEST(PictureLinesTest, ALineIsDrawnWithinThePicture) {
  const auto drawn = [](const vision::Pixel& from, const vision::Pixel& to) {
    Picture picture(10, 8);
    DrawLine({from, to}, kRed, 1, picture);
    return picture;
  };
  const Picture level = drawn({-5.0, 3.0}, {20.0, 3.0});
  EXPECT_EQ(PatchOf(level, kRed).pixels, 10);
  EXPECT_EQ(PatchOf(level, kRed).top, 3);
  EXPECT_EQ(PatchOf(level, kRed).bottom, 3);
  const Picture upright = drawn({9.0, 100.0}, {9.0, 2.0});
  EXPECT_EQ(PatchOf(upright, kRed).pixels, 6);
  EXPECT_EQ(PatchOf(upright, kRed).left, 9);
  const Picture diagonal = drawn({0.0, 0.0}, {7.0, 7.0});
  EXPECT_EQ(PatchOf(diagonal, kRed).pixels, 8);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(diagonal.At(i, i), kRed);
  EXPECT_EQ(PatchOf(drawn({2.0, 3.0}, {2.0, 3.0}), kRed).pixels, 1);
  Picture wide(10, 8);
  DrawLine({{0.0, 7.0}, {9.0, 7.0}}, kRed, 2, wide);
  EXPECT_EQ(PatchOf(wide, kRed).pixels, 10);
  DrawLine({{9.0, 2.0}, {4.0, 2.0}}, kRed, 2, wide);
  EXPECT_EQ(PatchOf(wide, kRed).pixels, 10 + 2 * 6);
  EXPECT_EQ(wide.At(4, 3), kRed);
  // Past the edges, and past a corner.
  EXPECT_EQ(PatchOf(drawn({-1.0, 0.0}, {-1.0, 7.0}), kRed).pixels, 0);
  EXPECT_EQ(PatchOf(drawn({10.0, 0.0}, {30.0, 7.0}), kRed).pixels, 0);
  EXPECT_EQ(PatchOf(drawn({-6.0, 4.0}, {4.0, -6.0}), kRed).pixels, 0);
}

TEST(PictureLinesTest, WhatIsBehindTheCameraIsCutOff) {
  for (const double camera_x_m : {0.0, 2.5}) {
    vision::Cahv camera = LevelPair().left;
    camera.C.x() = camera_x_m;
    const auto seen = [&](Vector3 from, Vector3 to) {
      from.x() += camera_x_m;
      to.x() += camera_x_m;
      return ImageOfLine(camera, from, to);
    };
    const Vector3 ahead(2.0, 0.05, 0.5);
    const auto whole = seen(ahead, Vector3(4.0, 1.05, 0.5));
    ASSERT_TRUE(whole);
    EXPECT_NEAR(whole->first.x(), kMiddle_px, 1e-12);
    EXPECT_NEAR(whole->second.x(), kMiddle_px - kFocal_px / 4.0, 1e-12);
    // From 2 m ahead to 2 m behind: it is cut 0.05 m ahead, where it is 0.4875 m to the left.
    const Vector3 behind(-2.0, 1.05, 0.5);
    for (const auto& cut : {seen(ahead, behind), seen(behind, ahead)}) {
      ASSERT_TRUE(cut);
      EXPECT_NEAR(std::min(cut->first.x(), cut->second.x()), kMiddle_px - kFocal_px * 0.4875 / 0.05,
                  1e-9);
      EXPECT_NEAR(std::max(cut->first.x(), cut->second.x()), kMiddle_px, 1e-12);
    }
    EXPECT_FALSE(seen(behind, Vector3(-3.0, 0.0, 0.0)));
    EXPECT_FALSE(seen(behind, Vector3(0.04, 0.0, 0.0)));
  }
}

TEST(PictureLinesTest, EnlargedPixelsAreSquares) {
  Picture picture(2, 1);
  picture.At(1, 0) = kRed;
  const Patch patch = PatchOf(Enlarged(picture, 3), kRed);
  EXPECT_EQ(patch.pixels, 9);
  EXPECT_EQ(patch.left, 3);
  EXPECT_EQ(patch.bottom, 2);
  EXPECT_EQ(FactorToSee(128, 100), 4);
  EXPECT_EQ(FactorToSee(100, 128), 4);
  EXPECT_EQ(FactorToSee(600, 20), 1);
  EXPECT_EQ(FactorToSee(0, 0), 512);
}

// One cell of flat ground from (2, -0.2) to (2.4, 0.2) before a rover that believes to stand at
// (5, 3) and to head along +y.
messages::NavigationView OneCell(bool known) {
  messages::NavigationView view;
  view.estimate = {5.0, 3.0, 0.5 * M_PI};
  view.map = {
      .x0_m = 4.8, .y0_m = 5.0, .xstep_m = 0.4, .ystep_m = 0.4, .nx = 1, .ny = 2, .cells = {}};
  view.map.cells.resize(2);  // the farther one holds no points
  view.map.cells[0] = {
      .has_data = true, .elevation_m = 0.1, .known = known, .goodness = 200, .certainty = 255};
  return view;
}

TEST(LookPicturesTest, TheGridLiesWhereTheCameraSeesItsCells) {
  const CapturedLook look = LookOf(0, LookDirection::kAhead);
  const Picture picture = GridPicture(look, OneCell(true));
  ASSERT_EQ(picture.width(), 8 * kSide_px);
  const Patch cell = PatchOf(picture, report::ByteColour(200));
  // Drawn 8 % of the way to its middle inside of it: x from 2.016 to 2.384, y within 0.184 m.
  const vision::Pixel near_left = Place({2.016, 0.184, 0.1});
  const vision::Pixel near_right = Place({2.016, -0.184, 0.1});
  EXPECT_NEAR(cell.left, near_left.x(), 1.0);
  EXPECT_NEAR(cell.right, near_right.x() + 1.0, 1.0);
  EXPECT_NEAR(cell.bottom, near_left.y() + 1.0, 1.0);
  EXPECT_NEAR(cell.top, Place({2.384, 0.184, 0.1}).y(), 1.0);
  // An outline: its middle shows the image.
  const vision::Pixel middle = Place({2.2, 0.0, 0.1});
  constexpr Rgb kImage{98, 98, 98};  // 80 + 120 x 40 / 255
  EXPECT_EQ(picture.At(int(middle.x()), int(middle.y())), kImage);
  const Patch rest = PatchOf(picture, kImage);
  EXPECT_EQ(cell.pixels + rest.pixels, 64 * 64 * 64);
}

TEST(LookPicturesTest, ACellThatWasNotEvaluatedIsGrey) {
  const Picture picture = GridPicture(LookOf(0, LookDirection::kAhead), OneCell(false));
  EXPECT_EQ(PatchOf(picture, report::ByteColour(200)).pixels, 0);
  EXPECT_GT(PatchOf(picture, {60, 60, 60}).pixels, 100);
}

// Between two cells with points one without has four corners, and is not drawn all the same.
TEST(LookPicturesTest, ACellWithoutPointsIsNotDrawn) {
  messages::NavigationView view = OneCell(true);
  view.map.ny = 3;
  view.map.cells = {view.map.cells[0], view.map.cells[0], view.map.cells[0]};
  view.map.cells[1].goodness = 10;
  const CapturedLook look = LookOf(0, LookDirection::kAhead);
  EXPECT_GT(PatchOf(GridPicture(look, view), report::ByteColour(10)).pixels, 100);
  view.map.cells[1].has_data = false;
  EXPECT_EQ(PatchOf(GridPicture(look, view), report::ByteColour(10)).pixels, 0);
}

// Behind a cell that rises to a ridge lies one that falls steeply: its sides cross the near edge of
// the first one in the image.
TEST(LookPicturesTest, WhatIsNearerIsDrawnOverWhatIsFarther) {
  messages::NavigationView view = OneCell(true);
  view.map.ny = 3;
  view.map.cells = {view.map.cells[0], view.map.cells[0], view.map.cells[0]};
  view.map.cells[1].elevation_m = 1.0;
  view.map.cells[2].elevation_m = -0.6;
  view.map.cells[2].goodness = 10;
  const Picture picture = GridPicture(LookOf(0, LookDirection::kAhead), view);
  EXPECT_GT(PatchOf(picture, report::ByteColour(10)).pixels, 50);
  // Corners are as high as the cells that meet there on average: 0.1 m and 0.55 m, drawn 8 % of the
  // way to the middle at 0.325 m.
  const double z_m = 0.1 + 0.08 * 0.225;
  const vision::Pixel left = Place({2.016, 0.184, z_m});
  const vision::Pixel right = Place({2.016, -0.184, z_m});
  for (int x = int(left.x()) + 2; x < int(right.x()) - 1; ++x) {
    EXPECT_EQ(picture.At(x, int(std::lround(left.y()))), report::ByteColour(200)) << x;
  }
}

TEST(LookPicturesTest, ElevationsAreSeenFromAboveWithTheRoverBelow) {
  // A step up of 0.3 m from 2 m on; a point a centimetre.
  messages::PointCloud cloud;
  for (int i = 0; i < 100; ++i) {
    for (int k = -20; k <= 20; ++k) {
      const double x_m = 1.0 + 0.02 * i;
      cloud.points_R.emplace_back(x_m, 0.025 * k, x_m > 2.0 ? 0.3 : 0.0);
    }
  }
  const ElevationImage ahead = ElevationsOf(cloud);
  const vision::Image<float>& heights_m = ahead.heights_m;
  EXPECT_EQ(ahead.grid.cell_m, 0.05);
  EXPECT_NEAR(heights_m.height(), 2.0 / 0.05, 2.0);
  EXPECT_NEAR(heights_m.width(), 1.0 / 0.05, 2.0);
  EXPECT_NEAR(heights_m.At(10, 2), 0.3, 1e-6);
  EXPECT_NEAR(heights_m.At(10, heights_m.height() - 3), 0.0, 1e-6);
  const auto span = HeightSpanOf(heights_m);
  ASSERT_TRUE(span);
  EXPECT_NEAR(span->low_m, 0.0, 1e-6);
  EXPECT_NEAR(span->high_m, 0.3, 1e-6);
  const Picture picture = ElevationPicture(heights_m);
  EXPECT_EQ(picture.At(10, 2), report::RampColour(1.0));
  EXPECT_EQ(picture.At(10, picture.height() - 3), report::RampColour(0.0));
  // The same behind the rover.
  for (Vector3& p : cloud.points_R) p.x() = -p.x();
  cloud.direction = LookDirection::kBehind;
  EXPECT_NEAR(ElevationsOf(cloud).heights_m.At(10, 2), 0.3, 1e-6);
  EXPECT_FALSE(HeightSpanOf(ElevationsOf({}).heights_m));
}

TEST(LookPicturesTest, PointsHaveTheGreyOfTheirPixel) {
  CapturedLook look = LookOf(0, LookDirection::kAhead);
  look.sight.left.At(20, 50) = 211;
  // On the ray of that pixel, 1.5 m ahead.
  const Vector3 on_ray(1.5, 0.05 - 1.5 * (20 - kMiddle_px) / kFocal_px,
                       0.5 - 1.5 * (50 - kMiddle_px) / kFocal_px);
  look.cloud.points_R = {on_ray, {1.5, 0.05, 0.5}};
  const auto points = GreyPoints(look);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].position, on_ray);
  EXPECT_EQ(points[0].colour, (Rgb{211, 211, 211}));
  EXPECT_EQ(points[1].colour, (Rgb{40, 40, 40}));
  const auto coloured = HeightPoints(look.cloud, {.low_m = on_ray.z(), .high_m = 0.5});
  ASSERT_EQ(coloured.size(), 2U);
  EXPECT_EQ(coloured[0].colour, report::RampColour(0.0));
  EXPECT_EQ(coloured[1].colour, report::RampColour(1.0));
  EXPECT_EQ(coloured[1].position, look.cloud.points_R[1]);
}

std::string FromBase64(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char digit : text.substr(0, text.find('='))) {
    buffer = (buffer << 6) | static_cast<std::uint32_t>(kDigits.find(digit));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>((buffer >> bits) & 0xFF));
  }
  return bytes;
}

image_files::RawImage Decoded(std::string_view base64) {
  return image_files::DecodePng(FromBase64(base64), "test.png", {});
}

replay::ReplayLook RecordOf(const CapturedLook& look) {
  return LookRecord({look.X_WR, look.sight, look.pair, look.matching, look.cloud}, 12.5);
}

TEST(LookRecordTest, HoldsTheImageAndItsDisparities) {
  CapturedLook look = LookOf(7, LookDirection::kBehind);
  look.cloud.points_R.resize(3);
  look.sight.left.At(5, 6) = 200;
  look.sight.disparities.At(5, 6) = 5 * vision::kDisparityOne;  // half of the range
  const replay::ReplayLook record = RecordOf(look);
  EXPECT_EQ(record.time_s, 12.5);
  EXPECT_EQ(record.number, 7);
  EXPECT_TRUE(record.behind);
  EXPECT_EQ(record.points, 3);
  EXPECT_EQ(record.least_disparity_px, 0.0);
  EXPECT_EQ(record.most_disparity_px, 10.0);
  const image_files::RawImage left = Decoded(record.left_png);
  ASSERT_EQ(left.planes.size(), 1U);
  EXPECT_EQ(left.planes[0].At(5, 6), 200);
  EXPECT_EQ(left.planes[0].At(6, 6), 40);
  const image_files::RawImage colours = Decoded(record.disparity_png);
  ASSERT_EQ(colours.planes.size(), 3U);
  const Rgb half = report::RampColour(0.5);
  EXPECT_EQ(colours.planes[0].At(5, 6), half.red);
  EXPECT_EQ(colours.planes[1].At(5, 6), half.green);
  EXPECT_EQ(colours.planes[0].At(6, 6), 0);
  EXPECT_FALSE(RecordOf(LookOf(0, LookDirection::kAhead)).behind);
}

TEST(LookRecordTest, LargeImagesAreReduced) {
  CapturedLook look = LookOf(0, LookDirection::kAhead);
  look.sight.left = vision::GrayImage(400, 200, 10);
  look.sight.disparities = vision::DisparityImage(400, 200, 0);
  for (int y = 4; y < 8; ++y) {
    for (int x = 8; x < 12; ++x) {
      look.sight.left.At(x, y) = 90;
      look.sight.disparities.At(x, y) = 10 * vision::kDisparityOne;
    }
  }
  const replay::ReplayLook record = RecordOf(look);
  const image_files::RawImage left = Decoded(record.left_png);
  const image_files::RawImage colours = Decoded(record.disparity_png);
  ASSERT_EQ(left.planes[0].width(), 100);
  EXPECT_EQ(left.planes[0].height(), 50);
  EXPECT_EQ(left.planes[0].At(2, 1), 90);
  EXPECT_EQ(left.planes[0].At(3, 1), 10);
  ASSERT_EQ(colours.planes[0].width(), 100);
  EXPECT_EQ(colours.planes[0].At(2, 1), report::RampColour(1.0).red);
  EXPECT_EQ(colours.planes[0].At(3, 1), report::RampColour(0.0).red);
}

}  // namespace
}  // namespace rockyard::campaign
