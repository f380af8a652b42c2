// Navigators in processes of their own, asked by messages (docs/navigators.md). A process serves
// one drive after the other and one thread at a time; there are as many as drives at once.
#pragma once

#include <memory>
#include <string>

#include "plugin/foreign_navigator.h"

namespace rockyard::plugin {

// A navigator's process as it was first asked.
struct OpenedProcess {
  std::shared_ptr<const NavigatorSource> source;
  bool confined = false;  // no network, files read-only
};

// Starts `command` in `folder` (absolute), and asks what it is. Throws core::UserError: it does not
// run, ends, is silent, or answers with no description.
OpenedProcess OpenProcess(const std::string& command, const std::string& folder);

}  // namespace rockyard::plugin
