// Runs code of a plugin in a child process, for what is asked before any drive: a plugin that
// crashes, hangs or prints as it is loaded does no harm to the program that asks. POSIX.
#pragma once

#include <functional>
#include <string>

namespace rockyard::plugin {

// Runs `work` in a forked child, and returns the text that it returned there. Throws
// core::UserError, named by `source`, where it throws (with what it threw), crashes, ends, or takes
// more than some seconds of CPU or a minute; core::MachineError where no process can be made. What
// the child writes to stdout goes to stderr.
std::string InChild(const std::string& source, const std::function<std::string()>& work);

}  // namespace rockyard::plugin
