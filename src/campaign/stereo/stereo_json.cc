#include "campaign/stereo/stereo_json.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/provenance.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

JsonValue ImageJson(const std::filesystem::path& path, const std::string& what) {
  return JsonValue::Object({{"file", path.string()}, {"what", what}});
}

JsonValue CamerasJson(const vision::RectifiedPair& cameras) {
  return JsonValue::Object({{"focal_px", cameras.focal_px}, {"baseline_m", cameras.baseline_m}});
}

JsonValue AlignmentJson(const vision::RowAlignment& alignment) {
  return JsonValue::Object({{"offset_px", alignment.correction.offset_px},
                            {"per_column", alignment.correction.per_column},
                            {"per_row", alignment.correction.per_row},
                            {"matches", alignment.matches},
                            {"agreeing", alignment.agreeing},
                            {"rms_px", alignment.rms_px}});
}

JsonValue PixelsJson(const StereoResult& result) {
  JsonValue dropped = JsonValue::Object();
  std::int64_t all = 0;
  for (std::size_t i = 0; i < result.counts.size(); ++i) {
    all += result.counts[i];
    if (i > 0) dropped.Set(vision::kDropNames[i], JsonValue(result.counts[i]));
  }
  return JsonValue::Object({{"all", all},
                            {"matched", result.counts[0]},
                            {"density", result.Density()},
                            {"dropped", std::move(dropped)}});
}

JsonValue ScoreJson(const vision::StereoScore& score) {
  JsonValue bad = JsonValue::Object();
  for (std::size_t i = 0; i < vision::kBadThresholds_px.size(); ++i) {
    bad.Set(fmt::format("above_{}_px", vision::kBadThresholds_px[i]), JsonValue(score.BadShare(i)));
  }
  return JsonValue::Object({{"known", score.known},
                            {"matched", score.matched},
                            {"density", score.Density()},
                            {"bad", std::move(bad)},
                            {"mean_error_px", score.mean_error_px},
                            {"rms_error_px", score.rms_error_px}});
}

}  // namespace

JsonValue StereoJson(const StereoRequest& request, const StereoResult& result) {
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("left", ImageJson(request.left, result.read.at(0)));
  json.Set("right", ImageJson(request.right, result.read.at(1)));
  json.Set("size",
           JsonValue::Object({{"columns", result.size.columns}, {"rows", result.size.rows}}));
  json.Set("cameras", result.cameras ? CamerasJson(*result.cameras) : JsonValue());
  json.Set("alignment", result.alignment ? AlignmentJson(*result.alignment) : JsonValue());
  json.Set("parameters", core::WriteParams(result.params));
  json.Set("pixels", PixelsJson(result));
  json.Set("score", result.score ? ScoreJson(*result.score) : JsonValue());
  json.Set("points", JsonValue(result.points));
  json.Set("notes", core::ListOf(result.notes));
  json.Set("files", FilesJson(result.files));
  json.Set("program", JsonValue(core::VersionLine()));
  return json;
}

}  // namespace rockyard::campaign
