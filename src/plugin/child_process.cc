#include "plugin/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "navigation/navigator_fault.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using navigation::FaultKind;
using navigation::NavigatorFault;

constexpr int kToChild = 3;
constexpr int kFromChild = 4;
constexpr std::size_t kLengthBytes = 4;
constexpr std::size_t kKeptWords = 2000;
constexpr int kLook_ms = 20;  // between two looks at what it uses

double Seconds(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Returns a process and all that descend from it.
std::vector<pid_t> Family(pid_t head) {
  std::vector<pid_t> family{head};
  for (std::size_t i = 0; i < family.size() && family.size() < 4096; ++i) {
    const fs::path tasks = fmt::format("/proc/{}/task", family[i]);
    std::error_code error;
    for (fs::directory_iterator task(tasks, error), end; !error && task != end;
         task.increment(error)) {
      std::ifstream children(task->path() / "children");
      pid_t child = 0;
      while (children >> child) family.push_back(child);
    }
  }
  return family;
}

// Returns the CPU time of these.
double RunningCpu_s(const std::vector<pid_t>& family) {
  double sum_s = 0.0;
  for (const pid_t pid : family) {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &used) != 0) continue;
    sum_s += Seconds(used);
  }
  return sum_s;
}

// Returns the CPU time of their children that have ended.
double EndedCpu_s(const std::vector<pid_t>& family) {
  double ticks = 0.0;
  for (const pid_t pid : family) {
    std::ifstream file(fmt::format("/proc/{}/stat", pid));
    std::string text;
    std::getline(file, text);
    // Its name, in brackets, may hold blanks. Fields 16 and 17, counted from 1, are those of
    // children.
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string skipped;
    for (int i = 3; i <= 15; ++i) fields >> skipped;
    double user = 0.0;
    double system = 0.0;
    if (fields >> user >> system) ticks += user + system;
  }
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double Memory_mb(const std::vector<pid_t>& family) {
  double pages = 0.0;
  for (const pid_t pid : family) {
    std::ifstream file(fmt::format("/proc/{}/statm", pid));
    double size = 0.0;
    double resident = 0.0;
    if (file >> size >> resident) pages += resident;
  }
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

void Close(int& fd) {
  if (fd >= 0) close(fd);
  fd = -1;
}

// Two ends of a pipe, closed unless they are taken.
class Pipe {
 public:
  enum class Kind { kPipe, kSocket };

  explicit Pipe(Kind kind = Kind::kPipe) {
    const int failed = kind == Kind::kPipe
                           ? pipe2(ends_.data(), O_CLOEXEC)
                           : socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data());
    if (failed == 0) return;
    throw core::MachineError("processes", std::strerror(errno), core::kMoreOpenFiles);
  }
  ~Pipe() {
    for (int& end : ends_) Close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read() const { return ends_[0]; }
  int write() const { return ends_[1]; }
  int TakeRead() { return std::exchange(ends_[0], -1); }
  int TakeWrite() { return std::exchange(ends_[1], -1); }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// The ends that the program gets.
struct ProgramEnds {
  int requests;
  int answers;
  int log;
};

// What follows up to BeKeeper runs in a fork of a process with threads: only what is safe there,
// and so no memory is taken.

// Becomes the program.
[[noreturn]] void BeProgram(const char* const* words, const char* folder, const ProgramEnds& ends) {
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int each : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGCHLD}) {
    signal(each, SIG_DFL);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  // Above 4 first, so that no end is written over before it is copied.
  const int high_requests = fcntl(ends.requests, F_DUPFD, 10);
  const int high_answers = fcntl(ends.answers, F_DUPFD, 10);
  const int high_log = fcntl(ends.log, F_DUPFD, 10);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(high_log, STDOUT_FILENO);
  dup2(high_log, STDERR_FILENO);
  dup2(high_requests, kToChild);
  dup2(high_answers, kFromChild);
  close_range(kFromChild + 1, ~0U, 0);
  if (chdir(folder) != 0) _exit(127);
  execvp(words[0], const_cast<char* const*>(words));
  _exit(127);
}

// Kills the children of this process; what they started becomes its children then.
void KillChildren(const char* children_file) {
  std::array<char, 4096> text{};
  const int file = open(children_file, O_RDONLY);
  const ssize_t count = file < 0 ? 0 : read(file, text.data(), text.size());
  if (file >= 0) close(file);
  pid_t child = 0;
  for (ssize_t i = 0; i < count; ++i) {
    const char c = text[static_cast<std::size_t>(i)];
    if (c >= '0' && c <= '9') {
      child = 10 * child + (c - '0');
    } else if (child > 0) {
      kill(child, SIGKILL);
      child = 0;
    }
  }
}

// Starts the program and stays, until it ends or `life` says so or is closed, as it is when the
// process that asks has ended; then ends all that the program has started, wherever it went. Ends
// as the program did. A signal by the end of the thread that started it would not do: threads hand
// processes on.
[[noreturn]] void BeKeeper(const char* const* words, const char* folder, const ProgramEnds& ends,
                           int life) {
  setpgid(0, 0);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) signal(each, SIG_IGN);
  signal(SIGCHLD, [](int) {});
  sigset_t children;
  sigset_t none;
  sigemptyset(&none);
  sigemptyset(&children);
  sigaddset(&children, SIGCHLD);
  sigprocmask(SIG_SETMASK, &children, nullptr);
  const pid_t program = fork();
  if (program == 0) BeProgram(words, folder, ends);
  dup2(life, STDIN_FILENO);
  close_range(STDIN_FILENO + 1, ~0U, 0);
  int ended = -1;  // the status of the program
  const auto reap = [&](int options) {
    int status = 0;
    const pid_t child = waitpid(-1, &status, options);
    if (child == program) ended = status;
    return child;
  };
  while (ended < 0) {
    while (reap(WNOHANG) > 0) {
    }
    pollfd wish{STDIN_FILENO, POLLIN, 0};
    if (ended < 0 && ppoll(&wish, 1, nullptr, &none) > 0) break;
  }
  for (;;) {
    KillChildren("/proc/thread-self/children");
    // Once it has been waited for, its number may be another's.
    if (program > 0 && ended < 0) kill(-program, SIGKILL);
    if (reap(0) < 0 && errno == ECHILD) break;
  }
  if (ended >= 0 && WIFEXITED(ended)) _exit(WEXITSTATUS(ended));
  if (ended >= 0 && WIFSIGNALED(ended)) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    signal(WTERMSIG(ended), SIG_DFL);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    kill(getpid(), WTERMSIG(ended));
  }
  _exit(127);
}

