#include "campaign/odometry/odometry_json.h"

#include <string>
#include <utility>

#include "core/archive.h"
#include "core/provenance.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

JsonValue SummaryJson(const std::optional<vision::ErrorSummary>& summary, double scale = 1.0) {
  if (!summary) return JsonValue();
  return JsonValue::Object({{"count", summary->count},
                            {"rms", scale * summary->rms},
                            {"mean", scale * summary->mean},
                            {"median", scale * summary->median},
                            {"largest", scale * summary->largest}});
}

JsonValue SegmentsJson(const OdometryRequest& request, const PathErrors& errors) {
  if (!errors.segments) return JsonValue();
  JsonValue json = JsonValue::Object(
      {{"segments", errors.segments->segments},
       {"translation_percent", 100.0 * errors.segments->translation},
       {"rotation_deg_per_m", math::RadToDeg(errors.segments->rotation_rad_per_m)}});
  json.Set("lengths_m", request.lengths_m.empty() ? core::ListOf(vision::kKittiLengths_m)
                                                  : core::ListOf(request.lengths_m));
  return json;
}

JsonValue PathErrorsJson(const OdometryRequest& request, const OdometryResult& result) {
  if (!result.errors) return JsonValue();
  const PathErrors& errors = *result.errors;
  const double to_deg = math::RadToDeg(1.0);
  JsonValue json = JsonValue::Object(
      {{"pairs", errors.pairs}, {"distance_m", errors.distance_m}, {"end_m", errors.end_error_m}});
  json.Set("end_percent", core::NumberOrNull(100.0 * errors.end_error_m / errors.distance_m));
  json.Set("segments", SegmentsJson(request, errors));
  json.Set("absolute_first_pose_m", SummaryJson(errors.absolute_first_m));
  json.Set("absolute_rigid_m", SummaryJson(errors.absolute_rigid_m));
  json.Set("relative_delta", JsonValue(request.delta));
  json.Set("relative_m", SummaryJson(errors.relative_m));
  json.Set("relative_deg", SummaryJson(errors.relative_rad, to_deg));
  json.Set("normalized", SummaryJson(errors.normalized));
  json.Set("normalized_above_95", JsonValue(errors.normalized_above_95));
  return json;
}

JsonValue TimesJson(const OdometryResult& result) {
  JsonValue json = JsonValue::Object();
  for (std::size_t i = 0; i < kPairStageNames.size(); ++i) {
    const auto times = StageTimes(result, static_cast<PairStage>(i));
    json.Set(kPairStageNames[i], times ? JsonValue::Object({{"median_ms", 1e3 * times->median},
                                                            {"largest_ms", 1e3 * times->largest}})
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
  JsonValue json = JsonValue::Object({{"path", request.sequence.string()},
                                      {"layout", result.layout},
                                      {"pairs", result.pairs_there},
                                      {"image", result.read}});
  json.Set("first", JsonValue(request.first));
  json.Set("every", JsonValue(request.every));
  return json;
}

}  // namespace

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
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("sequence", SequenceJson(request, result));
  json.Set("cameras", JsonValue::Object({{"focal_px", result.cameras.focal_px},
                                         {"baseline_m", result.cameras.baseline_m},
                                         {"columns", result.cameras.size.columns},
                                         {"rows", result.cameras.size.rows},
                                         {"resampled", result.resampled}}));
  json.Set("seed", JsonValue(static_cast<std::int64_t>(request.seed)));
  json.Set("prediction", JsonValue(NameOf(request.prediction)));
  json.Set("parameters", core::WriteParams(result.params));
  json.Set("interrupted", JsonValue(result.outcome == Outcome::kInterrupted));
  json.Set("pairs", JsonValue(std::ssize(result.steps)));
  json.Set("gaps", JsonValue(result.Gaps()));
  json.Set("reasons", ReasonsJson(result));
  json.Set("distance_m", JsonValue(result.Distance_m()));
  json.Set("errors", PathErrorsJson(request, result));
  json.Set("times", TimesJson(result));
  json.Set("notes", core::ListOf(result.notes));
  json.Set("files", FilesJson(result.files));
  json.Set("program", JsonValue(core::VersionLine()));
  return json;
}

}  // namespace rockyard::campaign
