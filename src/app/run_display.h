// What people see of a campaign while it runs (commands `run` and `sweep`), messages of work on the
// console, and Ctrl-C as a wish to stop (every command whose work is observed or may be ended
// early).
#pragma once

#include <atomic>

#include "app/campaign_options.h"
#include "app/console.h"
#include "campaign/run_campaign.h"
#include "campaign/stop.h"
#include "campaign/work.h"

namespace rockyard::app {

// A flag in memory that forked processes share: the supervisor of a campaign learns what its
// workers set, however they end. Must be made before the campaign forks. The constructor throws
// core::UserError where there is no memory.
class SharedFlag {
 public:
  SharedFlag();
  ~SharedFlag();
  SharedFlag(const SharedFlag&) = delete;
  SharedFlag& operator=(const SharedFlag&) = delete;

  void Set() { *set_ = true; }
  bool IsSet() const { return *set_; }

 private:
  std::atomic<bool>* set_;
};

// Returns an observer that prints problems and warnings to standard error, and remarks too unless
// `output` is kQuiet.
campaign::Observer MessagesToConsole(Output output);

// Returns an observer of a campaign that prints its messages (MessagesToConsole), its progress on
// standard error, its report on standard output, and at the end of all the line that names the next
// command. It sets `output_failed` where standard output could not be written; under a supervisor
// that happens in a worker process. `options` and `output_failed` must outlive the observer.
campaign::RunObserver ShowRun(const CampaignOptions& options, SharedFlag& output_failed);

// Returns the exit code of a campaign that ShowRun showed: its outcome, or AfterFailedOutput where
// `output_failed` is set.
ExitCode ShownOutcome(ExitCode outcome, const SharedFlag& output_failed);

// Returns a Stop that takes SIGINT (Ctrl-C), SIGTERM, SIGHUP and SIGUSR1 for wishes to stop.
campaign::Stop StopBySignal();

}  // namespace rockyard::app
