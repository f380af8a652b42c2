#include "app/guard.h"

#include <exception>
#include <new>

#include "app/console.h"
#include "core/error.h"

namespace rockyard::app {

ExitCode Guarded(const std::function<ExitCode()>& action) {
  try {
    return action();
  } catch (const core::UserError& error) {
    PrintProblems(error.problems());
    return ExitCode::kBadInput;
  } catch (const std::bad_alloc&) {
    PrintProblems({{"memory", "is exhausted", "ask for fewer trials, threads or rocks"}});
  } catch (const std::exception& error) {
    PrintProblems({{"rockyard", error.what(), ""}});
  } catch (...) {
    PrintProblems({{"rockyard", "failed for an unknown reason", ""}});
  }
  return ExitCode::kFailed;
}

}  // namespace rockyard::app
