#include "rover/urdf_reader/urdf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/archive.h"
#include "rover/urdf_reader/urdf_draft.h"
#include "rover/urdf_reader/urdf_findings.h"
#include "rover/urdf_reader/urdf_model.h"
#include "rover/urdf_reader/urdf_skeleton.h"

namespace rockyard::rover {
namespace {

constexpr std::string_view kRoverGroup = "rover.";

// Removes what is not told, and groups in which nothing is left. `prefix` is the path of `group`
// with a dot behind it, unless it is empty.
void KeepTold(core::JsonValue& group, const std::string& prefix,
              const std::map<std::string, std::string>& told) {
  core::JsonValue::Members& members = group.members();
  std::erase_if(members, [&](core::JsonMember& member) {
    const std::string path = prefix + member.key;
    if (!member.value.Is(core::JsonValue::Type::kObject)) return !told.contains(path);
    KeepTold(member.value, path + ".", told);
    return member.value.members().empty();
  });
}

}  // namespace

std::vector<core::Problem> UrdfReading::WithPlaces(std::vector<core::Problem> problems) const {
  for (core::Problem& problem : problems) {
    std::string_view path = problem.path;
    if (path.starts_with(kRoverGroup)) path.remove_prefix(kRoverGroup.size());
    const auto found = places.find(std::string(path));
    if (found == places.end()) continue;
    problem.reason += fmt::format(" (from {})", found->second);
  }
  return problems;
}

UrdfReading ReadUrdf(std::string_view text, std::string_view source_name) {
  UrdfFindings findings(source_name);
  const UrdfModel model = ParseUrdf(text, source_name, findings);
  const UrdfSkeleton skeleton = FindSkeleton(model, findings);
  UrdfDraft draft{.model = model, .skeleton = skeleton, .findings = findings};
  ReadUrdfWheels(draft);
  ReadUrdfArms(draft);
  ReadUrdfBody(draft);
  ReadUrdfMasses(draft);
  ReadUrdfJoints(draft);

  UrdfReading reading;
  reading.robot = model.name;
  reading.params = draft.params;
  reading.group = core::WriteParams(draft.params);
  KeepTold(reading.group, "", draft.places);
  const core::FieldTable table = core::ListParams<RoverParams>();
  for (const core::ParameterInfo& parameter : table.parameters()) {
    if (!draft.places.contains(parameter.path)) reading.left_out.push_back(parameter);
  }
  reading.not_taken = findings.not_taken();
  reading.places = std::move(draft.places);
  return reading;
}

}  // namespace rockyard::rover
