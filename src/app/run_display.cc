#include "app/run_display.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "app/console.h"
#include "app/interrupt.h"
#include "app/next_command.h"
#include "app/progress_line.h"
#include "app/show_report.h"

namespace rockyard::app {
namespace {

void ShowProgress(campaign::RunObserver& observer) {
  using campaign::Moment;
  const auto trials = std::make_shared<ProgressLine>(stderr);
  observer.trials = [trials](const batch::Progress& progress, Moment moment) {
    moment == Moment::kEnd ? trials->Finish(progress) : trials->Show(progress);
  };
  const auto traces = std::make_shared<ProgressLine>(stderr);
  observer.traces = [traces](const campaign::TraceProgress& progress, Moment moment) {
    const std::string text =
        fmt::format("  traces: {}/{} written", progress.written, progress.total);
    moment == Moment::kEnd ? traces->FinishText(text) : traces->ShowText(text);
  };
}

}  // namespace

campaign::Observer MessagesToConsole(Output output) {
  const auto note = [output](const campaign::Note& told) {
    if (output != Output::kQuiet || told.kind == campaign::NoteKind::kWarning) PrintNote(told.text);
  };
  return {.note = note, .problems = PrintProblems};
}

campaign::RunObserver ShowRun(const CampaignOptions& options, SharedFlag& output_failed) {
  campaign::RunObserver observer;
  static_cast<campaign::Observer&>(observer) = MessagesToConsole(options.output());
  if (options.output() != Output::kQuiet) ShowProgress(observer);
  observer.reported = [&](const campaign::FolderReport& report, batch::BatchEnd end) {
    const bool stopped = end == batch::BatchEnd::kStopped;
    ShowReport(report, {.output = options.output(),
                        .resume = stopped ? options.resume_command : "",
                        .next = stopped || options.request.traces.rules.empty()});
    if (OutputFailed()) output_failed.Set();
  };
  if (options.output() == Output::kText) {
    observer.traced = [&](const std::filesystem::path& folder, ExitCode outcome) {
      const bool stopped = outcome == ExitCode::kInterrupted;
      const bool whole = options.request.ParseShard().whole();
      Print(NextLine(folder, whole ? Finished::kWhole : Finished::kShard,
                     stopped ? options.resume_command : ""));
      if (OutputFailed()) output_failed.Set();
    };
  }
  return observer;
}

ExitCode ShownOutcome(ExitCode outcome, const SharedFlag& output_failed) {
  return output_failed.IsSet() ? AfterFailedOutput(outcome) : outcome;
}

campaign::Stop StopBySignal() {
  return {.watch = [](std::atomic<bool>& flag, campaign::SecondWish second) {
    return std::static_pointer_cast<void>(std::make_shared<InterruptGuard>(flag, second));
  }};
}

}  // namespace rockyard::app
