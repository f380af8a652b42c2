#include <cmath>

#include "core/json_pieces.h"
#include "core/json_text.h"
#include "report/page_data.h"
#include "report/sweep_curves.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonObject;

using statistics::LogisticFit;

std::string Points(const scenario::Sweep& sweep, const SweepSummary& summary,
                   const SweepCurve& curve, SuccessKind kind) {
  std::vector<std::string> points;
  for (std::size_t i = 0; i < curve.cells.size(); ++i) {
    const std::size_t cell = curve.cells[i];
    const SweepCellSummary& of = summary.cells[cell];
    const statistics::Proportion& rate =
        (kind == SuccessKind::kDeclared ? of.declared_success : of.true_success).rate;
    if (rate.trials == 0) continue;
    points.push_back(JsonObject()
                         .AddNumber("x", curve.x[i])
                         .AddNumber("rate", rate.rate)
                         .AddNumber("low", rate.interval.low)
                         .AddNumber("high", rate.interval.high)
                         .AddInteger("trials", rate.trials)
                         .AddText("cell", sweep.cells[cell].name)
                         .Text());
  }
  return JsonList(points);
}

std::string Line(const LogisticFit& fit) {
  std::vector<std::string> points;
  if (fit.status != statistics::FitStatus::kFitted) return JsonList(points);
  for (const FitPoint& point : FittedLine(fit)) {
    points.push_back(JsonObject()
                         .AddNumber("x", point.x)
                         .AddNumber("rate", point.rate)
                         .AddNumber("low", point.band.low)
                         .AddNumber("high", point.band.high)
                         .Text());
  }
  return JsonList(points);
}

const char* Status(statistics::FitStatus status) {
  switch (status) {
    case statistics::FitStatus::kFitted:
      return "fitted";
    case statistics::FitStatus::kTooFewPoints:
      return "fewer than two settings have finished trials";
    case statistics::FitStatus::kNoContrast:
      return "every trial ended alike";
    case statistics::FitStatus::kSeparated:
      return "successes and failures do not overlap: no curve is the likeliest";
  }
  return "";
}

const char* Rejected(const LogisticFit& fit) {
  if (fit.status != statistics::FitStatus::kFitted || !std::isfinite(fit.p_value)) return "null";
  return Misfits(fit) ? "true" : "false";
}

std::string Curve(const scenario::Sweep& sweep, const SweepSummary& summary,
                  const SweepCurve& curve, SuccessKind kind) {
  const scenario::SweepAxis& axis = sweep.axes[*sweep.fit_axis];
  const LogisticFit& fit = curve.fits[static_cast<std::size_t>(kind)];
  const bool log = sweep.fit_scale == scenario::AxisScale::kLog && curve.x.front() > 0.0;
  return JsonObject()
      .AddText("label", curve.label)
      .AddText("axis", axis.name)
      .AddText("unit", axis.unit)
      .AddText("scale", log ? "log" : "linear")
      .AddText("success", kind == SuccessKind::kDeclared ? "declared" : "true")
      .Add("points", Points(sweep, summary, curve, kind))
      .Add("fit", Line(fit))
      .AddText("fit_status", Status(fit.status))
      .Add("fit_rejected", Rejected(fit))
      .Text();
}

}  // namespace

std::string PageSweepJson(std::string_view label, std::string_view folder,
                          const scenario::Sweep& sweep, const SweepSummary& summary,
                          const SweepDescription& description) {
  std::vector<std::string> curves;
  for (const SweepCurve& curve : summary.curves) {
    for (const SuccessKind kind : {SuccessKind::kDeclared, SuccessKind::kTrue}) {
      curves.push_back(Curve(sweep, summary, curve, kind));
    }
  }
  return JsonObject()
      .AddText("label", label)
      .AddText("folder", folder)
      .Add("summary", core::CompactJson(SweepValue(sweep, summary, description)))
      .Add("curves", JsonList(curves))
      .Text();
}

}  // namespace rockyard::report
