#include "campaign/odometry/odometry_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "campaign/looks/look_pictures.h"
#include "campaign/odometry/pose_text.h"
#include "core/archive.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "core/provenance.h"
#include "math/angles.h"
#include "math/functions.h"
#include "report/result_table.h"
#include "report/xml_text.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

constexpr const char* kErrorNames[] = {"tx", "ty", "tz", "rx", "ry", "rz"};

void AddCovarianceNames(report::CsvRow& row, const char* of) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      row.Add(fmt::format("{}_{}_{}", of, kErrorNames[i], kErrorNames[j]));
    }
  }
}

void AddCovariance(report::CsvRow& row, const vision::MotionCovariance* covariance) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) row.Add(covariance == nullptr ? core::kNaN : (*covariance)(i, j));
  }
}

// Returns the transform that brings the path into the frame of the truth.
math::Transform ToTruth(const OdometryResult& result) {
  return result.truth.front() * result.steps[result.steps_with_truth.front()].X_AB.inverse();
}

JsonValue SummaryJson(const std::optional<vision::ErrorSummary>& summary, double scale = 1.0) {
  if (!summary) return JsonValue();
  return report::ObjectTree("count", summary->count, "rms", scale * summary->rms, "mean",
                            scale * summary->mean, "median", scale * summary->median, "largest",
                            scale * summary->largest);
}

JsonValue SegmentsJson(const OdometryRequest& request, const PathErrors& errors) {
  if (!errors.segments) return JsonValue();
  return report::ObjectTree("segments", errors.segments->segments, "translation_percent",
                            100.0 * errors.segments->translation, "rotation_deg_per_m",
                            math::RadToDeg(errors.segments->rotation_rad_per_m), "lengths_m",
                            request.lengths_m.empty() ? core::ListOf(vision::kKittiLengths_m)
                                                      : core::ListOf(request.lengths_m));
}

JsonValue PathErrorsJson(const OdometryRequest& request, const OdometryResult& result) {
  if (!result.errors) return JsonValue();
  const PathErrors& errors = *result.errors;
  const double to_deg = math::RadToDeg(1.0);
  return report::ObjectTree(
      "pairs", errors.pairs, "distance_m", errors.distance_m, "end_m", errors.end_error_m,
      "end_percent", core::NumberOrNull(100.0 * errors.end_error_m / errors.distance_m), "segments",
      SegmentsJson(request, errors), "absolute_first_pose_m", SummaryJson(errors.absolute_first_m),
      "absolute_rigid_m", SummaryJson(errors.absolute_rigid_m), "relative_delta", request.delta,
      "relative_m", SummaryJson(errors.relative_m), "relative_deg",
      SummaryJson(errors.relative_rad, to_deg), "normalized", SummaryJson(errors.normalized),
      "normalized_above_95", errors.normalized_above_95);
}

JsonValue TimesJson(const OdometryResult& result) {
  JsonValue json = JsonValue::Object();
  for (std::size_t i = 0; i < kPairStageNames.size(); ++i) {
    const auto times = StageTimes(result, static_cast<PairStage>(i));
    json.Set(kPairStageNames[i], times ? report::ObjectTree("median_ms", 1e3 * times->median,
                                                            "largest_ms", 1e3 * times->largest)
                                       : JsonValue());
  }
  return json;
}

JsonValue ReasonsJson(const OdometryResult& result) {
  const std::vector<std::int64_t> counts = ReasonCounts(result);
  JsonValue json = JsonValue::Object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    json.Set(core::EnumNames<vision::NoMotion>::kNames[i], JsonValue(counts[i]));
  }
  return json;
}

JsonValue SequenceJson(const OdometryRequest& request, const OdometryResult& result) {
  return report::ObjectTree("path", request.sequence.string(), "layout", result.layout, "pairs",
                            result.pairs_there, "image", result.read, "first", request.first,
                            "every", request.every);
}

