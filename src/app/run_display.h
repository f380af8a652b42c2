// What people see of a campaign while it runs, and how they end it.
#pragma once

#include "app/campaign_options.h"
#include "app/exit_code.h"
#include "app/shared_flag.h"
#include "campaign/observer.h"
#include "campaign/run_campaign.h"
#include "campaign/stop.h"

namespace rockyard::app {

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
