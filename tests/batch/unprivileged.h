// What a user without rights can do, also where the tests are run by root, whom no permissions
// bind.
#pragma once

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <string>

namespace rockyard::batch {

// Runs `action` in a process that has no rights beyond those of everybody, and returns the
// sentence that it returns there, or that of its exception.
inline std::string AsNobody(const std::function<std::string()>& action) {
  constexpr uid_t kNobody = 65534;
  int pipe_ends[2] = {};
  if (pipe(pipe_ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    const bool root = geteuid() == 0;
    const bool dropped =
        !root || (setgroups(0, nullptr) == 0 && setgid(kNobody) == 0 && setuid(kNobody) == 0);
    std::string text = "kept its rights";
    try {
      if (dropped) text = action();
    } catch (const std::exception& error) {
      text = error.what();
    }
    const bool told = write(pipe_ends[1], text.data(), text.size()) >= 0;
    _exit(told ? 0 : 1);
  }
  close(pipe_ends[1]);
  std::string text;
  char bytes[4096];
  for (ssize_t got = 0; (got = read(pipe_ends[0], bytes, sizeof bytes)) > 0;) {
    text.append(bytes, static_cast<std::size_t>(got));
  }
  close(pipe_ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "died: " + text;
}

// Takes from everybody the right to change what is in the folder, while this lives.
class WriteProtected {
 public:
  explicit WriteProtected(const std::filesystem::path& folder) : folder_(folder) {
    Set(0555, 0444);
  }
  ~WriteProtected() { Set(0755, 0644); }
  WriteProtected(const WriteProtected&) = delete;
  WriteProtected& operator=(const WriteProtected&) = delete;

 private:
  void Set(unsigned folder_mode, unsigned file_mode) const {
    using std::filesystem::perms;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      std::filesystem::permissions(entry.path(), static_cast<perms>(file_mode));
    }
    std::filesystem::permissions(folder_, static_cast<perms>(folder_mode));
  }

  std::filesystem::path folder_;
};

}  // namespace rockyard::batch
