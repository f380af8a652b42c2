#include "batch/supervisor.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "batch/flight_log.h"
#include "core/error.h"

namespace rockyard::batch {
namespace {

using Task = Mission::Task;
using Why = LeftOut::Why;

// Returns whether the exit code is one by which a worker says to its supervisor alone why it ended.
bool IsForSupervisor(const ProcessEnd& end) {
  return end.signal == 0 && (end.code == kOverdueExit || end.code == kShortExit);
}

bool Crashed(const ProcessEnd& end) { return end.signal != 0 || end.cut_short; }

// Returns "by SIGSEGV (Segmentation fault)".
std::string HowItCrashed(const ProcessEnd& end) {
  if (end.signal != 0) return "by " + SignalText(end.signal);
  return fmt::format("by itself in the middle of its work, with exit code {}", end.code);
}

// Returns whether no trial is to blame: the worker was killed, or short of memory, files or disk.
bool FailedFromOutside(const ProcessEnd& end) {
  return end.signal == SIGKILL || (!Crashed(end) && end.code == kShortExit);
}

std::string WhatFailed(const ProcessEnd& end) {
  return Crashed(end) ? "the process was ended " + HowItCrashed(end)
                      : "the machine was short of memory, files or disk";
}

bool AskedToEnd(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGUSR1;
}

class Supervisor {
 public:
  Supervisor(FlightLog& log, const Worker& worker, const SupervisorOptions& options,
             const std::function<void(const std::string&)>& note)
      : log_(log), worker_(worker), options_(options), note_(note) {}

  int Run() {
    for (int fruitless = 0; fruitless <= options_.fruitless_restarts;) {
      const ProcessEnd end = Do({.task = log_.opened() ? Task::kGoOn : Task::kBegin});
      if (exit_code_) return *exit_code_;
      const std::vector<Flight> flights = log_.Flights();
      Tell(end, flights);
      const bool fruitful = log_.stored() > 0 || !flights.empty();
      fruitless = fruitful ? 0 : fruitless + 1;
      for (const Flight& flight : flights) {
        Resolve(flight, end);
        if (exit_code_) return *exit_code_;
      }
    }
    note_(
        fmt::format("the worker process died {} times without {}: giving up; "
                    "what was finished is stored, go on with --resume",
                    options_.fruitless_restarts + 1, options_.fruit));
    return options_.failed_exit;
  }

 private:
  enum class Alone { kPassed, kCrashed, kKilled, kHung, kEnded };

  // Runs one process; sets exit_code_ where the campaign ends with it.
  ProcessEnd Do(Mission mission) {
    log_.Clear();
    mission.left_out = left_out_;
    ProcessEnd end = held_.Run([&] {
      const int code = worker_(mission);
      log_.SetReturned();
      return code;
    });
    end.cut_short = end.signal == 0 && !log_.returned() && !IsForSupervisor(end);
    if (end.interrupted || AskedToEnd(end.signal)) {
      // A user who asked for an end is not told that a trial hung meanwhile.
      const bool own = !Crashed(end) && !IsForSupervisor(end);
      exit_code_ = own ? end.code : options_.interrupted_exit;
    } else if (!Crashed(end) && !IsForSupervisor(end)) {
      const bool campaign = mission.task == Task::kBegin || mission.task == Task::kGoOn;
      if (campaign || end.code != 0) exit_code_ = end.code;
    }
    return end;
  }

  void Tell(const ProcessEnd& end, const std::vector<Flight>& flights) const {
    if (Crashed(end) || FailedFromOutside(end)) {
      const std::string what =
          Crashed(end) ? "the worker process was ended " + HowItCrashed(end) : WhatFailed(end);
      note_(fmt::format("{}; {} trials were in flight and are run again one by one", what,
                        flights.size()));
    }
  }

  void Resolve(const Flight& flight, const ProcessEnd& end) {
    if (flight.overdue) {
      NoteOverdue(flight.id);
    } else if (!Crashed(end) && !FailedFromOutside(end)) {
      return;  // it had no time left to be stored, and is run again with the others
    }
    int hung = flight.overdue ? 1 : 0;
    int crashed = !flight.overdue && !FailedFromOutside(end) ? 1 : 0;
    int killed = 0;
    for (;;) {
      ProcessEnd last;
      switch (RunAlone(flight.id, last)) {
        case Alone::kEnded:
          return;
        case Alone::kPassed:
          if (!flight.overdue) NotePassed(flight.id, end);
          return;
        case Alone::kCrashed:
          // Records depend on this number, so that it is no option, unlike the retries below.
          if (++crashed > 1) return GiveUp(flight.id, last);
          NoteCrashed(flight.id, last);
          break;
        case Alone::kKilled:
          NoteKilled(flight.id, last);
          if (++killed > options_.killed_retries) return LeaveOut(flight.id, Why::kIsKilled);
          break;
        case Alone::kHung:
          NoteOverdue(flight.id);
          if (++hung == 2 && StoreHang(flight.id)) return;
          if (hung > options_.hung_retries) return LeaveOut(flight.id, Why::kHangs);
          break;
      }
      if (exit_code_) return;
    }
  }