bool RunsWell(const std::vector<std::string>& words) {
  std::vector<const char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(word.c_str());
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid < 0) return false;
  if (pid == 0) {
    const int nothing = open("/dev/null", O_RDWR);
    for (const int fd : {0, 1, 2}) dup2(nothing, fd);
    execvp(argv[0], const_cast<char* const*>(argv.data()));
    _exit(127);
  }
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Files are read-only everywhere but in a folder for temporary ones, which is its own.
std::vector<std::string> ConfiningWords(const std::string& folder) {
  std::vector<std::string> words;
  for (const char* word :
       {"bwrap", "--die-with-parent", "--new-session", "--unshare-net", "--unshare-pid",
        "--unshare-ipc", "--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--tmpfs",
        "/var/tmp", "--setenv", "TMPDIR", "/var/tmp", "--chdir"}) {
    words.emplace_back(word);
  }
  words.push_back(folder);
  return words;
}

}  // namespace

std::vector<std::string> StartWords(const std::string& command, const std::string& folder,
                                    bool& confined) {
  std::vector<std::string> trial = ConfiningWords(folder);
  std::vector<std::string> words = trial;
  trial.emplace_back("true");
  confined = RunsWell(trial);
  if (!confined) words.clear();
  for (const char* word : {"env", "ROCKYARD_NAVIGATOR=1", "/bin/sh", "-c"})
    words.emplace_back(word);
  words.push_back("exec " + command);
  return words;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::string& folder)
    : starter_(getpid()) {
  // A socket, as writing to a pipe whose reader has ended raises SIGPIPE in a program that does not
  // ignore it.
  Pipe requests(Pipe::Kind::kSocket);
  Pipe answers;
  Pipe log;
  Pipe life(Pipe::Kind::kSocket);
  std::vector<const char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(word.c_str());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) {
    throw core::MachineError("processes", std::strerror(errno),
                             "end other programs, then run it again");
  }
  if (pid_ == 0) {
    BeKeeper(argv.data(), folder.c_str(),
             {.requests = requests.read(), .answers = answers.write(), .log = log.write()},
             life.read());
  }
  setpgid(pid_, pid_);
  to_ = requests.TakeWrite();
  from_ = answers.TakeRead();
  log_ = log.TakeRead();
  life_ = life.TakeWrite();
  for (const int fd : {to_, from_, log_}) fcntl(fd, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  Close(to_);
  Close(from_);
  Close(log_);
  const bool own = getpid() == starter_;
  // Told, not only closed: a fork of this process may hold the end, too.
  if (own && pid_ > 0) send(life_, "q", 1, MSG_NOSIGNAL);
  Close(life_);
  if (!own || pid_ <= 0) return;
  // A keeper that the program has stopped is killed with all that is known of.
  constexpr int kPatience = 1000;
  for (int i = 0; i < kPatience; ++i) {
    const pid_t ended = waitpid(pid_, nullptr, WNOHANG);
    if (ended == pid_ || (ended < 0 && errno != EINTR)) return;
    const timespec wait{0, i < 50 ? 100'000 : 2'000'000};
    nanosleep(&wait, nullptr);
  }
  for (const pid_t each : Family(pid_)) kill(each, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::usable() const {
  if (pid_ <= 0 || getpid() != starter_) return false;
  if (waitpid(pid_, nullptr, WNOHANG) == 0) return true;
  pid_ = -1;
  return false;
}

// What is under way between a message and its answer.
class ChildProcess::Question {
 public:
  explicit Question(std::string_view message) : length_(message.size()) {
    const auto size = static_cast<std::uint32_t>(message.size());
    for (std::size_t i = 0; i < kLengthBytes; ++i) {
      head_[i] = static_cast<char>(size >> (8 * i) & 0xffu);
    }
    out_.reserve(kLengthBytes + message.size());
    out_.append(head_.data(), head_.size()).append(message);
  }

  std::string_view unsent() const { return std::string_view(out_).substr(sent_); }
  void Sent(std::size_t bytes) { sent_ += bytes; }

  // Takes bytes of the answer. Throws where they are more than it.
  void Take(std::string_view bytes) {
    answer_ += bytes;
    if (answer_.size() < kLengthBytes) return;
    const std::size_t length = Length();
    if (length > kLongestMessage) {
      throw NavigatorFault(FaultKind::kMessage,
                           fmt::format("it announced an answer of {} bytes: the first four bytes "
                                       "are no length, or it is too long",
                                       length));
    }
    if (answer_.size() > kLengthBytes + length) {
      throw NavigatorFault(FaultKind::kMessage, "it wrote more than one answer to one request");
    }
  }
  bool complete() const {
    return answer_.size() >= kLengthBytes && answer_.size() == kLengthBytes + Length();
  }
  std::string answer() const { return answer_.substr(kLengthBytes); }

 private:
  std::size_t Length() const {
    std::size_t length = 0;
    for (std::size_t i = 0; i < kLengthBytes; ++i) {
      length |= std::size_t{static_cast<unsigned char>(answer_[i])} << (8 * i);
    }
    return length;
  }

  std::size_t length_;
  std::array<char, kLengthBytes> head_{};
  std::string out_;
  std::size_t sent_ = 0;
  std::string answer_;
};

std::string ChildProcess::WithWords(std::string text) const {
  if (!said_.empty()) text += "; the last that it wrote: " + said_;
  return text;
}

void ChildProcess::ReadLog() {
  std::array<char, 4096> buffer{};
  // A process that writes without end must not keep anyone here.
  for (int i = 0; i < 64; ++i) {
    const ssize_t count = read(log_, buffer.data(), buffer.size());
    if (count == 0) return Close(log_);  // or poll would come back at once, for ever
    if (count < 0) return;
    said_.append(buffer.data(), static_cast<std::size_t>(count));
    if (said_.size() > kKeptWords) said_.erase(0, said_.size() - kKeptWords);
  }
}

void ChildProcess::FailEnded() {
  ReadLog();
  int status = 0;
  const bool waited = pid_ > 0 && waitpid(pid_, &status, WNOHANG) == pid_;
  if (waited) pid_ = -1;
  std::string how = "its process closed the pipe";
  if (waited && WIFSIGNALED(status)) {
    how = fmt::format("its process was ended by SIG{}", sigabbrev_np(WTERMSIG(status)));
  } else if (waited && WEXITSTATUS(status) == 127) {
    how = "its command cannot be run (exit code 127)";
  } else if (waited) {
    how = fmt::format("its process ended with exit code {}", WEXITSTATUS(status));
  }
  throw NavigatorFault(FaultKind::kEnded, WithWords(how));
}

void ChildProcess::Exchange(Question& question) {
  const std::string_view unsent = question.unsent();
  std::array<pollfd, 3> ready{pollfd{from_, POLLIN, 0}, pollfd{log_, POLLIN, 0},
                              pollfd{to_, POLLOUT, 0}};
  const nfds_t count = unsent.empty() ? 2 : 3;
  if (poll(ready.data(), count, kLook_ms) <= 0) return;
  if (ready[1].revents != 0) ReadLog();
  if (count == 3 && ready[2].revents != 0) {
    const ssize_t written = send(to_, unsent.data(), unsent.size(), MSG_NOSIGNAL);
    if (written > 0) question.Sent(static_cast<std::size_t>(written));
    if (written < 0 && errno != EAGAIN && errno != EINTR) FailEnded();
  }
  if (ready[0].revents == 0) return;
  std::array<char, 65536> buffer{};
  const ssize_t got = read(from_, buffer.data(), buffer.size());
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
    // The end of the pipe comes a little before that of the process.
    for (int i = 0; i < 50; ++i) {
      siginfo_t info{};
      const int failed = waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
      if (failed != 0 || info.si_pid == pid_) break;
      const timespec wait{0, 2'000'000};
      nanosleep(&wait, nullptr);
    }
    FailEnded();
  }
  if (got > 0) question.Take({buffer.data(), static_cast<std::size_t>(got)});
}

std::string ChildProcess::Ask(std::string_view message, const navigation::LimitParams& limits,
                              double left_cpu_s) {
  if (message.size() > kLongestMessage) {
    throw NavigatorFault(FaultKind::kMessage, "a request would be longer than 64 MiB");
  }
  // An answer that nobody asked for would be taken for that to the next question.
  pollfd unread{from_, POLLIN, 0};
  if (poll(&unread, 1, 0) > 0 && (unread.revents & POLLIN) != 0) {
    throw NavigatorFault(FaultKind::kMessage, WithWords("it wrote without having been asked"));
  }
  Question question(message);
  // What descends from it appears as it starts; later it is looked for in slow answers, and now and
  // then.
  if (asked_ < 4 || asked_ % 64 == 0) family_ = Family(pid_);
  // To read the use costs more than a quick answer: what was used since the last reading is charged
  // to the question before which it is read again.
  Clock::time_point alive = Clock::now();
  double carried_s = 0.0;
  if (asked_ == 0 || IsStale(alive)) {
    const double before_s = std::exchange(cpu_s_, Cpu_s());
    if (asked_ > 0) carried_s = std::max(0.0, cpu_s_ - before_s);
    read_at_ = alive;
  }
  ++asked_;
  const double began_cpu_s = cpu_s_;
  left_cpu_s -= carried_s;
  double seen_cpu_s = began_cpu_s;
  Clock::time_point looked = alive;
  while (!question.complete()) {
    Exchange(question);
    const Clock::time_point now = Clock::now();
    if (question.complete() || now - looked < std::chrono::milliseconds(kLook_ms)) continue;
    looked = now;
    family_ = Family(pid_);
    ended_cpu_s_ = EndedCpu_s(family_);
    const double cpu_s = Cpu_s();
    CheckUse(began_cpu_s, limits, left_cpu_s);
    // A process that computes is not silent.
    if (std::abs(cpu_s - seen_cpu_s) > 1e-3) {
      seen_cpu_s = cpu_s;
      alive = now;
    }
    if (std::chrono::duration<double>(now - alive).count() > limits.answer_s) {
      throw NavigatorFault(FaultKind::kSilent,
                           WithWords(fmt::format("it waited for {} s", limits.answer_s)));
    }
  }
  used_s_ = carried_s;
  if (const Clock::time_point now = Clock::now(); IsStale(now)) {
    cpu_s_ = Cpu_s();
    read_at_ = now;
    used_s_ += std::max(0.0, cpu_s_ - began_cpu_s);
    CheckUse(began_cpu_s, limits, left_cpu_s);
  }
  return question.answer();
}

bool ChildProcess::IsStale(Clock::time_point now) const {
  return now - read_at_ >= std::chrono::milliseconds(kLook_ms);
}

double ChildProcess::Cpu_s() const { return RunningCpu_s(family_) + ended_cpu_s_; }

void ChildProcess::CheckUse(double began_cpu_s, const navigation::LimitParams& limits,
                            double left_cpu_s) const {
  const double used_s = Cpu_s() - began_cpu_s;
  if (used_s > limits.decision_cpu_s) {
    throw NavigatorFault(FaultKind::kCpuTime, WithWords(fmt::format("more than {} s for one answer",
                                                                    limits.decision_cpu_s)));
  }
  if (used_s > left_cpu_s) {
    throw NavigatorFault(FaultKind::kCpuTime, WithWords(fmt::format("more than {} s for one drive",
                                                                    limits.drive_cpu_s)));
  }
  if (Memory_mb(family_) > limits.memory_mb) {
    throw NavigatorFault(FaultKind::kMemory,
                         WithWords(fmt::format("more than {} MiB", limits.memory_mb)));
  }
}

}  // namespace rockyard::plugin