// trajectory.csv: a line for each pair with number, time, reference, keyframe, whether there was a
// motion and why not, the pose (m, unit quaternion), counts, iterations, rms of what is left over.
std::string TrajectoryCsv(const OdometryResult& result) {
  std::string csv =
      "pair,time_s,reference,keyframe,motion,reason,x_m,y_m,z_m,qw,qx,qy,qz,features_reference,"
      "features,matches,points,consistent,iterations,rms_px\n";
  for (const PathStep& step : result.steps) {
    const vision::MotionCounts& counts = step.result.counts;
    const Eigen::Quaterniond q(step.X_AB.linear());
    csv += report::CsvLine(step.pair, step.time_s, step.reference, step.keyframe,
                           step.result.motion.has_value(),
                           step.result.reason ? NameOf(*step.result.reason) : "",
                           math::Vector3(step.X_AB.translation()), q.w(), q.x(), q.y(), q.z(),
                           counts.features_first, counts.features_second, counts.matches,
                           counts.points, counts.consistent, counts.iterations, step.result.rms_px);
  }
  return csv;
}

// covariance.csv: a line for each pair with the upper triangles, row by row, of the covariance of
// the motion from its reference and of that of the pose (vision::MotionCovariance); empty where
// there is none.
std::string CovarianceCsv(const OdometryResult& result) {
  report::CsvRow head("pair", "reference");
  AddCovarianceNames(head, "motion");
  AddCovarianceNames(head, "pose");
  std::string csv = head.Line();
  for (const PathStep& step : result.steps) {
    report::CsvRow row(step.pair, step.reference);
    AddCovariance(row, step.result.motion ? &step.result.motion->covariance : nullptr);
    AddCovariance(row, step.covariance ? &*step.covariance : nullptr);
    csv += row.Line();
  }
  return csv;
}

// times.csv: a line for each pair with the milliseconds of each stage.
std::string TimesCsv(const OdometryResult& result) {
  report::CsvRow head("pair");
  for (const std::string_view stage : kPairStageNames) head.Add(fmt::format("{}_ms", stage));
  std::string csv = head.Line();
  for (const PathStep& step : result.steps) {
    report::CsvRow row(step.pair);
    for (const double seconds : step.seconds) row.Add(fmt::format("{:.3f}", 1e3 * seconds));
    csv += row.Line();
  }
  return csv;
}

// errors.csv: a line for each pair with a true pose: true and estimated position, first poses made
// equal, and their distance, m.
std::string ErrorsCsv(const OdometryResult& result) {
  std::string csv = "pair,true_x_m,true_y_m,true_z_m,x_m,y_m,z_m,error_m\n";
  if (result.truth.empty()) return csv;
  const math::Transform X_TA = ToTruth(result);
  for (std::size_t i = 0; i < result.truth.size(); ++i) {
    const PathStep& step = result.steps[result.steps_with_truth[i]];
    const math::Vector3 truth = result.truth[i].translation();
    const math::Vector3 estimate = (X_TA * step.X_AB).translation();
    csv += report::CsvLine(step.pair, truth, estimate, (truth - estimate).norm());
  }
  return csv;
}

}  // namespace

std::vector<std::string> OdometryFileNames() {
  return {"trajectory.csv", "covariance.csv", "times.csv",   "trajectory_kitti.txt",
          "errors.csv",     "path.svg",       kFeaturesFile, "trajectory_tum.txt",
          "vo.json",        kJournalFile};
}

void WriteOdometryFiles(const OdometryRequest& request, OutputFolder& folder,
                        OdometryResult& result) {
  folder.Write("trajectory", "trajectory.csv", TrajectoryCsv(result));
  folder.Write("covariance", "covariance.csv", CovarianceCsv(result));
  folder.Write("times", "times.csv", TimesCsv(result));
  std::vector<double> times_s;
  for (const PathStep& step : result.steps) times_s.push_back(step.time_s);
  const vision::Trajectory path = result.Path();
  folder.Write("kitti", "trajectory_kitti.txt", KittiPoses(path));
  folder.Write("tum", "trajectory_tum.txt", TumPoses(path, times_s));
  if (!result.truth.empty()) folder.Write("errors", "errors.csv", ErrorsCsv(result));
  folder.Write("path", "path.svg", PathDrawing(result));
  if (std::filesystem::exists(folder.PathOf(kFeaturesFile))) {
    folder.Tell("features", kFeaturesFile);
  }
  result.files = folder.files();
  folder.Write("summary", "vo.json", core::DumpJson(OdometryJson(request, result)));
  folder.Finish(result.outcome == Outcome::kDone);
  result.files = folder.files();
}

