#include <fmt/format.h>

#include <utility>

#include "scenario/sweep_axes.h"
#include "scenario/sweep_parts.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {

SweepSpec ReadSweepSpec(core::JsonValue document, const std::filesystem::path& folder,
                        std::vector<core::Problem>& problems) {
  PartReader parts(folder, problems);
  AxisReader axes(parts);
  SweepSpec spec;
  spec.document = std::move(document);
  spec.params = parts.Fixed<SweepParams>(spec.document, "", kFreeSweepKeys);
  parts.CheckName(spec.params.name, "name");
  spec.scenario = parts.Base(spec.document, "");
  spec.settings = parts.Settings(spec.document.Find("set"), "set");
  for (core::JsonValue* axis : parts.Elements(spec.document, "axes", "")) {
    spec.axes.push_back(axes.Read(*axis, fmt::format("axes[{}]", spec.axes.size())));
  }
  for (core::JsonValue* cell : parts.Elements(spec.document, "cells", "")) {
    spec.cells.push_back(parts.Level(*cell, fmt::format("cells[{}]", spec.cells.size())));
  }
  return spec;
}

}  // namespace rockyard::scenario