  Alone RunAlone(TrialId id, ProcessEnd& end) {
    end = Do({.task = Task::kRunAlone, .trial = id});
    if (exit_code_) return Alone::kEnded;
    if (FailedFromOutside(end)) return Alone::kKilled;
    if (Crashed(end)) return Alone::kCrashed;
    return end.code == kOverdueExit ? Alone::kHung : Alone::kPassed;
  }

  void GiveUp(TrialId id, const ProcessEnd& end) {
    if (!options_.faults_are_stored) return LeaveOut(id, Why::kCrashes);
    StoreFault(id, end);
  }

  // Stores an entry in the store; without it the trial would be run, and crash, for ever. It is
  // tried twice, since what ends the process once may have come from outside.
  void Store(const Mission& mission) {
    ProcessEnd end;
    for (int attempt = 0; attempt < 2; ++attempt) {
      end = Do(mission);
      if (exit_code_ || !Crashed(end)) return;
    }
    note_(
        fmt::format("the process that stores faults was ended twice, the second time {}: giving "
                    "up; what was finished is stored, go on with --resume",
                    HowItCrashed(end)));
    exit_code_ = options_.failed_exit;
  }

  void StoreFault(TrialId id, const ProcessEnd& end) {
    note_(fmt::format("trial {}{} crashed again when it ran alone, {}: stored as a fault", id.trial,
                      id.cell == 0 ? "" : fmt::format(" of cell {}", id.cell), HowItCrashed(end)));
    Store({.task = Task::kStoreFault, .trial = id, .reason = HowItCrashed(end)});
  }

  // Returns whether the trial that hung twice is stored as a fault of its navigator.
  bool StoreHang(TrialId id) {
    if (!options_.faults_are_stored) return false;
    Store({.task = Task::kStoreHang, .trial = id});
    return !exit_code_ && log_.stored() > 0;
  }

  void NoteFault(TrialId id, std::string kind, std::string reason) {
    if (!options_.faults_are_stored) return;
    Store({.task = Task::kStoreMachineFault,
           .trial = id,
           .kind = std::move(kind),
           .reason = std::move(reason)});
  }

  void NoteOverdue(TrialId id) { NoteFault(id, kOverdueKind, kOverdueReason); }

  void NoteKilled(TrialId id, const ProcessEnd& end) {
    NoteFault(id, KindOf(end), WhatFailed(end) + " while the trial ran alone");
  }

  void NoteCrashed(TrialId id, const ProcessEnd& end) {
    NoteFault(id, "crashed",
              fmt::format("the process in which the trial ran alone was ended {}, for the first "
                          "time",
                          HowItCrashed(end)));
  }

  void NotePassed(TrialId id, const ProcessEnd& end) {
    NoteFault(id, KindOf(end), WhatFailed(end) + " while the trial ran; alone the trial passed");
  }

  static std::string KindOf(const ProcessEnd& end) {
    if (!FailedFromOutside(end)) return "crashed";
    return end.signal == 0 ? "short_of_resources" : "killed";
  }

  void LeaveOut(TrialId id, Why why) { left_out_.push_back({id, why}); }

  FlightLog& log_;
  const Worker& worker_;
  const SupervisorOptions& options_;
  const std::function<void(const std::string&)>& note_;
  const SignalsHeld held_;
  std::vector<LeftOut> left_out_;
  std::optional<int> exit_code_;
};

}  // namespace

int Supervise(FlightLog& log, const Worker& worker, const SupervisorOptions& options,
              const std::function<void(const std::string&)>& note) {
  return Supervisor(log, worker, options, note).Run();
}

namespace {

using Clock = std::chrono::steady_clock;

// The same signals as in AskedToEnd above, and in app/run_display.cc.
constexpr std::array kPolite = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

// One wish to end can arrive as several signals within this time: timeout(1) sends to a process and
// to its group.
constexpr std::chrono::milliseconds kSameWish{500};

bool Ignored(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

std::optional<ProcessEnd> EndOf(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, WNOHANG) != child) return std::nullopt;
  if (WIFSIGNALED(status)) return ProcessEnd{.signal = WTERMSIG(status)};
  return ProcessEnd{.code = WEXITSTATUS(status)};
}

[[noreturn]] void BeChild(pid_t parent, const sigset_t& mask, const std::function<int()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  const int code = work();
  std::fflush(nullptr);
  // Not exit(): what the parent registered for its own end is not the child's to do.
  _exit(code);
}

}  // namespace

