#include "campaign/report.h"

#include <fmt/format.h>

#include "campaign/campaign_process.h"
#include "campaign/output_folder.h"
#include "campaign/report_build.h"
#include "campaign/report_inputs.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// "report.html" in the folder that was named first.
std::string PageFile(const ReportRequest& request) {
  return request.page.empty() ? (fs::path(request.runs.front()) / "report.html").string()
                              : request.page;
}

// Before the work: what cannot be meant.
void CheckFile(const char* option, const std::string& file, const char* extension) {
  CheckOutputFile(option, file);
  CheckExtension(option, file, extension);
}

void CheckFiles(const ReportRequest& request) {
  CheckFile("--out", PageFile(request), ".html");
  if (!request.data.empty()) CheckFile("--data", request.data, ".json");
}

void WritePage(const ReportRequest& request, const PageRequest& page, const Report& report,
               ReportResult& result) {
  if (!request.data.empty()) {
    report::WriteFileAtomically(request.data, report.json);
    result.data_bytes = report.json.size();
  }
  const std::string html = web::MakePage(web::Page::kReport, report.title, report.json);
  report::WriteFileAtomically(page.page, html);
  result.page_bytes = html.size();
}

Outcome Write(const ReportRequest& request, const ReportObserver& observer, const Contact& contact,
              ReportResult& result) {
  PageRequest page{.inputs = FindReportInputs(request.runs, request.cell),
                   .title = request.title,
                   .command = request.command,
                   .against = request.against,
                   .replays = request.replays,
                   .page = PageFile(request),
                   .progress = observer.replays,
                   .tracks = request.tracks,
                   .track_progress = observer.tracks};
  CheckFiles(request);
  result.page = page.page;
  const Report report = BuildReport(page, contact);
  result.runs = report.runs;
  result.trials = report.trials;
  result.replays = report.replays;
  try {
    WritePage(request, page, report, result);
  } catch (const core::UserError& failure) {
    // A disk that fails after the work, not input that is wrong before it.
    contact.journal.Fail(failure.problems());
    if (report.replays.written > 0) {
      contact.journal.Warn(fmt::format("{} replays are written, in {}", report.replays.written,
                                       report.replays.folder.string()));
    }
    return Outcome::kFailed;
  }
  return report.replays.outcome;
}

}  // namespace

ReportResult WriteReport(const ReportRequest& request, const ReportObserver& observer,
                         const Stop& stop) {
  ReportResult result;
  static_cast<WorkResult&>(result) = Recorded(observer, [&](Journal& journal) {
    return Write(request, observer, {journal, stop}, result);
  });
  return result;
}

}  // namespace rockyard::campaign
