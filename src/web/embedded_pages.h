// The pages as build.mjs made them (scripts/cmake/embed_pages.cmake).
#pragma once

#include <string_view>

namespace rockyard::web {

extern const std::string_view kReportPage;
extern const std::string_view kReplayPage;

}  // namespace rockyard::web
