// The process of a navigator: what is sent and answered, how it can fail, and that nothing of it is
// left behind.
#include "plugin/child_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <memory>
#include <string>
#include <thread>

#include "asking.h"
#include "marked_processes.h"

namespace rockyard::plugin {
namespace {

using navigation::FaultKind;
using navigation::LimitParams;
using testing::HasSubstr;

constexpr double kMuch_s = 1e6;

// Parts of programs for /bin/sh. Requests are "ask?", 8 bytes with their length.
const std::string kReadOne = "head -c 8 <&3 >/dev/null; ";
const std::string kAnswerOk = R"(printf '\002\000\000\000ok' >&4; )";
const std::string kSleep = "exec sleep 300";

// Answers every request by itself.
constexpr const char* kMirror = R"(
import struct
requests, answers = open(3, "rb"), open(4, "wb")
while len(size := requests.read(4)) == 4:
    answers.write(size + requests.read(struct.unpack("<I", size)[0]))
    answers.flush()
)";

class ChildProcessTest : public MarkedProcesses {
 protected:
  std::unique_ptr<ChildProcess> Start(const std::vector<std::string>& words) const {
    return std::make_unique<ChildProcess>(words, folder().path().string());
  }
  std::unique_ptr<ChildProcess> Shell(const std::string& program) const {
    return Start({"/bin/sh", "-c", program});
  }
  std::unique_ptr<ChildProcess> Python(const std::string& program,
                                       const std::string& argument = "") const {
    return Start({TEST_PYTHON, "-ISc", program, argument});
  }

  static std::string Ask(ChildProcess& process, const LimitParams& limits = {}) {
    return process.Ask("ask?", limits, kMuch_s);
  }
};

TEST_F(ChildProcessTest, AnswersOneRequestAfterTheOther) {
  const auto mirror = Python(kMirror);
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, std::size_t{255},
                                  std::size_t{256}, std::size_t{65537}, std::size_t{1} << 20}) {
    std::string message(bytes, 'x');
    if (bytes > 0) message.back() = '\0';
    EXPECT_EQ(mirror->Ask(message, {}, kMuch_s), message) << bytes;
  }
  EXPECT_TRUE(mirror->usable());
  EXPECT_EQ(Marked().size(), 1U);
}

// Nothing but what is handed to it: not the stores and sockets of the program that starts it.
TEST_F(ChildProcessTest, HasItsFolderAndFiveDescriptors) {
  const int open_here = open("/dev/null", O_RDONLY);
  ASSERT_GT(open_here, 2);
  const auto process = Shell(kReadOne +
                             "pwd; readlink /proc/$$/fd/0; ls /proc/$$/fd; "
                             "echo errors >&2; exec >/dev/null 2>&1; " +
                             kAnswerOk + kSleep);
  EXPECT_EQ(Ask(*process), "ok");
  close(open_here);
  EXPECT_EQ(process->said(), folder().path().string() + "\n/dev/null\n0\n1\n2\n3\n4\nerrors\n");
}

TEST_F(ChildProcessTest, ItsNoiseDelaysNoAnswerAndTheLastOfItIsKept) {
  // More than a pipe holds, so that it was read before the answer came.
  const auto process = Shell("echo first; yes 'noise without end' >&2 & " + kReadOne +
                             "yes 'noise without end' | head -n 20000 >&2; " + kAnswerOk +
                             kReadOne + kAnswerOk + "wait");
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_LE(process->said().size(), 2000U);
  EXPECT_THAT(process->said(), HasSubstr("noise without end\nnoise without end\n"));
  EXPECT_THAT(process->said(), testing::Not(HasSubstr("first")));
}

// Poll tells of the end of a stream for ever.
TEST_F(ChildProcessTest, WithoutStreamsItCostsNoTimeOfTheOneThatAsks) {
  const auto process = Shell("exec >/dev/null 2>&1; " + kReadOne + "sleep 0.3; " + kAnswerOk);
  const std::clock_t before = std::clock();
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 0.15);
}

