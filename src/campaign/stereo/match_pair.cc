#include "campaign/stereo/match_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "campaign/stereo/stereo_input.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/provenance.h"
#include "image_files/float_files.h"
#include "image_files/png_file.h"
#include "report/result_table.h"
#include "report/xml_text.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo.h"

namespace rockyard::campaign {
namespace {

using Eigen::Vector3d;
using image_files::ColouredPoint;
using image_files::Picture;
using image_files::Rgb;
using vision::DisparityImage;
using vision::Image;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// The share of heights at either end that takes the colour of that end.
constexpr double kLeftOut = 0.01;

Rgb Gray(std::uint8_t value) { return {value, value, value}; }

// Returns the axis of the outer frame, up or down it, to which `direction` is nearest.
Vector3d NearestAxis(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  Vector3d nearest = Vector3d::Zero();
  nearest[axis] = std::copysign(1.0, direction[axis]);
  return nearest;
}

std::vector<Vector3d> PositionsOf(const std::vector<ColouredPoint>& points) {
  std::vector<Vector3d> positions;
  positions.reserve(points.size());
  for (const ColouredPoint& point : points) positions.push_back(point.position);
  return positions;
}

// Returns the disparities in pixels; NaN where a filter dropped the pixel.
Image<float> DisparityValues(const DisparityImage& disparities) {
  Image<float> values(disparities.width(), disparities.height(), kUnknown);
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (vision::IsValid(disparity)) {
        values.At(x, y) = static_cast<float>(vision::DisparityPx(disparity));
      }
    }
  }
  return values;
}

// Returns the left image beside the picture of disparities.
Picture PairPicture(const vision::GrayImage& left, const Picture& disparities) {
  Picture picture(left.width() + disparities.width(), left.height());
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) {
      picture.At(x, y) = Gray(left.At(x, y));
      picture.At(left.width() + x, y) = disparities.At(x, y);
    }
  }
  return picture;
}

// Returns a grid over the points, seen against the axis of the outer frame (up or down it) that is
// nearest to the images' upward direction: nobody says which way the frame of a camera file stands,
// and a camera on a rover stands nearly upright.
vision::ElevationGrid GridOverPoints(const std::vector<ColouredPoint>& points,
                                     const vision::RectifiedPair& cameras, double cell_m) {
  const Vector3d& axis_A = cameras.left.A;
  const Vector3d up = NearestAxis(-(cameras.left.V - cameras.left.V.dot(axis_A) * axis_A));
  const Vector3d away = NearestAxis(axis_A - axis_A.dot(up) * up);
  return vision::GridOver(PositionsOf(points), away, up, cell_m);
}

// Returns the heights over the cells of the grid, m; NaN where no point is.
Image<float> HeightsOf(const std::vector<ColouredPoint>& points,
                       const vision::ElevationGrid& grid) {
  return vision::ElevationMap(PositionsOf(points), grid);
}

using core::JsonValue;

// Where more pixels than this share match best at an end of the range, the range may be too short.
constexpr double kManyAtTheEnd = 0.1;
// A density below this is little for a pair that was taken as aligned.
constexpr double kFew = 0.25;

vision::DisparityImage Matched(const StereoInput& input, const vision::StereoPipelineParams& params,
                               int threads) {
  vision::StereoProducts products;
  vision::MatchStereo(input.left, input.right, params, threads, products);
  if (!input.left_inside.empty()) {
    vision::DropOutside(input.left_inside, input.right_inside,
                        static_cast<int>(params.correlator.window_side_px), products.disparities);
  }
  return std::move(products.disparities);
}

vision::StereoScore Scored(const StereoRequest& request, const vision::DisparityImage& found) {
  const vision::Image<float> known =
      image_files::ReadDisparity(request.reference, request.reference_samples_a_px);
  if (known.width() != found.width() || known.height() != found.height()) {
    throw core::UserError(
        request.reference.string(),
        fmt::format("has {} x {} pixels, the disparities have {} x {}", known.width(),
                    known.height(), found.width(), found.height()),
        "give the known disparities of the left image as it is matched: not reduced, and without "
        "--cameras where they are those of images that are aligned already");
  }
  return vision::ScoreAgainst(known, found);
}

