#include "terrain/field_export.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "core/json_text.h"
#include "core/json_value.h"
#include "math/angles.h"
#include "terrain/arena.h"

namespace rockyard::terrain {
namespace {

using core::JsonValue;

// Mirror images follow the placed rocks; a rock at the goal is the last of all.
bool IsMirrorImage(const FieldAudit& audit, std::ptrdiff_t index) {
  return index >= audit.placed && index < audit.placed + audit.mirror_images;
}

JsonValue RockJson(const Rock& rock, bool mirror_image) {
  JsonValue json = JsonValue::Object();
  json.Append("mirror_image", JsonValue(mirror_image));
  json.Append("center_m",
              JsonValue(JsonValue::List{JsonValue(rock.center_W.x()), JsonValue(rock.center_W.y()),
                                        JsonValue(rock.center_W.z())}));
  json.Append("semi_axes_m", JsonValue(JsonValue::List{JsonValue(rock.semi_axes_m.x()),
                                                       JsonValue(rock.semi_axes_m.y()),
                                                       JsonValue(rock.semi_axes_m.z())}));
  json.Append("yaw_deg", JsonValue(math::RadToDeg(rock.yaw_rad)));
  json.Append("diameter_m", JsonValue(rock.diameter_m));
  json.Append("height_m", JsonValue(rock.height_m));
  json.Append("cap_growth", JsonValue(rock.cap_growth));
  return json;
}

JsonValue RectangleJson(const Rectangle& r) {
  JsonValue json = JsonValue::Object();
  json.Append("x_m", JsonValue(JsonValue::List{JsonValue(r.x_min_m), JsonValue(r.x_max_m)}));
  json.Append("y_m", JsonValue(JsonValue::List{JsonValue(r.y_min_m), JsonValue(r.y_max_m)}));
  return json;
}

JsonValue AuditJson(const FieldAudit& audit) {
  const auto whole = [](int value) { return JsonValue(std::int64_t{value}); };
  JsonValue json = JsonValue::Object();
  json.Append("layout_area_m2", JsonValue(audit.layout_area_m2));
  json.Append("expected_drawn", JsonValue(audit.expected_drawn));
  json.Append("drawn", whole(audit.drawn));
  json.Append("dropped_in_clear_zones", whole(audit.dropped_in_clear_zones));
  json.Append("dropped_for_overlap", whole(audit.dropped_for_overlap));
  json.Append("relocated", whole(audit.relocated));
  json.Append("expected_placed", JsonValue(audit.expected_placed));
  json.Append("placed", whole(audit.placed));
  json.Append("mirror_images", whole(audit.mirror_images));
  json.Append("expected_cover", JsonValue(audit.expected_cover));
  json.Append("disc_cover", JsonValue(audit.disc_cover));
  json.Append("outline_cover", JsonValue(audit.outline_cover));
  json.Append("detectable_per_m2", JsonValue(audit.detectable_per_m2));
  json.Append("belly_high_per_m2", JsonValue(audit.belly_high_per_m2));
  return json;
}

JsonValue PointJson(double x_m, double y_m) {
  return JsonValue(JsonValue::List{JsonValue(x_m), JsonValue(y_m)});
}

}  // namespace

std::string ToCsv(const Field& field) {
  std::string text =
      "rock,mirror_image,center_x_m,center_y_m,center_z_m,semi_axis_x_m,semi_axis_y_m,"
      "semi_axis_z_m,yaw_deg,diameter_m,height_m,cap_growth\n";
  int index = 0;
  for (const Rock& rock : field.terrain.rocks()) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{}\n", index,
                   IsMirrorImage(field.audit, index) ? 1 : 0, rock.center_W.x(), rock.center_W.y(),
                   rock.center_W.z(), rock.semi_axes_m.x(), rock.semi_axes_m.y(),
                   rock.semi_axes_m.z(), math::RadToDeg(rock.yaw_rad), rock.diameter_m,
                   rock.height_m, rock.cap_growth);
    ++index;
  }
  return text;
}

std::string ToJson(const Field& field, const TerrainParams& params, const Course& course) {
  JsonValue json = JsonValue::Object();
  json.Append("schema_version", JsonValue(std::int64_t{1}));
  json.Append("arena", RectangleJson(ArenaBounds(params.arena)));
  json.Append("drivable", RectangleJson(DrivableBounds(params.arena)));
  if (params.arena.IsVirtual()) {
    json.Append("mirror_lines_y_m",
                PointJson(-params.arena.MirrorLine(), params.arena.MirrorLine()));
  }
  json.Append("start_m", PointJson(course.start_x_m, course.start_y_m));
  JsonValue::List waypoints;
  for (const CoursePoint& point : course.waypoints) {
    waypoints.push_back(PointJson(point.x_m, point.y_m));
  }
  if (!waypoints.empty()) json.Append("waypoints_m", JsonValue(std::move(waypoints)));
  json.Append("goal_m", PointJson(course.goal_x_m, course.goal_y_m));
  json.Append("audit", AuditJson(field.audit));
  JsonValue::List rocks;
  for (const Rock& rock : field.terrain.rocks()) {
    rocks.push_back(RockJson(rock, IsMirrorImage(field.audit, std::ssize(rocks))));
  }
  json.Append("rocks", JsonValue(std::move(rocks)));
  return core::DumpJson(json);
}

}  // namespace rockyard::terrain
