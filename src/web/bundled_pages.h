// The pages as build.mjs made them, or empty where they were not built.
#pragma once

#include <string_view>

namespace rockyard::web {

extern const std::string_view kReportPage;
extern const std::string_view kReplayPage;

}  // namespace rockyard::web
