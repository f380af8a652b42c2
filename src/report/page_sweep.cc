#include <array>
#include <cmath>

#include "core/json_text.h"
#include "report/json_members.h"
#include "report/page_data.h"
#include "report/sweep_curves.h"

namespace rockyard::report {
namespace {

using core::JsonList;

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
    points.push_back(ObjectText("x", curve.x[i], "rate", rate.rate, "low", rate.interval.low,
                                "high", rate.interval.high, "trials", rate.trials, "cell",
                                sweep.cells[cell].name));
  }
  return JsonList(points);
}

std::string Line(const LogisticFit& fit) {
  if (fit.status != statistics::FitStatus::kFitted) return "[]";
  return JsonList(FittedLine(fit), [](const FitPoint& point) {
    return ObjectText("x", point.x, "rate", point.rate, "low", point.band.low, "high",
                      point.band.high);
  });
}

// In the order of statistics::FitStatus.
constexpr std::array<std::string_view, 4> kStatusTexts{
    "fitted", "fewer than two settings have finished trials", "every trial ended alike",
    "successes and failures do not overlap: no curve is the likeliest"};

const char* Rejected(const LogisticFit& fit) {
  if (fit.status != statistics::FitStatus::kFitted || !std::isfinite(fit.p_value)) return "null";
  return Misfits(fit) ? "true" : "false";
}

std::string Curve(const scenario::Sweep& sweep, const SweepSummary& summary,
                  const SweepCurve& curve, SuccessKind kind) {
  const scenario::SweepAxis& axis = sweep.axes[*sweep.fit_axis];
  const LogisticFit& fit = curve.fits[static_cast<std::size_t>(kind)];
  const bool log = sweep.fit_scale == scenario::AxisScale::kLog && curve.x.front() > 0.0;
  return ObjectText(
      "label", curve.label, "axis", axis.name, "unit", axis.unit, "scale", log ? "log" : "linear",
      "success", kind == SuccessKind::kDeclared ? "declared" : "true", "points",
      Json{Points(sweep, summary, curve, kind)}, "fit", Json{Line(fit)}, "fit_status",
      kStatusTexts[static_cast<std::size_t>(fit.status)], "fit_rejected", Json{Rejected(fit)});
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
  return ObjectText("label", label, "folder", folder, "summary",
                    Json{core::CompactJson(SweepValue(sweep, summary, description))}, "curves",
                    Json{JsonList(curves)});
}

}  // namespace rockyard::report