struct Failing {
  const char* label;
  std::string program;  // for /bin/sh
  LimitParams limits;
  FaultKind kind;
  const char* words;
};

void PrintTo(const Failing& failing, std::ostream* out) { *out << failing.label; }

const std::string kBurn = "while :; do :; done";
const std::string kEat =
    std::string(TEST_PYTHON) + " -ISc 'import time; x = b\"x\" * (96 << 20); time.sleep(300)'";

class FailingProcess : public ChildProcessTest, public testing::WithParamInterface<Failing> {};

INSTANTIATE_TEST_SUITE_P(
    Ways, FailingProcess,
    testing::Values(
        Failing{"AnnouncesTooMuch",
                kReadOne + R"(printf '\377\377\377\177' >&4; )" + kSleep,
                {},
                FaultKind::kMessage,
                "2147483647 bytes"},
        Failing{"AnswersText",
                kReadOne + "printf 'hello' >&4; " + kSleep,
                {},
                FaultKind::kMessage,
                "no length"},
        Failing{"AnswersTwice",
                kReadOne + R"(printf '\002\000\000\000ok\002\000\000\000ok' >&4; )" + kSleep,
                {},
                FaultKind::kMessage,
                "more than one answer"},
        Failing{"AnswersHalf",
                kReadOne + R"(printf '\010\000\000\000half' >&4)",
                {},
                FaultKind::kEnded,
                "exit code 0"},
        Failing{"EndsWithWords",
                kReadOne + "echo the reason >&2; exit 7",
                {},
                FaultKind::kEnded,
                "exit code 7; the last that it wrote: the reason"},
        Failing{"KillsItself", kReadOne + "kill -9 $$", {}, FaultKind::kEnded, "SIGKILL"},
        Failing{"ClosesItsEnd",
                kReadOne + "exec 4>&-; " + kSleep,
                {},
                FaultKind::kEnded,
                "closed the pipe"},
        Failing{"Sleeps",
                "echo tired; " + kSleep,
                {.answer_s = 0.1},
                FaultKind::kSilent,
                "waited for 0.1 s; the last that it wrote: tired"},
        Failing{"Burns",
                kBurn,
                {.decision_cpu_s = 0.1},
                FaultKind::kCpuTime,
                "more than 0.1 s for one answer"},
        Failing{"BurnsInAChild",
                "(" + kBurn + ") & wait",
                {.decision_cpu_s = 0.1},
                FaultKind::kCpuTime,
                "more than 0.1 s for one answer"},
        Failing{"EatsInAChild",
                kEat + " & wait",
                {.memory_mb = 64.0},
                FaultKind::kMemory,
                "more than 64 MiB"}),
    [](const auto& way) { return std::string(way.param.label); });

TEST_P(FailingProcess, IsAFaultAndNothingOfItIsLeft) {
  auto process = Shell(GetParam().program);
  EXPECT_THAT(FaultOf([&] { Ask(*process, GetParam().limits); }),
              IsFault(GetParam().kind, GetParam().words));
  process.reset();
  ExpectNoneIsLeft();
}

TEST_F(ChildProcessTest, AProgramThatIsNotThereIsSaidToBe) {
  const auto process = Start({"/no/such/program"});
  EXPECT_THAT(FaultOf([&] { Ask(*process); }), IsFault(FaultKind::kEnded, "cannot be run"));
}

TEST_F(ChildProcessTest, WhatIsLeftOfADriveIsALimitToo) {
  const auto process = Shell(kBurn);
  EXPECT_THAT(FaultOf([&] { process->Ask("ask?", {.drive_cpu_s = 123.0}, 0.1); }),
              IsFault(FaultKind::kCpuTime, "more than 123 s for one drive"));
}