void NoteDoubts(const StereoInput& input, StereoResult& result) {
  const auto all = static_cast<double>(
      std::accumulate(result.counts.begin(), result.counts.end(), std::int64_t{0}));
  const auto at_end =
      static_cast<double>(result.counts[static_cast<std::size_t>(vision::Drop::kRangeEnd)]);
  if (at_end > kManyAtTheEnd * all) {
    result.notes.push_back(
        fmt::format("of {:.0f} % of the pixels the best match lies at an end of the range: "
                    "what is nearer or farther than it was not searched",
                    100.0 * at_end / all));
  }
  if (!input.advice.empty()) {
    result.notes.push_back(input.advice);
  } else if (result.counts[0] == 0) {
    result.notes.emplace_back("no pixel has a match: the images show too little texture");
  } else if (!result.cameras && !result.alignment && result.Density() < kFew) {
    result.notes.emplace_back(
        "few pixels have a match: are the rows of both images aligned? --cameras or --align does "
        "it");
  }
}

void WritePoints(const StereoRequest& request, const StereoInput& input,
                 const vision::DisparityImage& disparities, OutputFolder& folder,
                 StereoResult& result) {
  const auto points = PointsOf(disparities, input.left, *input.cameras);
  const vision::ElevationGrid grid = GridOverPoints(points, *input.cameras, request.cell_m);
  result.points = static_cast<std::int64_t>(points.size());
  folder.Write("aligned_left", "left.png", image_files::EncodePng(input.left));
  folder.Write("aligned_right", "right.png", image_files::EncodePng(input.right));
  folder.Write("points", "points.ply",
               image_files::EncodePly(points, "outer frame of the cameras, m"));
  if (points.empty()) return;
  const vision::Image<float> heights_m = HeightsOf(points, grid);
  folder.Write("elevation", "elevation.pfm", image_files::EncodePfm(heights_m));
  folder.Write("elevation_picture", "elevation.png",
               image_files::EncodePng(ElevationPicture(heights_m)));
}

JsonValue ImageJson(const std::filesystem::path& path, const std::string& what) {
  return report::ObjectTree("file", path.string(), "what", what);
}

JsonValue CamerasJson(const vision::RectifiedPair& cameras) {
  return report::ObjectTree("focal_px", cameras.focal_px, "baseline_m", cameras.baseline_m);
}

JsonValue AlignmentJson(const vision::RowAlignment& alignment) {
  return report::ObjectTree("offset_px", alignment.correction.offset_px, "per_column",
                            alignment.correction.per_column, "per_row",
                            alignment.correction.per_row, "matches", alignment.matches, "agreeing",
                            alignment.agreeing, "rms_px", alignment.rms_px);
}

JsonValue PixelsJson(const StereoResult& result) {
  JsonValue dropped = JsonValue::Object();
  std::int64_t all = 0;
  for (std::size_t i = 0; i < result.counts.size(); ++i) {
    all += result.counts[i];
    if (i > 0) dropped.Set(vision::kDropNames[i], JsonValue(result.counts[i]));
  }
  return report::ObjectTree("all", all, "matched", result.counts[0], "density", result.Density(),
                            "dropped", std::move(dropped));
}

JsonValue ScoreJson(const vision::StereoScore& score) {
  JsonValue bad = JsonValue::Object();
  for (std::size_t i = 0; i < vision::kBadThresholds_px.size(); ++i) {
    bad.Set(fmt::format("above_{}_px", vision::kBadThresholds_px[i]), JsonValue(score.BadShare(i)));
  }
  return report::ObjectTree("known", score.known, "matched", score.matched, "density",
                            score.Density(), "bad", std::move(bad), "mean_error_px",
                            score.mean_error_px, "rms_error_px", score.rms_error_px);
}

}  // namespace

double StereoResult::Density() const {
  const auto all = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  return all == 0 ? 0.0 : static_cast<double>(counts[0]) / static_cast<double>(all);
}