std::optional<vision::ErrorSummary> StageTimes(const OdometryResult& result, PairStage stage) {
  std::vector<double> seconds;
  for (const PathStep& step : result.steps) {
    seconds.push_back(step.seconds[static_cast<std::size_t>(stage)]);
  }
  return vision::SummaryOf(std::move(seconds));
}

std::vector<std::int64_t> ReasonCounts(const OdometryResult& result) {
  std::vector<std::int64_t> counts(core::EnumNames<vision::NoMotion>::kNames.size(), 0);
  for (const PathStep& step : result.steps) {
    if (step.result.reason) ++counts[static_cast<std::size_t>(*step.result.reason)];
  }
  return counts;
}

JsonValue OdometryJson(const OdometryRequest& request, const OdometryResult& result) {
  return report::ObjectTree(
      "schema_version", 1, "sequence", SequenceJson(request, result), "cameras",
      report::ObjectTree("focal_px", result.cameras.focal_px, "baseline_m",
                         result.cameras.baseline_m, "columns", result.cameras.size.columns, "rows",
                         result.cameras.size.rows, "resampled", result.resampled),
      "seed", static_cast<std::int64_t>(request.seed), "prediction", NameOf(request.prediction),
      "parameters", core::WriteParams(result.params), "interrupted",
      result.outcome == Outcome::kInterrupted, "pairs", std::ssize(result.steps), "gaps",
      result.Gaps(), "reasons", ReasonsJson(result), "distance_m", result.Distance_m(), "errors",
      PathErrorsJson(request, result), "times", TimesJson(result), "notes",
      core::ListOf(result.notes), "files", FilesJson(result.files), "program", core::VersionLine());
}

namespace {

using image_files::Picture;
using math::Vector3;
using report::SvgPoint;

constexpr double kDrawing_px = 720.0;
constexpr double kMargin_px = 60.0;
constexpr double kLeastExtent_m = 0.1;
constexpr int kMark_px = 3;
constexpr const char* kAxisNames[] = {"x", "y", "z"};

void DrawMark(const vision::Pixel& at, int factor, const image_files::Rgb& colour,
              Picture& picture) {
  const vision::Pixel middle = factor * at;
  DrawLine({middle, middle}, colour, kMark_px, picture);
}

std::vector<Vector3> PositionsOf(const vision::Trajectory& path) {
  std::vector<Vector3> positions;
  for (const math::Transform& pose : path) positions.emplace_back(pose.translation());
  return positions;
}

// Returns the true positions in the frame of the first pair.
std::vector<Vector3> TruePositions(const OdometryResult& result) {
  std::vector<Vector3> positions;
  if (result.truth.empty()) return positions;
  const math::Transform X_AT =
      result.steps[result.steps_with_truth.front()].X_AB * result.truth.front().inverse();
  for (const math::Transform& pose : result.truth) {
    positions.emplace_back((X_AT * pose).translation());
  }
  return positions;
}

// The plane of a drawing: the two axes along which points extend most, and how points are drawn.
class PathPlane {
 public:
  explicit PathPlane(const std::vector<Vector3>& points) {
    low_ = points.front();
    high_ = points.front();
    for (const Vector3& point : points) {
      low_ = low_.cwiseMin(point);
      high_ = high_.cwiseMax(point);
    }
    const Vector3 extent = high_ - low_;
    std::sort(axes_, axes_ + 3,
              [&](int a, int b) { return extent[a] != extent[b] ? extent[a] > extent[b] : a < b; });
    px_a_m_ = (kDrawing_px - 2.0 * kMargin_px) / std::max(extent[axes_[0]], kLeastExtent_m);
    height_px_ = 2.0 * kMargin_px + px_a_m_ * extent[axes_[1]];
  }

  SvgPoint At(const Vector3& point) const {
    return {kMargin_px + px_a_m_ * (point[axes_[0]] - low_[axes_[0]]),
            kMargin_px + px_a_m_ * (high_[axes_[1]] - point[axes_[1]])};
  }
  std::string Caption() const {
    return fmt::format("{} to the right, {} up, of the cameras' outer frame at the first pair",
                       kAxisNames[axes_[0]], kAxisNames[axes_[1]]);
  }
  double height_px() const { return height_px_; }

