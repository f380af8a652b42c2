#include "campaign/plan_view.h"

#include "report/trace_drawing.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/layout.h"

namespace rockyard::campaign {

std::string PlanView(const scenario::Scenario& scenario, const report::TracedTrial& traced) {
  const terrain::Rectangle all = terrain::DrivableBounds(scenario.terrain.arena);
  const report::TraceDrawing drawing =
      report::DrawTrace(traced, {all.x_min_m, all.x_max_m, all.y_min_m, all.y_max_m});
  const report::DrawnArea& area = drawing.area;
  const terrain::Course course = trial::TerrainCourse(scenario.course);
  const core::TrialKey key{traced.seed, static_cast<std::uint32_t>(traced.record.trial)};
  const terrain::Field field =
      terrain::BuildField(scenario.terrain, trial::LayoutKey(scenario, key), course);
  return terrain::ToSvg(
      field, scenario.terrain, course,
      {drawing.elements, {area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m}});
}

}  // namespace rockyard::campaign