StereoResult MatchPair(const StereoRequest& request) {
  StereoResult result;
  result.params = StereoParamsOf(request);
  OutputFolder folder(
      request.out, request.existing,
      {.command = "stereo",
       .names = {"disparity.pfm", "disparity.png", "picture.png", "left.png", "right.png",
                 "points.ply", "elevation.pfm", "elevation.png", "stereo.json"},
       .inputs = {request.left, request.right, request.cameras, request.reference}});
  const StereoInput input = ReadStereoInput(request, static_cast<int>(result.params.pyramid_level));
  result.params = WithRange(request, input, result.params);
  result.read = input.read;
  result.cameras = input.cameras;
  result.alignment = input.alignment;
  result.size = {input.left.width(), input.left.height()};
  const vision::DisparityImage disparities = Matched(input, result.params, request.threads);
  CheckThatTheyMatch(request, input, result.params, disparities);
  result.counts = vision::CountDrops(disparities);
  if (!request.reference.empty()) result.score = Scored(request, disparities);
  NoteDoubts(input, result);
  const image_files::Picture picture = DisparityPicture(disparities, result.params.correlator);
  folder.Write("disparity", "disparity.pfm", image_files::EncodePfm(DisparityValues(disparities)));
  folder.Write("disparity_picture", "disparity.png", image_files::EncodePng(picture));
  folder.Write("picture", "picture.png", image_files::EncodePng(PairPicture(input.left, picture)));
  if (input.cameras) WritePoints(request, input, disparities, folder, result);
  result.files = folder.files();
  folder.Write("summary", "stereo.json", core::DumpJson(StereoJson(request, result)));
  folder.Finish();
  result.files = folder.files();
  return result;
}

JsonValue StereoJson(const StereoRequest& request, const StereoResult& result) {
  return report::ObjectTree(
      "schema_version", 1, "left", ImageJson(request.left, result.read.at(0)), "right",
      ImageJson(request.right, result.read.at(1)), "size",
      report::ObjectTree("columns", result.size.columns, "rows", result.size.rows), "cameras",
      result.cameras ? CamerasJson(*result.cameras) : JsonValue(), "alignment",
      result.alignment ? AlignmentJson(*result.alignment) : JsonValue(), "parameters",
      core::WriteParams(result.params), "pixels", PixelsJson(result), "score",
      result.score ? ScoreJson(*result.score) : JsonValue(), "points", result.points, "notes",
      core::ListOf(result.notes), "files", FilesJson(result.files), "program", core::VersionLine());
}

Picture DisparityPicture(const DisparityImage& disparities, const vision::CorrelatorParams& range) {
  const auto least_px = static_cast<double>(range.min_disparity_px);
  const auto span_px = static_cast<double>(std::max<std::int64_t>(1, range.disparities - 1));
  Picture picture(disparities.width(), disparities.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (!vision::IsValid(disparity)) continue;
      picture.At(x, y) = report::RampColour((vision::DisparityPx(disparity) - least_px) / span_px);
    }
  }
  return picture;
}

std::vector<ColouredPoint> PointsOf(const DisparityImage& disparities,
                                    const vision::GrayImage& left,
                                    const vision::RectifiedPair& cameras) {
  std::vector<ColouredPoint> points;
  for (int y = 0; y < disparities.height(); ++y) {
    for (int x = 0; x < disparities.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (!vision::IsValid(disparity)) continue;
      const auto point = vision::Triangulate(cameras.left, cameras.right, vision::Pixel(x, y),
                                             vision::DisparityPx(disparity));
      if (point) points.push_back({point->p_A, Gray(left.At(x, y))});
    }
  }
  return points;
}

std::optional<HeightSpan> HeightSpanOf(const Image<float>& heights_m) {
  std::vector<float> known;
  for (const float height_m : heights_m.values()) {
    if (std::isfinite(height_m)) known.push_back(height_m);
  }
  if (known.empty()) return std::nullopt;
  std::sort(known.begin(), known.end());
  const auto cut = static_cast<std::size_t>(kLeftOut * static_cast<double>(known.size()));
  return HeightSpan{known[cut], known[known.size() - 1 - cut]};
}

Rgb HeightColour(double height_m, const HeightSpan& span) {
  return report::RampColour((height_m - span.low_m) / std::max(span.high_m - span.low_m, 1e-6));
}

Picture ElevationPicture(const Image<float>& heights_m) {
  Picture picture(heights_m.width(), heights_m.height());
  const std::optional<HeightSpan> span = HeightSpanOf(heights_m);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float height_m = heights_m.At(x, y);
      if (std::isfinite(height_m)) picture.At(x, y) = HeightColour(height_m, *span);
    }
  }
  return picture;
}

}  // namespace rockyard::campaign
