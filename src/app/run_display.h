// What people see of a campaign while it runs, and how they end it.
#pragma once

#include <atomic>

#include "app/campaign_options.h"
#include "app/console.h"
#include "campaign/run_campaign.h"
#include "campaign/stop.h"
#include "campaign/work.h"

namespace rockyard::app {

// Lies in memory that a fork shares, so that the supervisor of a campaign learns what its workers
// set, however they end. The constructor throws core::UserError where there is no memory.
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

// Warnings and problems to standard error, remarks too but for kQuiet.
campaign::Observer MessagesToConsole(Output output);

// Beside these messages: progress on standard error, the report on standard output, and the line
// that names the next command, at the end of all. Sets `output_failed` where some of that could not
// be written, in whichever process. `options` and `output_failed` must outlive it.
campaign::RunObserver ShowRun(const CampaignOptions& options, SharedFlag& output_failed);

// How a campaign ended that was shown like that.
ExitCode ShownOutcome(ExitCode outcome, const SharedFlag& output_failed);

// Ctrl-C and the other polite signals.
campaign::Stop StopBySignal();

}  // namespace rockyard::app