// Computes for as many hundredths of a second as its first argument says, then answers.
constexpr const char* kBurnOften = R"(
import sys, time
requests, answers = open(3, "rb", 0), open(4, "wb", 0)
while requests.read(8):
    end = time.process_time() + 0.01 * int(sys.argv[1])
    while time.process_time() < end:
        pass
    answers.write(b"\2\0\0\0ok")
)";

// After 20 ms, when what it uses is read first, it may still have used less.
TEST_F(ChildProcessTest, ACpuTimeThatIsOverAtTheAnswerIsFound) {
  const auto process = Python(kBurnOften, "3");
  EXPECT_THAT(FaultOf([&] { process->Ask("ask?", {.decision_cpu_s = 0.025}, kMuch_s); }),
              IsFault(FaultKind::kCpuTime, "for one answer"));
}

TEST_F(ChildProcessTest, TellsTheTimeOfTheLastAnswerAlone) {
  const auto process = Python(kBurnOften, "10");
  Ask(*process);  // the time to start is of the first
  for (int i = 0; i < 2; ++i) {
    Ask(*process);
    EXPECT_GT(process->used_s(), 0.09);
    EXPECT_LT(process->used_s(), 0.19);
  }
}

// A process that computes is not silent, whichever of its children does; one that waits is.
TEST_F(ChildProcessTest, ComputingIsNoSilence) {
  const std::string burn =
      std::string(TEST_PYTHON) + " -ISc 'import time\nwhile time.process_time() < 0.6: pass'; ";
  const LimitParams limits{.answer_s = 0.35};
  const auto computes = Shell(kReadOne + burn + burn + kAnswerOk);
  EXPECT_EQ(FaultOf([&] { EXPECT_EQ(Ask(*computes, limits), "ok"); }), "");
  const auto waits = Shell(kReadOne + "sleep 1; " + kAnswerOk);
  EXPECT_THAT(FaultOf([&] { Ask(*waits, limits); }), IsFault(FaultKind::kSilent, "0.35 s"));
}

// An answer that nobody asked for would be taken for that to the next request.
TEST_F(ChildProcessTest, AnAnswerTooManyIsFoundAtTheNextRequest) {
  const auto process = Shell(kReadOne + kAnswerOk + "sleep 0.05; " + kAnswerOk + "touch written; " +
                             kReadOne + kAnswerOk + kSleep);
  EXPECT_EQ(Ask(*process), "ok");
  ASSERT_TRUE(
      core::WaitUntil([&] { return std::filesystem::exists(folder().path() / "written"); }));
  EXPECT_THAT(FaultOf([&] { Ask(*process); }), IsFault(FaultKind::kMessage, ""));
}

// Programs that use the library do not ignore the signal of a broken pipe, as the command does.
TEST_F(ChildProcessTest, AReaderThatIsGoneEndsNoProgramThatAsks) {
  const pid_t program = fork();
  if (program == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    const auto process = Shell(kReadOne + "exec 3<&-; " + kAnswerOk + kSleep);
    Ask(*process);
    const std::string fault = FaultOf([&] { Ask(*process); });
    _exit(fault.starts_with("ended: ") ? 0 : 1);
  }
  int status = 0;
  waitpid(program, &status, 0);
  EXPECT_EQ(status, 0) << (WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "no fault");
}

// The threads of a campaign end one after the other, and hand their processes on before.
TEST_F(ChildProcessTest, OutlivesTheThreadThatStartedIt) {
  std::unique_ptr<ChildProcess> mirror;
  std::thread([&] {
    mirror = Python(kMirror);
    EXPECT_EQ(Ask(*mirror), "ask?");
  }).join();
  EXPECT_EQ(FaultOf([&] {
              for (int i = 0; i < 20; ++i) {  // a signal may take a moment
                EXPECT_EQ(Ask(*mirror), "ask?");
                usleep(2000);
              }
            }),
            "");
}

