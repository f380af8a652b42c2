#include "app/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace rockyard::app {
namespace {

// For reading alone: what is written to it fails, as it would have without. open() takes the lowest
// number that is free, which is this one, as those below are open by then.
void OpenIfClosed(int descriptor) {
  if (fcntl(descriptor, F_GETFD) >= 0) return;
  [[maybe_unused]] const int opened = open("/dev/null", O_RDONLY);
}

}  // namespace

void PrepareStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) OpenIfClosed(stream);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace rockyard::app
