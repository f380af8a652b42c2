#include "campaign/looks/look_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "campaign/stereo/match_pair.h"
#include "core/base64.h"
#include "core/check.h"
#include "image_files/png_file.h"
#include "report/atomic_file.h"
#include "report/pinhole_camera.h"
#include "report/xml_text.h"
#include "vision/cameras/cahv.h"
#include "vision/stereo/pyramid.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using image_files::ColouredPoint;
using image_files::Picture;
using image_files::Rgb;
using math::Vector3;
using messages::LookDirection;

constexpr double kElevationCell_m = 0.05;
constexpr Rgb kUnknownCell{60, 60, 60};
// The greys of a picture under lines (Muted).
constexpr int kDarkest = 80;
constexpr int kLightest = 200;
constexpr int kLine_px = 2;
// How far outlines lie within their cells, as a share of the way from corner to middle: neighbours
// do not draw over each other.
constexpr double kInset = 0.08;

Rgb Grey(std::uint8_t value) { return {value, value, value}; }

struct CellOutline {
  std::array<Vector3, 4> corners_R;
  Rgb colour;
  double range_m = 0.0;  // of its middle, from the camera
};

std::vector<CellOutline> OutlinesOf(const messages::NavigationView& view, const Vector3& eye_R) {
  const report::GridSurface surface(view);
  std::vector<CellOutline> outlines;
  for (int iy = 0; iy < view.map.ny; ++iy) {
    for (int ix = 0; ix < view.map.nx; ++ix) {
      const messages::MapCellView& cell = view.map.Cell(ix, iy);
      if (!cell.has_data) continue;
      CellOutline outline{surface.Corners(ix, iy),
                          cell.known ? report::ByteColour(cell.goodness) : kUnknownCell};
      Vector3 middle_R = Vector3::Zero();
      for (const Vector3& corner_R : outline.corners_R) middle_R += 0.25 * corner_R;
      for (Vector3& corner_R : outline.corners_R) corner_R += kInset * (middle_R - corner_R);
      outline.range_m = (middle_R - eye_R).norm();
      outlines.push_back(outline);
    }
  }
  std::stable_sort(
      outlines.begin(), outlines.end(),
      [](const CellOutline& a, const CellOutline& b) { return a.range_m > b.range_m; });
  return outlines;
}

Picture MutedPicture(const vision::GrayImage& left) {
  Picture picture(left.width(), left.height());
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) picture.At(x, y) = Grey(Muted(left.At(x, y)));
  }
  return picture;
}

class FolderWriter {
 public:
  FolderWriter(const fs::path& folder, LookDirection direction)
      : folder_(folder), cameras_(CamerasOf(direction)) {}

  template <typename Value>
  void Png(std::string_view name, const vision::Image<Value>& picture, std::string what) {
    // A PNG file has a pixel at least.
    const vision::Image<Value> pixel(1, 1);
    Write(fmt::format("{}.png", name), image_files::EncodePng(picture.empty() ? pixel : picture),
          std::move(what));
  }

  void Ply(const std::vector<ColouredPoint>& points, std::string what) {
    Write("cloud.ply", image_files::EncodePly(points, "rover frame R, metres"), std::move(what));
  }

  std::vector<LookFile> files() && { return std::move(files_); }

 private:
  void Write(std::string_view name, std::string_view bytes, std::string what) {
    LookFile file{fmt::format("{}-{}", cameras_, name), std::move(what)};
    report::WriteFileAtomically(folder_ / file.name, bytes);
    files_.push_back(std::move(file));
  }

  const fs::path& folder_;
  std::string_view cameras_;
  std::vector<LookFile> files_;
};

Picture ToSee(const Picture& picture) {
  return Enlarged(picture, FactorToSee(picture.width(), picture.height()));
}

std::string RangeText(const vision::CorrelatorParams& range) {
  return fmt::format("disparities from {} px, violet, to {} px, yellow; black where there is none",
                     range.min_disparity_px, range.min_disparity_px + range.disparities - 1);
}

void WriteElevations(const ElevationImage& image, const std::optional<HeightSpan>& span,
                     FolderWriter& writer) {
  std::string what = "the points from above: there are none";
  if (span) {
    what = fmt::format(
        "the points from above, the rover below, {:.2f} m a cell: {:.2f} m, violet, to {:.2f} m, "
        "yellow",
        image.grid.cell_m, span->low_m, span->high_m);
  }
  writer.Png("elevation", ToSee(ElevationPicture(image.heights_m)), std::move(what));
}

std::string PointsText(std::size_t points) { return fmt::format("{} points in R, m", points); }

