#include "app/guard.h"

#include "app/run_display.h"
#include "campaign/journal.h"

namespace rockyard::app {

ExitCode Guarded(const std::function<ExitCode()>& action) {
  const campaign::Observer console = MessagesToConsole(Output::kText);
  campaign::Journal journal(console);
  return campaign::Guarded(journal, action);
}

}  // namespace rockyard::app
