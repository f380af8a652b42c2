// The axes of sweep files. Internal to scenario's sweep files.
#pragma once

#include <string>
#include <vector>

#include "core/field_table.h"
#include "core/json_value.h"
#include "scenario/sweep_parts.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {

class AxisReader {
 public:
  // `parts` must outlive this.
  explicit AxisReader(PartReader& parts);

  // An element of "axes", which stands at `path`. Names of scenario files in it are replaced by
  // what the files hold.
  AxisSpec Read(core::JsonValue& value, const std::string& path);

 private:
  void ReadLevels(core::JsonValue& value, const AxisParams& params, const std::string& path,
                  AxisSpec& axis);
  void ReadValues(core::JsonValue& value, const std::string& path, AxisSpec& axis);
  void ReadScenarios(core::JsonValue& value, const std::string& path, AxisSpec& axis);
  void ReadAblation(const AxisParams& params, AxisSpec& axis);
  void ReadRange(const core::JsonValue& value, const AxisParams& params, const std::string& path,
                 AxisSpec& axis);
  // What is known of the parameter that an axis varies; nullptr where the path names none.
  const core::ParameterInfo* Describe(const std::string& path, AxisSpec& axis);
  bool IsGroup(const std::string& path) const;
  std::string Nearest(const std::string& path) const;
  void CheckLevels(const AxisSpec& axis, const std::string& path);

  PartReader& parts_;
  std::vector<core::ParameterInfo> parameters_;
};

}  // namespace rockyard::scenario