std::vector<LookFile> WriteLook(const fs::path& folder, const CapturedLook& look,
                                const messages::NavigationView& view) {
  FolderWriter writer(folder, look.cloud.direction);
  writer.Png("left", look.sight.left,
             fmt::format("left image of look {}, reduced and aligned as it was matched, {} x {}",
                         look.cloud.number, look.sight.left.width(), look.sight.left.height()));
  writer.Png("grid", GridPicture(look, view),
             "the same in muted grey with the map in colours of goodness");
  writer.Png("disparity", ToSee(DisparityPicture(look.sight.disparities, look.matching.correlator)),
             RangeText(look.matching.correlator));
  const ElevationImage elevations = ElevationsOf(look.cloud);
  WriteElevations(elevations, HeightSpanOf(elevations.heights_m), writer);
  writer.Ply(GreyPoints(look), PointsText(look.cloud.points_R.size()));
  return std::move(writer).files();
}

}  // namespace

std::uint8_t Muted(std::uint8_t grey) {
  return static_cast<std::uint8_t>(kDarkest + (kLightest - kDarkest) * grey / 255);
}

Picture GridPicture(const CapturedLook& look, const messages::NavigationView& view) {
  const Picture left = MutedPicture(look.sight.left);
  const int factor = FactorToSee(left.width(), left.height());
  Picture picture = Enlarged(left, factor);
  // The middle of an enlarged pixel (0, 0) lies (factor - 1) / 2 from that of the first one.
  const vision::Cahv camera = vision::Mapped(
      look.pair.left, {static_cast<double>(factor), vision::Pixel::Constant(0.5 * (factor - 1))});
  for (const CellOutline& outline : OutlinesOf(view, camera.C)) {
    for (std::size_t i = 0; i < outline.corners_R.size(); ++i) {
      const Vector3& next_R = outline.corners_R[(i + 1) % outline.corners_R.size()];
      if (const auto line = ImageOfLine(camera, outline.corners_R[i], next_R)) {
        DrawLine(*line, outline.colour, kLine_px, picture);
      }
    }
  }
  return picture;
}

ElevationImage ElevationsOf(const messages::PointCloud& cloud) {
  const Vector3 away =
      cloud.direction == LookDirection::kAhead ? Vector3::UnitX() : Vector3(-Vector3::UnitX());
  ElevationImage image;
  image.grid = vision::GridOver(cloud.points_R, away, Vector3::UnitZ(), kElevationCell_m);
  image.heights_m = vision::ElevationMap(cloud.points_R, image.grid);
  return image;
}

std::vector<ColouredPoint> GreyPoints(const CapturedLook& look) {
  std::vector<ColouredPoint> points;
  points.reserve(look.cloud.points_R.size());
  for (const Vector3& p_RoP_R : look.cloud.points_R) {
    // The point was triangulated from the middle of a pixel.
    const auto pixel = vision::Project(look.pair.left, p_RoP_R);
    if (!pixel) continue;
    points.push_back(
        {p_RoP_R, Grey(look.sight.left.At(static_cast<int>(std::lround(pixel->x())),
                                          static_cast<int>(std::lround(pixel->y()))))});
  }
  return points;
}

std::vector<ColouredPoint> HeightPoints(const messages::PointCloud& cloud, const HeightSpan& span) {
  std::vector<ColouredPoint> points;
  points.reserve(cloud.points_R.size());
  for (const Vector3& p_RoP_R : cloud.points_R) {
    points.push_back({p_RoP_R, HeightColour(p_RoP_R.z(), span)});
  }
  return points;
}

std::string_view CamerasOf(LookDirection direction) {
  return direction == LookDirection::kAhead ? "front" : "rear";
}

