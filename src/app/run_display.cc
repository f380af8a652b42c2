#include "app/run_display.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "app/command_text.h"
#include "app/console.h"
#include "app/progress_line.h"
#include "app/show_report.h"
#include "core/error.h"

namespace rockyard::app {
namespace {

// While it lives, a signal of kPolite sets `requested`. With SecondWish::kEnds the first one also
// restores the default action, so that the second ends the process. At the end the default actions
// come back. A signal that the caller ignores stays ignored. Only one guard may live at a time, as
// the handlers know one flag.
class InterruptGuard {
 public:
  // `requested` must outlive the guard; others may set it, too.
  InterruptGuard(std::atomic<bool>& requested, campaign::SecondWish second);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

// Signals that ask for an end. SIGUSR1 is one as mpirun passes it on to every rank, whereas on
// SIGTERM it ends the ranks itself.
constexpr std::array kPolite = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

// Where the handlers find the flag: a signal handler can reach nothing but static storage.
std::atomic<std::atomic<bool>*> requested_flag = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler writes it");
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free, "and reads where it is");

void SetFlag(int) {
  if (std::atomic<bool>* flag = requested_flag) *flag = true;
}

void SetFlagOnce(int signal) {
  SetFlag(signal);
  std::signal(signal, SIG_DFL);
}

InterruptGuard::InterruptGuard(std::atomic<bool>& requested, campaign::SecondWish second) {
  requested_flag = &requested;
  const auto handler = second == campaign::SecondWish::kEnds ? SetFlagOnce : SetFlag;
  for (const int signal : kPolite) {
    // What the caller told to ignore (nohup, background jobs of a script) stays ignored.
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kPolite) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  requested_flag = nullptr;
}

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

static_assert(std::atomic<bool>::is_always_lock_free, "a lock would be of one process alone");

SharedFlag::SharedFlag() {
  void* memory =
      mmap(nullptr, sizeof(*set_), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw core::UserError("memory", std::strerror(errno), "end other programs");
  }
  set_ = new (memory) std::atomic<bool>(false);
}

SharedFlag::~SharedFlag() { munmap(set_, sizeof(*set_)); }

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
    ShowReport(report,
               {.output = options.output(),
                .resume = stopped ? options.resume_command : "",
                .next = stopped || (options.names_next && options.request.traces.rules.empty())});
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