  // Returns a bar of a round length, at most a third of the drawing.
  std::string ScaleBar() const {
    const double most_m = kDrawing_px / 3.0 / px_a_m_;
    const double power_m = math::Pow(10.0, std::floor(math::Log10(most_m)));
    const double length_m =
        most_m >= 5.0 * power_m ? 5.0 * power_m : (most_m >= 2.0 * power_m ? 2.0 : 1.0) * power_m;
    const double y = height_px_ - 20.0;
    return report::SvgLine({kMargin_px, y}, {kMargin_px + px_a_m_ * length_m, y},
                           "stroke=\"#333\" stroke-width=\"3\"") +
           report::SvgText(kMargin_px, y - 6.0, fmt::format("{:g} m", length_m));
  }

 private:
  Vector3 low_;
  Vector3 high_;
  int axes_[3] = {0, 1, 2};
  double px_a_m_ = 1.0;
  double height_px_ = 0.0;
};

std::string Polyline(const PathPlane& plane, const std::vector<Vector3>& points,
                     const char* style) {
  std::vector<SvgPoint> drawn;
  drawn.reserve(points.size());
  for (const Vector3& point : points) drawn.push_back(plane.At(point));
  return report::SvgPolyline(drawn, style);
}

std::string GapMarks(const PathPlane& plane, const OdometryResult& result) {
  constexpr double kCross_px = 4.0;
  std::string svg;
  for (const PathStep& step : result.steps) {
    if (!step.result.reason) continue;
    const SvgPoint at = plane.At(step.X_AB.translation());
    for (const double way : {-kCross_px, kCross_px}) {
      svg += report::SvgLine({at.x - kCross_px, at.y - way}, {at.x + kCross_px, at.y + way},
                             "stroke=\"#b00020\" stroke-width=\"1.5\"");
    }
  }
  return svg;
}

}  // namespace

Picture FeaturePicture(const vision::GrayImage& left, const vision::OdometryStep& step) {
  const int factor = FactorToSee(left.width(), left.height());
  Picture picture(left.width(), left.height());
  std::transform(left.values().begin(), left.values().end(), picture.values().begin(),
                 [](std::uint8_t grey) {
                   return image_files::Rgb{Muted(grey), Muted(grey), Muted(grey)};
                 });
  picture = Enlarged(picture, factor);
  for (const vision::Feature& feature : step.features) {
    DrawMark(vision::Pixel(feature.column, feature.row), factor, report::RampColour(0.5), picture);
  }
  for (const vision::PointSeenTwice& point : step.consistent) {
    DrawLine({factor * point.first.left, factor * point.second.left}, report::RampColour(1.0), 1,
             picture);
    DrawMark(point.second.left, factor, report::RampColour(1.0), picture);
  }
  return picture;
}

std::string PathDrawing(const OdometryResult& result) {
  const std::vector<Vector3> path = PositionsOf(result.Path());
  const std::vector<Vector3> truth = TruePositions(result);
  std::vector<Vector3> all = path;
  all.insert(all.end(), truth.begin(), truth.end());
  const PathPlane plane(all.empty() ? std::vector<Vector3>{Vector3::Zero()} : all);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
      kDrawing_px, plane.height_px());
  svg += report::SvgBox(0.0, 0.0, kDrawing_px, plane.height_px(), "fill=\"#fff\"");
  svg += report::SvgText(kMargin_px, 20.0, plane.Caption());
  if (!truth.empty()) {
    svg += Polyline(plane, truth, "fill=\"none\" stroke=\"#888\" stroke-width=\"3\"");
  }
  svg += Polyline(plane, path, "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\"");
  svg += GapMarks(plane, result);
  svg += report::SvgText(kMargin_px, 38.0,
                         truth.empty() ? "blue: estimated; red crosses: pairs without a motion"
                                       : "blue: estimated; grey: true; red crosses: pairs without "
                                         "a motion",
                         11.0);
  return svg + plane.ScaleBar() + "</svg>\n";
}

}  // namespace rockyard::campaign
