// Asking navigators of plugins and processes in tests: parameters from JSON, what an overlay shows,
// and how a call failed.
#pragma once

#include <gmock/gmock.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/archive.h"
#include "core/json_text.h"
#include "navigation/navigator.h"
#include "navigation/navigator_fault.h"
#include "plugin/foreign_navigator.h"

namespace rockyard::plugin {

// The parameters of a navigator, with what the JSON states.
inline Parameters ParametersOf(const NavigatorSource& source, std::string_view json = "{}") {
  Parameters parameters(source.description());
  core::ReadParams(core::ParseJson(json, "test"), parameters);
  return parameters;
}

inline std::unique_ptr<navigation::Navigator> Make(const NavigatorSource& source,
                                                   std::string_view json = "{}",
                                                   const navigation::NavigatorSetup& setup = {}) {
  return source.Make(ParametersOf(source, json), setup);
}

// The lines of an overlay: the name of each, and the x of its first point.
inline std::map<std::string, double> Shown(const navigation::Navigator& navigator) {
  std::map<std::string, double> shown;
  const messages::Overlay* overlay = navigator.overlay();
  if (overlay == nullptr) return shown;
  for (const messages::OverlayLine& line : overlay->lines) {
    shown[line.name] = line.points.empty() ? 0.0 : line.points.front().x_m;
  }
  return shown;
}

inline constexpr std::array<std::string_view, 7> kFaultNames{
    "threw", "nonsense", "message", "ended", "cpu_time", "memory", "silent"};

// "ended: TEXT" of the fault that the call throws; "" where it throws none.
template <typename Call>
std::string FaultOf(const Call& call) {
  try {
    call();
  } catch (const navigation::NavigatorFault& fault) {
    return std::string(kFaultNames[static_cast<std::size_t>(fault.kind())]) + ": " + fault.what();
  }
  return "";
}

// Matches a text of FaultOf.
inline auto IsFault(navigation::FaultKind kind, const std::string& words) {
  return testing::AllOf(
      testing::StartsWith(std::string(kFaultNames[static_cast<std::size_t>(kind)]) + ": "),
      testing::HasSubstr(words));
}

}  // namespace rockyard::plugin
