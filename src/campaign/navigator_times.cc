#include "campaign/navigator_times.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

// One write for a line: processes that add to one file do not mix their lines.
bool WriteLine(int descriptor, std::string_view line) {
  return write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

}  // namespace

NavigatorTimes::~NavigatorTimes() {
  if (descriptor_ >= 0) close(descriptor_);
}

void NavigatorTimes::Begin(const std::filesystem::path& folder) {
  const std::lock_guard lock(mutex_);
  file_ = folder / kFile;
}

void NavigatorTimes::Add(const std::string& cell, std::uint64_t trial,
                         const messages::NavigatorUse& use) {
  const std::lock_guard lock(mutex_);
  if (file_.empty() || problem_) return;
  bool done = true;
  if (descriptor_ < 0) {
    descriptor_ = open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    struct stat status {};
    done = descriptor_ >= 0 && fstat(descriptor_, &status) == 0 &&
           (status.st_size > 0 ||
            WriteLine(descriptor_, "cell,trial,questions,cpu_s,wall_s,longest_s\n"));
  }
  done = done && WriteLine(descriptor_,
                           fmt::format("{},{},{},{:.6f},{:.6f},{:.6f}\n", report::CsvField(cell),
                                       trial, use.questions, use.cpu_s, use.wall_s, use.longest_s));
  if (!done) problem_ = std::generic_category().message(errno);
}

std::optional<std::string> NavigatorTimes::problem() const {
  const std::lock_guard lock(mutex_);
  if (!problem_) return std::nullopt;
  return fmt::format("{} lacks drives: {}", file_.string(), *problem_);
}

}  // namespace rockyard::campaign
