#include "campaign/cylinder/cylinder_json.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "core/provenance.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

template <typename Enum>
std::string NameIn(Enum value) {
  return std::string(core::EnumNames<Enum>::kNames.at(static_cast<std::size_t>(value)));
}

JsonValue RegionJson(const vision::ColourRegion& region) {
  JsonValue json = JsonValue::Object({{"role", NameIn(region.role)},
                                      {"left", region.left},
                                      {"top", region.top},
                                      {"right", region.right},
                                      {"bottom", region.bottom},
                                      {"pixels", region.pixels}});
  json.Set("colour", region.colour ? JsonValue(NameIn(*region.colour)) : JsonValue());
  json.Set("centroid", core::ListOf(std::vector{region.centroid.x(), region.centroid.y()}));
  return json;
}

JsonValue SightingJson(const vision::CylinderSighting& sighting) {
  JsonValue json = JsonValue::Object();
  json.Set("orientation_deg", JsonValue(math::RadToDeg(sighting.orientation_rad)));
  const math::Vector3& p = sighting.p_LT_L;
  json.Set("position_m", core::ListOf(std::vector{p.x(), p.y(), p.z()}));
  json.Set("distance_by_stereo_m", JsonValue(sighting.distance_by_stereo_m));
  json.Set("distance_by_size_m", JsonValue(sighting.distance_by_size_m));
  JsonValue::List rows;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d row = sighting.covariance.row(i);
    rows.push_back(core::ListOf(std::vector<double>(row.data(), row.data() + row.size())));
  }
  json.Set("covariance", JsonValue(std::move(rows)));
  JsonValue regions = JsonValue::Object();
  regions.Set("left", core::ListOf(sighting.regions[0], RegionJson));
  regions.Set("right", core::ListOf(sighting.regions[1], RegionJson));
  json.Set("regions", std::move(regions));
  return json;
}

}  // namespace

JsonValue CylinderJson(const CylinderRequest& request, const CylinderResult& result) {
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("left", JsonValue::Object({{"file", request.left.string()}, {"what", result.read[0]}}));
  json.Set("right",
           JsonValue::Object({{"file", request.right.string()}, {"what", result.read[1]}}));
  json.Set("finder",
           JsonValue(request.finder == CylinderFinder::kPublished ? "published" : "robust"));
  json.Set("parameters", core::WriteParams(result.params));
  const vision::CylinderFinding& finding = result.finding;
  json.Set("found", JsonValue(finding.sighting.has_value()));
  json.Set("miss", finding.sighting ? JsonValue() : JsonValue(NameIn(finding.miss)));
  json.Set("reason", finding.sighting ? JsonValue() : JsonValue(finding.reason));
  json.Set("sighting", finding.sighting ? SightingJson(*finding.sighting) : JsonValue());
  json.Set("files", FilesJson(result.files));
  json.Set("program", JsonValue(core::VersionLine()));
  return json;
}

}  // namespace rockyard::campaign