std::string SignalText(int signal) {
  const char* name = sigabbrev_np(signal);
  const char* text = sigdescr_np(signal);
  return fmt::format("SIG{} ({})", name == nullptr ? std::to_string(signal) : name,
                     text == nullptr ? "unknown" : text);
}

SignalsHeld::SignalsHeld() {
  sigemptyset(&held_);
  sigaddset(&held_, SIGCHLD);
  for (const int signal : kPolite) {
    // The kernel keeps a blocked signal even where it would be ignored.
    if (!Ignored(signal)) sigaddset(&held_, signal);
  }
  // Where the caller of the program ignores SIGCHLD, ends of children would be forgotten.
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(SIGCHLD, &action, &former_child_action_);
  sigprocmask(SIG_BLOCK, &held_, &former_);
}

SignalsHeld::~SignalsHeld() {
  sigprocmask(SIG_SETMASK, &former_, nullptr);
  sigaction(SIGCHLD, &former_child_action_, nullptr);
}

ProcessEnd SignalsHeld::Run(const std::function<int()>& work) const {
  std::fflush(nullptr);  // or the child would write it a second time
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    throw core::UserError("processes", std::strerror(errno),
                          "end other programs, or run with --no-supervisor");
  }
  if (child == 0) BeChild(parent, former_, work);
  return Wait(child);
}

ProcessEnd SignalsHeld::Wait(pid_t child) const {
  std::optional<Clock::time_point> asked;
  for (;;) {
    if (std::optional<ProcessEnd> end = EndOf(child)) {
      end->interrupted = asked.has_value();
      return *end;
    }
    // Of a program with more threads another one may have got the signal of the child's end.
    const timespec soon{.tv_sec = 0, .tv_nsec = 100'000'000};
    const int signal = sigtimedwait(&held_, nullptr, &soon);
    if (signal <= 0 || signal == SIGCHLD) continue;
    const Clock::time_point now = Clock::now();
    if (!asked) {
      asked = now;
      kill(child, SIGTERM);
    } else if (now - *asked > kSameWish) {
      kill(child, SIGKILL);
    }
  }
}

namespace {

constexpr std::chrono::milliseconds kAskAgain{5};

}  // namespace

LeavingOutSource::LeavingOutSource(LocalWorkSource& source, std::vector<TrialId> left_out)
    : source_(source), left_out_(std::move(left_out)) {}

std::optional<TrialId> LeavingOutSource::Take() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      const WorkPlan::NextStep next = source_.TryTake();
      const bool hangs = std::find(left_out_.begin(), left_out_.end(), next.id) != left_out_.end();
      switch (next.step) {
        case WorkPlan::Step::kDone:
          return std::nullopt;
        case WorkPlan::Step::kWait:
          if (running_ == 0) return std::nullopt;  // all that is missing has been left out
          break;
        case WorkPlan::Step::kTrial:
          if (hangs) continue;
          ++running_;
          return next.id;
      }
    }
    std::this_thread::sleep_for(kAskAgain);
  }
}

void LeavingOutSource::Finish(CellRecord record) {
  const std::lock_guard lock(mutex_);
  source_.Finish(std::move(record));
  --running_;
}

WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order) {
  std::vector<std::int64_t> planned;
  planned.reserve(static_cast<std::size_t>(store.cells()));
  for (int cell = 0; cell < store.cells(); ++cell) {
    // Once the rule has ended a cell, the store plans fewer trials than the most of the rule.
    planned.push_back(rule ? rule->max_trials : store.planned(cell));
  }
  WorkPlan plan(std::move(planned),
                {.rule = rule, .order = order, .shard = store.identity().shard});
  plan.AddStored(store.Finished());
  return plan;
}

std::vector<CellState> StoredEnds(const ResultStore& store) {
  WorkPlan plan = StoredPlan(store, store.rule());
  plan.Next();
  std::vector<CellState> states;
  states.reserve(static_cast<std::size_t>(plan.cells()));
  for (int cell = 0; cell < plan.cells(); ++cell) states.push_back(plan.state(cell));
  return states;
}

}  // namespace rockyard::batch
