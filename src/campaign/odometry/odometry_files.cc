#include "campaign/odometry/odometry_files.h"

#include <fmt/format.h>

#include <vector>

#include "campaign/odometry/odometry_json.h"
#include "campaign/odometry/odometry_picture.h"
#include "campaign/odometry/pose_text.h"
#include "core/json_text.h"
#include "report/csv.h"

namespace rockyard::campaign {
namespace {

using Fields = std::vector<std::string>;

constexpr const char* kErrorNames[] = {"tx", "ty", "tz", "rx", "ry", "rz"};

void AddNumbers(Fields& fields, const math::Vector3& numbers) {
  for (const double number : numbers) fields.push_back(report::CsvNumber(number));
}

void AddCovarianceNames(Fields& fields, const char* of) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      fields.push_back(fmt::format("{}_{}_{}", of, kErrorNames[i], kErrorNames[j]));
    }
  }
}

void AddCovariance(Fields& fields, const vision::MotionCovariance* covariance) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      fields.push_back(covariance == nullptr ? "" : report::CsvNumber((*covariance)(i, j)));
    }
  }
}

// The path in the frame of the truth.
math::Transform ToTruth(const OdometryResult& result) {
  return result.truth.front() * result.steps[result.steps_with_truth.front()].X_AB.inverse();
}

}  // namespace

std::string TrajectoryCsv(const OdometryResult& result) {
  std::string csv = report::CsvLine(Fields{"pair",       "time_s",
                                           "reference",  "keyframe",
                                           "motion",     "reason",
                                           "x_m",        "y_m",
                                           "z_m",        "qw",
                                           "qx",         "qy",
                                           "qz",         "features_reference",
                                           "features",   "matches",
                                           "points",     "consistent",
                                           "iterations", "rms_px"});
  for (const PathStep& step : result.steps) {
    const vision::MotionCounts& counts = step.result.counts;
    Fields fields{std::to_string(step.pair),
                  report::CsvNumber(step.time_s),
                  std::to_string(step.reference),
                  step.keyframe ? "1" : "0",
                  step.result.motion ? "1" : "0",
                  step.result.reason ? std::string(NameOf(*step.result.reason)) : ""};
    AddNumbers(fields, step.X_AB.translation());
    const Eigen::Quaterniond q(step.X_AB.linear());
    for (const double number : {q.w(), q.x(), q.y(), q.z()}) {
      fields.push_back(report::CsvNumber(number));
    }
    for (const std::int64_t count : {counts.features_first, counts.features_second, counts.matches,
                                     counts.points, counts.consistent, counts.iterations}) {
      fields.push_back(std::to_string(count));
    }
    fields.push_back(report::CsvNumber(step.result.rms_px));
    csv += report::CsvLine(fields);
  }
  return csv;
}

std::string CovarianceCsv(const OdometryResult& result) {
  Fields names{"pair", "reference"};
  AddCovarianceNames(names, "motion");
  AddCovarianceNames(names, "pose");
  std::string csv = report::CsvLine(names);
  for (const PathStep& step : result.steps) {
    Fields fields{std::to_string(step.pair), std::to_string(step.reference)};
    AddCovariance(fields, step.result.motion ? &step.result.motion->covariance : nullptr);
    AddCovariance(fields, step.covariance ? &*step.covariance : nullptr);
    csv += report::CsvLine(fields);
  }
  return csv;
}

std::string TimesCsv(const OdometryResult& result) {
  Fields names{"pair"};
  for (const std::string_view stage : kPairStageNames) names.push_back(fmt::format("{}_ms", stage));
  std::string csv = report::CsvLine(names);
  for (const PathStep& step : result.steps) {
    Fields fields{std::to_string(step.pair)};
    for (const double seconds : step.seconds)
      fields.push_back(fmt::format("{:.3f}", 1e3 * seconds));
    csv += report::CsvLine(fields);
  }
  return csv;
}

std::string ErrorsCsv(const OdometryResult& result) {
  std::string csv = report::CsvLine(
      Fields{"pair", "true_x_m", "true_y_m", "true_z_m", "x_m", "y_m", "z_m", "error_m"});
  if (result.truth.empty()) return csv;
  const math::Transform X_TA = ToTruth(result);
  for (std::size_t i = 0; i < result.truth.size(); ++i) {
    const PathStep& step = result.steps[result.steps_with_truth[i]];
    const math::Vector3 truth = result.truth[i].translation();
    const math::Vector3 estimate = (X_TA * step.X_AB).translation();
    Fields fields{std::to_string(step.pair)};
    AddNumbers(fields, truth);
    AddNumbers(fields, estimate);
    fields.push_back(report::CsvNumber((truth - estimate).norm()));
    csv += report::CsvLine(fields);
  }
  return csv;
}

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

}  // namespace rockyard::campaign
