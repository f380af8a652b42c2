// The page of standings: what `rockyard bench report --out` writes as index.html.
#pragma once

#include <string>
#include <string_view>

#include "campaign/bench/bench_standings.h"

namespace rockyard::campaign {

// Returns its data, `BenchPayload` of web/bench/payload.ts. `command`: what wrote it.
std::string BenchPageJson(const Standings& standings, std::string_view command);

// Returns the page: one HTML file that fetches nothing.
std::string BenchPage(const Standings& standings, std::string_view command);

}  // namespace rockyard::campaign