std::vector<LookFile> WriteLookFiles(const fs::path& folder, std::span<const CapturedLook> looks,
                                     const messages::NavigationView& view) {
  std::vector<LookFile> files;
  for (const CapturedLook& look : looks) {
    for (LookFile& file : WriteLook(folder, look, view)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<LookFile> WriteCloudFiles(const fs::path& folder, const messages::PointCloud& cloud) {
  FolderWriter writer(folder, cloud.direction);
  const ElevationImage elevations = ElevationsOf(cloud);
  const std::optional<HeightSpan> span = HeightSpanOf(elevations.heights_m);
  WriteElevations(elevations, span, writer);
  writer.Ply(HeightPoints(cloud, span.value_or(HeightSpan{})), PointsText(cloud.points_R.size()));
  return std::move(writer).files();
}

namespace {

std::int64_t NumberOf(const CapturedLook& look) { return look.cloud.number; }

int LevelOf(const vision::GrayImage& image) {
  int level = 0;
  while ((std::max(image.width(), image.height()) >> level) > kLargestRecordSide_px) ++level;
  return level;
}

// Returns the middle pixel of every 2^level x 2^level pixels: a mean of colours would be no
// disparity.
Picture Thinned(const Picture& picture, int level) {
  const int side = 1 << level;
  Picture thinned(picture.width() / side, picture.height() / side);
  for (int y = 0; y < thinned.height(); ++y) {
    for (int x = 0; x < thinned.width(); ++x) {
      thinned.At(x, y) = picture.At(x * side + side / 2, y * side + side / 2);
    }
  }
  return thinned;
}

}  // namespace

CapturedLook Capture(const trial::WatchedStereo& watched) {
  return {watched.X_WR, watched.sight, watched.pair, watched.matching, watched.cloud};
}

void LookMemory::Add(CapturedLook look) { looks_.push_back(std::move(look)); }

std::vector<CapturedLook> LookMemory::LooksOf(const messages::PointCloud& cloud) {
  std::vector<CapturedLook> found;
  std::vector<CapturedLook> later;
  for (CapturedLook& look : looks_) {
    if (NumberOf(look) > cloud.number) {
      later.push_back(std::move(look));
    } else if (NumberOf(look) == cloud.number) {
      found.push_back(std::move(look));
    } else if (cloud.direction == LookDirection::kBehind &&
               look.cloud.direction == LookDirection::kAhead) {
      found.clear();
      found.push_back(std::move(look));
    }
  }
  looks_ = std::move(later);
  return found;
}

replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s) {
  const vision::GrayImage& left = watched.sight.left;
  const vision::CorrelatorParams& range = watched.matching.correlator;
  const int level = LevelOf(left);
  const Picture disparities = Thinned(DisparityPicture(watched.sight.disparities, range), level);
  return {.time_s = time_s,
          .number = watched.cloud.number,
          .behind = watched.cloud.direction == messages::LookDirection::kBehind,
          .points = static_cast<std::int64_t>(watched.cloud.points_R.size()),
          .least_disparity_px = static_cast<double>(range.min_disparity_px),
          .most_disparity_px = static_cast<double>(range.min_disparity_px + range.disparities - 1),
          .left_png = core::Base64(image_files::EncodePng(vision::ReduceImage(left, level))),
          .disparity_png = core::Base64(image_files::EncodePng(disparities))};
}

namespace {

using vision::Pixel;

constexpr double kNearestDepth_m = 0.05;
constexpr int kSideToSee_px = 512;

// The part of 0 <= s <= 1 in which from + s (to - from) lies in [low, high].
struct Share {
  double first = 0.0;
  double last = 1.0;

  void Keep(double from, double to, double low, double high) {
    const double along = to - from;
    if (along == 0.0) {
      if (from < low || from > high) last = -1.0;
      return;
    }
    const double a = (low - from) / along;
    const double b = (high - from) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  bool empty() const { return first > last; }
};

// Draws a square with its upper left corner at (x, y), as far as it lies within the picture.
void DrawDot(int x, int y, int width_px, const image_files::Rgb& colour, Picture& picture) {
  for (int row = y; row < std::min(y + width_px, picture.height()); ++row) {
    for (int column = x; column < std::min(x + width_px, picture.width()); ++column) {
      picture.At(column, row) = colour;
    }
  }
}

}  // namespace

Picture Enlarged(const Picture& picture, int factor) {
  EXPECT(factor >= 1);
  Picture large(picture.width() * factor, picture.height() * factor);
  for (int y = 0; y < large.height(); ++y) {
    for (int x = 0; x < large.width(); ++x) {
      large.At(x, y) = picture.At(x / factor, y / factor);
    }
  }
  return large;
}

int FactorToSee(int width, int height) {
  return std::max(1, kSideToSee_px / std::max({width, height, 1}));
}

std::optional<PictureSegment> ImageOfLine(const vision::Cahv& camera, const Vector3& from_A,
                                          const Vector3& to_A) {
  const Vector3 along = to_A - from_A;
  const double from_m = (from_A - camera.C).dot(camera.A);
  const double to_m = (to_A - camera.C).dot(camera.A);
  Share seen;
  seen.Keep(from_m, to_m, kNearestDepth_m, std::max({kNearestDepth_m, from_m, to_m}));
  if (seen.empty()) return std::nullopt;
  const auto a = vision::Project(camera, from_A + seen.first * along);
  const auto b = vision::Project(camera, from_A + seen.last * along);
  if (!a || !b) return std::nullopt;
  return PictureSegment{*a, *b};
}

void DrawLine(const PictureSegment& line, const image_files::Rgb& colour, int width_px,
              Picture& picture) {
  EXPECT(width_px >= 1);
  const auto& [from, to] = line;
  Share inside;
  inside.Keep(from.x(), to.x(), 0.0, picture.width() - 1.0);
  inside.Keep(from.y(), to.y(), 0.0, picture.height() - 1.0);
  if (inside.empty()) return;
  const Pixel first = from + inside.first * (to - from);
  const Pixel last = from + inside.last * (to - from);
  const int steps =
      std::max(1, static_cast<int>(std::ceil((last - first).lpNorm<Eigen::Infinity>())));
  for (int i = 0; i <= steps; ++i) {
    const Pixel at = first + (last - first) * i / steps;
    // The pixel lies within the picture but for rounding.
    const int x = std::clamp(static_cast<int>(std::lround(at.x())), 0, picture.width() - 1);
    const int y = std::clamp(static_cast<int>(std::lround(at.y())), 0, picture.height() - 1);
    DrawDot(x, y, width_px, colour, picture);
  }
}

}  // namespace rockyard::campaign
