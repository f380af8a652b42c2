#include "rover/urdf_reader/urdf_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace rockyard::rover {

double WithoutRounding_m(double length_m) {
  constexpr double kPicometres = 1e12;
  return std::round(length_m * kPicometres) / kPicometres + 0.0;  // no minus before zero
}

double TwelveDigits(double value) {
  return core::FiniteNumber(fmt::format("{:.12g}", value)).value_or(value) + 0.0;
}

void UrdfDraft::CarryAgreed(std::string_view path, double& field,
                            const std::vector<ToldValue>& told, double tolerance) {
  if (told.empty()) return;
  const auto [least, most] =
      std::minmax_element(told.begin(), told.end(),
                          [](const ToldValue& a, const ToldValue& b) { return a.value < b.value; });
  // The mean of equal numbers need not be the same double.
  double value = least->value;
  if (most->value > least->value) {
    value = 0.0;
    for (const ToldValue& each : told) value += each.value / static_cast<double>(told.size());
  }
  if (most->value - least->value > tolerance) {
    findings.NotTaken(most->place,
                      fmt::format("makes {} {:.6g}, where others make it {:.6g}: rockyard's rover "
                                  "has one for all, and takes the mean {:.6g}",
                                  path, most->value, least->value, value));
  }
  Carry(path, field, value, least->place);
}

void UrdfDraft::CarryLength(std::string_view path, double& field, std::vector<ToldValue> told,
                            double tolerance_m) {
  for (ToldValue& each : told) each.value = WithoutRounding_m(each.value);
  CarryAgreed(path, field, told, tolerance_m);
}

}  // namespace rockyard::rover
