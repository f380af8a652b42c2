#include "campaign/plan_view.h"

#include "report/trace_drawing.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/layout.h"

namespace rockyard::campaign {

std::string PlanView(const scenario::Scenario& scenario, const truth::TracedTrial& traced) {
  const terrain::Rectangle all = terrain::DrivableBounds(scenario.drive.terrain.arena);
  const report::TraceDrawing drawing =
      report::DrawTrace(traced, {all.x_min_m, all.x_max_m, all.y_min_m, all.y_max_m});
  const report::DrawnArea& area = drawing.area;
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  const core::TrialKey key{traced.seed, static_cast<std::uint32_t>(traced.record.trial)};
  const terrain::Field field =
      terrain::BuildField(scenario.drive.terrain, trial::LayoutKey(scenario.drive, key), course);
  return terrain::ToSvg(
      field, scenario.drive.terrain, course,
      {drawing.elements, {area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m}});
}

}  // namespace rockyard::campaign
