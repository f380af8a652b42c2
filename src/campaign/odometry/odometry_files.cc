#include "campaign/odometry/odometry_files.h"

#include <fmt/format.h>

#include <utility>

#include "campaign/odometry/odometry_picture.h"
#include "campaign/odometry/pose_text.h"
#include "core/archive.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "core/provenance.h"
#include "math/angles.h"
#include "report/csv.h"
#include "report/json_members.h"

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

// The path in the frame of the truth.
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

// A line a pair: its number, time, reference, keyframe, whether there was a motion and why not, the
// pose (m, unit quaternion), counts, iterations, rms of what is left over.
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

// A line a pair: the upper triangles, row by row, of the covariance of the motion from its
// reference and of that of the pose (vision::MotionCovariance); empty where there is none.
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

// A line a pair: milliseconds of each stage.
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

// A line a pair with a true pose: true and estimated position, first poses made equal, and their
// distance, m.
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

}  // namespace rockyard::campaign