TEST_F(ChildProcessTest, IsOfNoUseToAForkWhoseEndLeavesItAlone) {
  auto mirror = Python(kMirror);
  EXPECT_EQ(Ask(*mirror), "ask?");
  const pid_t fork_of_this = fork();
  if (fork_of_this == 0) {
    const bool usable = mirror->usable();
    mirror.reset();
    _exit(usable ? 1 : 0);
  }
  int status = 0;
  waitpid(fork_of_this, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(mirror->usable());
  EXPECT_EQ(Ask(*mirror), "ask?");
}

TEST_F(ChildProcessTest, KnowsThatItHasEnded) {
  auto process = Shell(kReadOne + kAnswerOk);
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_TRUE(core::WaitUntil([&] { return !process->usable(); }));
  EXPECT_FALSE(process->usable());
  process.reset();
  ExpectNoneIsLeft();
}

// What a process starts, in the ways in which that may be left behind.
// Without the streams of the process, which then ends them as it ends.
const std::string kNone = " 3<&- 4>&- >/dev/null 2>&1";

struct Offspring {
  const char* label;
  std::string program;
  std::string fault;  // of the second request begins so
};

void PrintTo(const Offspring& offspring, std::ostream* out) { *out << offspring.label; }

class ProcessWithOffspring : public ChildProcessTest,
                             public testing::WithParamInterface<Offspring> {};

INSTANTIATE_TEST_SUITE_P(
    Ways, ProcessWithOffspring,
    testing::Values(
        Offspring{"LivesWithIt", "sleep 300 & " + kReadOne + kAnswerOk + kReadOne + kSleep,
                  "silent: "},
        Offspring{"InASessionOfItsOwn",
                  "setsid sleep 300 & " + kReadOne + kAnswerOk + kReadOne + kSleep, "silent: "},
        Offspring{"OutlivesItWithItsStreams",
                  "sleep 300 & " + kReadOne + kAnswerOk + kReadOne + "exit 3", ""},
        Offspring{"OutlivesItWithNone",
                  "sleep 300" + kNone + " & " + kReadOne + kAnswerOk + kReadOne + "exit 3",
                  "ended: its process ended with exit code 3"},
        Offspring{"OutlivesItsKill",
                  "sleep 300" + kNone + " & " + kReadOne + kAnswerOk + kReadOne + "kill -9 $$",
                  "ended: its process was ended by SIGKILL"}),
    [](const auto& way) { return std::string(way.param.label); });

TEST_P(ProcessWithOffspring, LeavesNoneOfIt) {
  auto process = Shell(GetParam().program);
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_TRUE(core::WaitUntil([&] { return Marked().size() >= 2; }));
  const std::string fault = FaultOf([&] { Ask(*process, {.answer_s = 0.2}); });
  EXPECT_NE(fault, "");
  EXPECT_THAT(fault, testing::StartsWith(GetParam().fault));
  process.reset();
  ExpectNoneIsLeft();
}

// Between two drives nobody asks it.
TEST_F(ChildProcessTest, ThatEndsUnaskedLeavesNoneOfItsOffspring) {
  auto process = Shell("sleep 300" + kNone + " & " + kReadOne + kAnswerOk);
  EXPECT_EQ(Ask(*process), "ok");
  EXPECT_TRUE(core::WaitUntil([&] { return !process->usable(); }));
  process.reset();
  ExpectNoneIsLeft();
}

TEST_F(ChildProcessTest, ConfiningWordsStartTheCommandInAShell) {
  bool confined = false;
  const auto words = StartWords("program \"with words\"", "/folder", confined);
  ASSERT_GE(words.size(), 5U);
  EXPECT_EQ(confined, words.front() == "bwrap");
  EXPECT_THAT(std::vector(words.end() - 5, words.end()),
              testing::ElementsAre("env", "ROCKYARD_NAVIGATOR=1", "/bin/sh", "-c",
                                   "exec program \"with words\""));
  if (!confined) return;
  EXPECT_THAT(words, testing::IsSupersetOf({"--unshare-net", "--ro-bind", "--tmpfs"}));
}

}  // namespace
}  // namespace rockyard::plugin
