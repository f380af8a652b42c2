// Pages for a browser: one HTML file each, with everything in it.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::web {

enum class Page { kReport, kReplay, kBench };

// The page that shows `payload_json` (shapes: payload.ts in the folders report, replay and bench).
// The data is compressed (gzip) and in base64, so nothing in it can be read as markup; the title is
// escaped. Cost: about 20 ns per byte.
std::string MakePage(Page page, std::string_view title, std::string_view payload_json);

// Compression that every browser undoes by itself (RFC 1952). Equal bytes give equal bytes: no time
// and no name goes into the header. Throws std::runtime_error where memory is short.
std::string Gzip(std::string_view bytes);

// The pages as build.mjs made them (scripts/cmake/embed_pages.cmake).
extern const std::string_view kReportPage;
extern const std::string_view kReplayPage;
extern const std::string_view kBenchPage;

}  // namespace rockyard::web
