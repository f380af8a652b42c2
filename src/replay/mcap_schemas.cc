#include "replay/mcap_schemas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/json_pieces.h"
#include "core/json_text.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonObject;

struct NamedText {
  std::string_view name;
  std::string_view text;
};

constexpr auto kPlainTypes = std::to_array<NamedText>({
    {"text", R"({"type":"string"})"},
    {"bytes", R"({"type":"string","contentEncoding":"base64"})"},
    {"number", R"({"type":"number"})"},
    {"integer", R"({"type":"integer"})"},
    {"count", R"({"type":"integer","minimum":0})"},
    {"flag", R"({"type":"boolean"})"},
    {"time",
     R"({"title":"time","type":"object","properties":{"sec":{"type":"integer","minimum":0},)"
     R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})"},
    {"duration", R"({"title":"duration","type":"object","properties":{"sec":{"type":"integer"},)"
                 R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})"},
});

// What is named below without a "." is Foxglove's.

// The names of the numbers from 0 on.
constexpr auto kEnums = std::to_array<NamedText>({
    {"NumericType", "UNKNOWN UINT8 INT8 UINT16 INT16 UINT32 INT32 FLOAT32 FLOAT64"},
    {"LineType", "LINE_STRIP LINE_LOOP LINE_LIST"},
    {"SceneEntityDeletionType", "MATCHING_ID ALL"},
    {"LogLevel", "UNKNOWN DEBUG INFO WARNING ERROR FATAL"},
});

// Members as NAME:TYPE, a type in brackets for a list of it, NAME?:TYPE where it may be left out.
constexpr auto kObjects = std::to_array<NamedText>({
    {"Vector2", "x:number y:number"},
    {"Vector3", "x:number y:number z:number"},
    {"Point3", "x:number y:number z:number"},
    {"Quaternion", "x:number y:number z:number w:number"},
    {"Color", "r:number g:number b:number a:number"},
    {"Pose", "position:Vector3 orientation:Quaternion"},
    {"PoseInFrame", "timestamp:time frame_id:text pose:Pose"},
    {"FrameTransform",
     "timestamp:time parent_frame_id:text child_frame_id:text translation:Vector3 "
     "rotation:Quaternion"},
    {"FrameTransforms", "transforms:[FrameTransform]"},
    {"JointState",
     "name:text position?:number velocity?:number acceleration?:number effort?:number"},
    {"JointStates", "timestamp:time joints:[JointState]"},
    {"PackedElementField", "name:text offset:count type:NumericType"},
    {"PointCloud",
     "timestamp:time frame_id:text pose:Pose point_stride:count fields:[PackedElementField] "
     "data:bytes"},
    {"Grid",
     "timestamp:time frame_id:text pose:Pose column_count:count cell_size:Vector2 "
     "row_stride:count cell_stride:count fields:[PackedElementField] data:bytes"},
    {"CompressedImage", "timestamp:time frame_id:text data:bytes format:text"},
    {"Log", "timestamp:time level:LogLevel message:text name:text file:text line:count"},
    {"KeyValuePair", "key:text value:text"},
    {"ArrowPrimitive",
     "pose:Pose shaft_length:number shaft_diameter:number head_length:number "
     "head_diameter:number color:Color"},
    {"CubePrimitive", "pose:Pose size:Vector3 color:Color"},
    {"SpherePrimitive", "pose:Pose size:Vector3 color:Color"},
    {"CylinderPrimitive",
     "pose:Pose size:Vector3 bottom_scale:number top_scale:number color:Color"},
    {"LinePrimitive",
     "type:LineType pose:Pose thickness:number scale_invariant:flag points:[Point3] color:Color "
     "colors:[Color] indices:[count]"},
    {"TriangleListPrimitive",
     "pose:Pose points:[Point3] color:Color colors:[Color] indices:[count]"},
    {"TextPrimitive",
     "pose:Pose billboard:flag font_size:number scale_invariant:flag color:Color text:text"},
    {"ModelPrimitive",
     "pose:Pose scale:Vector3 color:Color override_color:flag url:text media_type:text data:bytes"},
    {"SceneEntityDeletion", "timestamp:time type:SceneEntityDeletionType id:text"},
    {"SceneEntity",
     "timestamp:time frame_id:text id:text lifetime:duration frame_locked:flag "
     "metadata:[KeyValuePair] arrows:[ArrowPrimitive] cubes:[CubePrimitive] "
     "spheres:[SpherePrimitive] cylinders:[CylinderPrimitive] lines:[LinePrimitive] "
     "triangles:[TriangleListPrimitive] texts:[TextPrimitive] models:[ModelPrimitive]"},
    {"SceneUpdate", "deletions:[SceneEntityDeletion] entities:[SceneEntity]"},
    {"rockyard.State", "timestamp:time activity:text tilt_rad:number"},
    // Votes from 0 to 255; curvature 1/m, positive to the left, of a turn its direction.
    {"rockyard.Vote",
     "kind:text curvature:number hazard:number certainty:number waypoint:number merged:number "
     "chosen:flag"},
    {"rockyard.Votes", "timestamp:time step:integer behind:flag votes:[rockyard.Vote]"},
});

std::vector<std::string> WordsOf(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <typename Rows>
const NamedText* Find(const Rows& rows, std::string_view name) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [name](const NamedText& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

std::string TitleOf(const NamedText& row) {
  return (row.name.find('.') == std::string_view::npos ? "foxglove." : "") + std::string(row.name);
}

std::string EnumSchema(const NamedText& row) {
  std::int64_t number = 0;
  const std::string values = JsonList(WordsOf(row.text), [&](const std::string& word) {
    return JsonObject().AddText("title", word).AddInteger("const", number++).Text();
  });
  return JsonObject().AddText("title", TitleOf(row)).Add("oneOf", values).Text();
}

std::string TypeSchema(std::string_view type);

std::string ObjectSchema(const NamedText& row) {
  JsonObject properties;
  std::vector<std::string> required;
  for (const std::string& member : WordsOf(row.text)) {
    const std::size_t colon = member.find(':');
    const bool optional = member[colon - 1] == '?';
    const std::string name = member.substr(0, colon - (optional ? 1 : 0));
    properties.Add(name, TypeSchema(std::string_view(member).substr(colon + 1)));
    if (!optional) required.push_back(name);
  }
  return JsonObject()
      .AddText("title", TitleOf(row))
      .AddText("type", "object")
      .Add("properties", properties.Text())
      .Add("required", core::JsonTexts(required))
      .Text();
}

std::string TypeSchema(std::string_view type) {
  if (type.starts_with('[')) {
    const std::string items = TypeSchema(type.substr(1, type.size() - 2));
    return JsonObject().AddText("type", "array").Add("items", items).Text();
  }
  if (const NamedText* row = Find(kPlainTypes, type)) return std::string(row->text);
  if (const NamedText* row = Find(kEnums, type)) return EnumSchema(*row);
  if (const NamedText* row = Find(kObjects, type)) return ObjectSchema(*row);
  throw std::logic_error(fmt::format("no schema {}", type));
}

}  // namespace

std::string McapSchema(std::string_view name) {
  constexpr std::string_view kFoxglove = "foxglove.";
  return TypeSchema(name.starts_with(kFoxglove) ? name.substr(kFoxglove.size()) : name);
}

}  // namespace rockyard::replay
