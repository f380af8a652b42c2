#include "web/page.h"

#include <cstddef>
#include <stdexcept>
#include <string>

#include "report/xml_text.h"
#include "web/base64.h"
#include "web/embedded_pages.h"
#include "web/gzip.h"

namespace rockyard::web {
namespace {

// Replaces the first mark; a page without it was not bundled by build.mjs.
void Fill(std::string& html, std::string_view mark, std::string_view value) {
  const std::size_t at = html.find(mark);
  if (at == std::string::npos) throw std::logic_error("a bundled page lacks a mark to fill in");
  html.replace(at, mark.size(), value);
}

}  // namespace

std::string MakePage(Page page, std::string_view title, std::string_view payload_json) {
  std::string html(page == Page::kReport ? kReportPage : kReplayPage);
  Fill(html, "<!-- title -->", report::EscapeXml(title));
  Fill(html, "<!-- payload -->", Base64(Gzip(payload_json)));
  return html;
}

}  // namespace rockyard::web
