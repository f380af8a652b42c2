#include "web/page.h"

#include <cstddef>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "report/xml_text.h"
#include "web/base64.h"
#include "web/bundled_pages.h"
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

bool PagesBuilt() { return !kReportPage.empty() && !kReplayPage.empty(); }

std::string MakePage(Page page, std::string_view title, std::string_view payload_json) {
  if (!PagesBuilt()) {
    throw core::UserError("page", "this build of the program has no pages for a browser",
                          "install nodejs and npm (scripts/install_dependencies.sh pages), "
                          "configure again and build");
  }
  std::string html(page == Page::kReport ? kReportPage : kReplayPage);
  Fill(html, "<!-- title -->", report::EscapeXml(title));
  Fill(html, "<!-- payload -->", Base64(Gzip(payload_json)));
  return html;
}

}  // namespace rockyard::web
