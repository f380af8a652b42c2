#include "plugin/process.h"

#include <memory>
#include <vector>

#include "plugin/answerer.h"
#include "plugin/child_process.h"

namespace rockyard::plugin {

OpenedProcess OpenProcess(const std::string& command, const std::string& folder) {
  OpenedProcess opened;
  const std::vector<std::string> words = StartWords(command, folder, opened.confined);
  opened.source = OpenAnswerer(
      command, [words, folder] { return std::make_unique<ChildProcess>(words, folder); });
  return opened;
}

}  // namespace rockyard::plugin
