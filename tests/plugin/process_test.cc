// Navigators in processes of their own: what a drive asks and gets, processes that serve several
// drives, and how they fail.
#include "plugin/process.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "asking.h"
#include "core/refusals.h"
#include "marked_processes.h"
#include "plugin/messages_json.h"
#include "whole_messages.h"

namespace rockyard::plugin {
namespace {

using core::CompactJson;
using navigation::FaultKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// What the programs of tests share: reads requests and writes answers. `own` of a decision are how
// often it was asked since the start, and a number of the process: that of the system counts anew
// where processes are kept apart.
constexpr const char* kPeer = R"(
import json, os, struct, sys, time
requests, answers = open(3, "rb"), open(4, "wb")

def raw(data):
    answers.write(struct.pack("<I", len(data)) + data)
    answers.flush()

def tell(answer):
    raw(json.dumps(answer).encode())

def burn(seconds):
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass

DESCRIPTION = {"protocol": 1, "name": "mine", "doc": "of a test", "version": "1.5",
    "parameters": [{"name": "x", "type": "real", "default": 0.5, "min": 0, "max": 5},
                   {"name": "way", "type": "text", "default": ""}],
    "own_values": [{"name": "asked", "meaning": "how often"}, {"name": "process"}]}
PROCESS = int.from_bytes(os.urandom(6), "little")
TRAITS = {"reads": "points", "goal_tolerance": {"parameter": "x", "value_m": 0.25}}
log = []

def serve(decide, description=DESCRIPTION, traits=lambda p: TRAITS):
    asked = 0
    while len(size := requests.read(4)) == 4:
        text = requests.read(struct.unpack("<I", size)[0]).decode()
        log.append(text)
        message = json.loads(text)
        kind = message["type"]
        if kind == "describe":
            tell(description)
        elif kind == "traits":
            tell(traits(message["parameters"]))
        elif kind == "decide":
            asked += 1
            decide(message, [asked, PROCESS])
        elif kind == "overlay":
            tell({"lines": [{"name": line, "points": []} for line in log]})
        else:
            if kind == "start":
                asked = 0
                parameters.update(message["parameters"])
            tell({})

parameters = {}
)";

class ProcessTest : public MarkedProcesses {
 protected:
  // Opens a process that runs this program, after what all share.
  OpenedProcess Open(const std::string& program) const {
    Write("peer.py", kPeer);
    Write("mine.py", "from peer import *\n" + program);
    return OpenProcess(Command("mine.py"), folder().path().string());
  }
  static std::string Command(const std::string& file) {
    return std::string(TEST_PYTHON) + " -ESB " + file;
  }

  std::string RefusalOf(const std::string& program) const {
    return core::RefusalOf([&] { Open(program); });
  }
};

constexpr const char* kDrives = R"(
serve(lambda message, own: tell({"motion": {"kind": "arc", "curvature_per_m": 0.25},
                                 "until": {"distance_m": 1.5}, "own_values": own}))
)";

TEST_F(ProcessTest, SaysWhatItIs) {
  const auto opened = Open(kDrives);
  EXPECT_EQ(opened.source->name(), Command("mine.py"));
  const Description& description = opened.source->description();
  EXPECT_EQ(description.name, "mine");
  EXPECT_EQ(description.version, "1.5");
  EXPECT_EQ(description.own_values.size(), 2U);
  ForeignKind kind(opened.source);
  EXPECT_TRUE(kind.foreign());
  EXPECT_EQ(kind.traits().reads, navigation::LookReading::kPoints);
  EXPECT_EQ(kind.traits().goal.path, "x");
  EXPECT_EQ(kind.traits().goal.tolerance_m, 0.25);
}

// The whole of what it is sent, byte by byte. The overlay shows it.
TEST_F(ProcessTest, IsSentWhatHappens) {
  const auto opened = Open(kDrives);
  ForeignKind kind(opened.source);
  kind.traits();
  kind.traits();  // is not asked for again
  core::ReadParams(core::ParseJson(R"({"x": 1.5, "way": "höher"})", "test"), kind);
  kind.traits();
  const WholeInput whole;
  const auto navigator = kind.Make(WholeSetup());
  navigator->Decide(whole.input);
  navigator->OnPoseUpdate({1.5, 2.5, 0.25, 3.5}, {4.5, 5.5, 0.5, 6.5});
  navigator->OnCorrection({1.5, 2.5, 0.25, 3.5}, {4.5, 5.5, 0.5, 6.5});
  navigator->SetGoal({7.5, 8.5}, navigation::GoalChange::kNext);
  navigator->SetGoal({7.5, 8.5}, navigation::GoalChange::kMoved);
  const messages::Overlay* overlay = navigator->overlay();
  ASSERT_NE(overlay, nullptr);
  std::vector<std::string> sent;
  for (const messages::OverlayLine& line : overlay->lines) sent.push_back(line.name);
  const std::string setup = CompactJson(SetupToJson(WholeSetup()));
  const std::string input = CompactJson(InputToJson(whole.input)).substr(1);
  const std::string poses = R"("before":{"x_m":1.5,"y_m":2.5,"heading_rad":0.25,"distance_m":3.5},)"
                            R"("after":{"x_m":4.5,"y_m":5.5,"heading_rad":0.5,"distance_m":6.5}})";
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const std::string id = ",\"id\":" + std::to_string(i + 1) + "}";
    ASSERT_TRUE(sent[i].ends_with(id)) << sent[i];
    sent[i].replace(sent[i].size() - id.size(), id.size(), "}");
  }
  EXPECT_THAT(
      sent,
      ElementsAre(R"({"type":"describe","protocol":1})",
                  R"({"type":"traits","parameters":{"x":0.5,"way":""}})",
                  R"({"type":"traits","parameters":{"x":1.5,"way":"höher"}})",
                  R"({"type":"start","parameters":{"x":1.5,"way":"höher"},"setup":)" + setup + "}",
                  R"({"type":"decide",)" + input, R"({"type":"jump","corrected":false,)" + poses,
                  R"({"type":"jump","corrected":true,)" + poses,
                  R"({"type":"goal","goal":{"x_m":7.5,"y_m":8.5},"moved":false})",
                  R"({"type":"goal","goal":{"x_m":7.5,"y_m":8.5},"moved":true})",
                  R"({"type":"overlay"})"));
}

TEST_F(ProcessTest, DecidesAndCounts) {
  const auto opened = Open(kDrives);
  const auto navigator = Make(*opened.source);
  EXPECT_THAT(navigator->own_values(), ElementsAre(0.0, 0.0));
  const auto decision = navigator->Decide({});
  EXPECT_EQ(decision.motion.kind, messages::MotionKind::kArc);
  EXPECT_EQ(decision.motion.curvature_per_m, 0.25);
  EXPECT_EQ(decision.until.distance_m, 1.5);
  EXPECT_TRUE(std::isinf(decision.until.period_s));
  navigator->Decide({});
  EXPECT_EQ(navigator->own_values()[0], 2.0);
}

// It keeps what it told last, and null is none.
TEST_F(ProcessTest, OwnValuesMayBeLeftOutOrNone) {
  const auto opened = Open(R"(
serve(lambda message, own: tell({"own_values": own} if own[0] == 1 else
                                {"own_values": [None, 1]} if own[0] == 3 else {}))
)");
  const auto navigator = Make(*opened.source);
  navigator->Decide({});
  navigator->Decide({});
  EXPECT_EQ(navigator->own_values()[0], 1.0);
  navigator->Decide({});
  EXPECT_TRUE(std::isnan(navigator->own_values()[0]));
}

TEST_F(ProcessTest, ShowsNothingWhereItsOverlayIsEmpty) {
  const auto opened = Open(R"(
import peer
class Empty(list):
    pass
peer.log = Empty()
peer.log.append = lambda text: None
)" + std::string(kDrives));
  const auto navigator = Make(*opened.source);
  EXPECT_EQ(navigator->overlay(), nullptr);
}

double ProcessOf(navigation::Navigator& navigator) {
  navigator.Decide({});
  return navigator.own_values()[1];
}

// One drive after the other has the same process, which begins anew.
TEST_F(ProcessTest, OneProcessServesOneDriveAfterTheOther) {
  const auto opened = Open(kDrives);
  double process = 0.0;
  for (int drive = 0; drive < 3; ++drive) {
    const auto navigator = Make(*opened.source);
    const double now = ProcessOf(*navigator);
    EXPECT_EQ(navigator->own_values()[0], 1.0);
    EXPECT_EQ(now, drive == 0 ? now : process);
    process = now;
  }
}

TEST_F(ProcessTest, DrivesAtOnceHaveProcessesOfTheirOwn) {
  const auto opened = Open(kDrives);
  const auto first = Make(*opened.source);
  const auto second = Make(*opened.source);
  EXPECT_NE(ProcessOf(*first), ProcessOf(*second));
  ProcessOf(*second);
  EXPECT_EQ(first->own_values()[0], 1.0);
  EXPECT_EQ(second->own_values()[0], 2.0);
}

// Threads of a campaign hand processes on; the drives of the others go on where one ends.
TEST_F(ProcessTest, TheProcessOfAnotherThreadServesADriveToItsEnd) {
  const auto opened = Open(kDrives);
  std::unique_ptr<navigation::Navigator> navigator;
  std::thread([&] {
    const auto other = Make(*opened.source);  // takes the one that said what it is
    Make(*opened.source);                     // of this thread, and handed on
    navigator = Make(*opened.source);
  }).join();
  EXPECT_EQ(FaultOf([&] {
              for (int i = 0; i < 20; ++i) {  // a signal may take a moment
                navigator->Decide({});
                usleep(1000);
              }
            }),
            "");
}

TEST_F(ProcessTest, NoneIsLeftInTheEnd) {
  {
    const auto opened = Open(kDrives);
    const auto first = Make(*opened.source);
    const auto second = Make(*opened.source);
    second->Decide({});
    EXPECT_GE(Marked().size(), 2U);
  }
  ExpectNoneIsLeft();
}

struct Failing {
  const char* label;
  const char* decision;  // in Python
  FaultKind kind;
  const char* words;
};

// All ways in one program, of which a parameter chooses: "way N".
constexpr Failing kWays[] = {
    {"Error", R"(tell({"error": "no way out of here"}))", FaultKind::kThrew, "no way out of here"},
    {"ErrorWithoutText", R"(tell({"error": 3}))", FaultKind::kThrew, "without a text"},
    {"NoNumber", R"(tell({"motion": {"kind": "arc", "curvature_per_m": float("nan")}}))",
     FaultKind::kMessage, ""},
    {"Infinity", R"(tell({"until": {"distance_m": float("inf")}}))", FaultKind::kMessage, ""},
    {"NoJson", R"(raw(b"hello"))", FaultKind::kMessage, "line 1"},
    {"Nothing", R"(raw(b""))", FaultKind::kMessage, ""},
    {"NoUtf8", R"(raw(b'{"status": "\xff"}'))", FaultKind::kMessage, ""},
    {"OfAnotherRequest", R"(tell({"id": message["id"] - 1}))", FaultKind::kMessage,
     "its answer is to request"},
    {"NoObject", R"(tell([1]))", FaultKind::kMessage, "no object"},
    {"TooDeep", R"(raw(b"[" * 100000 + b"]" * 100000))", FaultKind::kMessage, ""},
    {"UnknownStatus", R"(tell({"status": "flying"}))", FaultKind::kMessage, "status is \"flying\""},
    {"OneOwnValue", R"(tell({"own_values": [1]}))", FaultKind::kMessage, "declares 2"},
    {"NoDirection", R"(tell({"motion": {"kind": "arc", "direction": 0}}))", FaultKind::kNonsense,
     "direction (+1 or -1) is 0"},
    {"TwiceTheSpeed", R"(tell({"motion": {"kind": "arc", "speed_share": 2}}))",
     FaultKind::kNonsense, "speed_share (above 0, to 1) is 2"},
    {"TooSharp", R"(tell({"motion": {"kind": "arc", "curvature_per_m": 1e9}}))",
     FaultKind::kNonsense, "curvature_per_m"},
    {"Raises", R"(1 / 0)", FaultKind::kEnded, "ZeroDivisionError"},
    {"Ends", R"(sys.exit(7))", FaultKind::kEnded, "exit code 7"}};

class FailingWay : public ProcessTest, public testing::WithParamInterface<int> {};

INSTANTIATE_TEST_SUITE_P(Ways, FailingWay, testing::Range(0, static_cast<int>(std::size(kWays))),
                         [](const auto& way) { return std::string(kWays[way.param].label); });

// Its process is not trusted with another drive, which has a new one and goes well.
TEST_P(FailingWay, IsAFaultOfThisDriveAlone) {
  const Failing& way = kWays[GetParam()];
  const auto opened = Open(std::string(R"(
def decide(message, own):
    if parameters["way"] == "fails":
        )") + way.decision +
                           R"(
    else:
        tell({"own_values": own})
serve(decide)
)");
  const double before = ProcessOf(*Make(*opened.source));
  const auto fails = Make(*opened.source, R"({"way": "fails"})");
  EXPECT_THAT(FaultOf([&] { fails->Decide({}); }), IsFault(way.kind, way.words));
  EXPECT_NE(ProcessOf(*Make(*opened.source)), before);
}

// Each decision takes 0.06 s, and each drive has the whole limit.
TEST_F(ProcessTest, CpuTimeOfADriveAddsUp) {
  const auto opened = Open(R"(
def decide(message, own):
    burn(0.06)
    tell({})
serve(decide)
)");
  navigation::NavigatorSetup setup;
  setup.limits.drive_cpu_s = 0.27;
  for (int drive = 0; drive < 2; ++drive) {
    const auto navigator = Make(*opened.source, "{}", setup);
    std::string fault;
    int decisions = 0;
    for (; fault.empty() && decisions < 10; ++decisions) {
      fault = FaultOf([&] { navigator->Decide({}); });
    }
    EXPECT_THAT(fault, IsFault(FaultKind::kCpuTime, "more than 0.27 s for one drive"));
    // A process that was started for the drive has spent some on that.
    EXPECT_GE(decisions, 3);
    EXPECT_LE(decisions, 5);
  }
}

// However quick each answer is.
TEST_F(ProcessTest, CpuTimeOfQuickAnswersAddsUpToo) {
  const auto opened = Open(R"(
def decide(message, own):
    burn(0.005)
    tell({})
serve(decide)
)");
  navigation::NavigatorSetup setup;
  setup.limits.drive_cpu_s = 0.3;
  const auto navigator = Make(*opened.source, "{}", setup);
  std::string fault;
  for (int i = 0; fault.empty() && i < 80; ++i) fault = FaultOf([&] { navigator->Decide({}); });
  EXPECT_THAT(fault, IsFault(FaultKind::kCpuTime, "for one drive"));
}

// A replay that asks for them drives as the campaign did.
TEST_F(ProcessTest, OverlaysCostADriveNothing) {
  const auto opened = Open(R"(
import peer
class Slow(list):
    def __iter__(self):
        burn(0.06)
        return iter([])
peer.log = Slow()
)" + std::string(kDrives));
  navigation::NavigatorSetup setup;
  setup.limits.drive_cpu_s = 0.2;
  const auto navigator = Make(*opened.source, "{}", setup);
  EXPECT_EQ(FaultOf([&] {
              for (int i = 0; i < 5; ++i) {
                navigator->Decide({});
                navigator->overlay();
              }
            }),
            "");
}

TEST_F(ProcessTest, LimitsOfAnAnswerAreThoseOfTheDrive) {
  const auto opened = Open(R"(
def decide(message, own):
    time.sleep(300) if parameters["way"] == "sleeps" else burn(300)
serve(decide)
)");
  navigation::NavigatorSetup setup;
  // In this order, as a process that is started for a drive spends some time on that.
  setup.limits = {.decision_cpu_s = 0.2};
  const auto burns = Make(*opened.source, "{}", setup);
  EXPECT_THAT(FaultOf([&] { burns->Decide({}); }),
              IsFault(FaultKind::kCpuTime, "more than 0.2 s for one answer"));
  setup.limits = {.answer_s = 0.1};
  const auto sleeps = Make(*opened.source, R"({"way": "sleeps"})", setup);
  EXPECT_THAT(FaultOf([&] { sleeps->Decide({}); }),
              IsFault(FaultKind::kSilent, "waited for 0.1 s"));
  setup.limits = {.memory_mb = 1.0};
  EXPECT_THAT(FaultOf([&] { Make(*opened.source, "{}", setup)->Decide({}); }),
              IsFault(FaultKind::kMemory, "more than 1 MiB"));
}

TEST_F(ProcessTest, ProblemsOfItsParametersAreTold) {
  const auto opened = Open(R"(
def traits(p):
    low = p["x"] < 0.25
    return dict(TRAITS, problems=[{"parameter": "x", "reason": "is too low",
                                   "suggestion": "use more"}] if low else [])
serve(None, traits=traits)
)");
  const auto problems = [&](const char* json) {
    ForeignKind kind(opened.source);
    return core::ProblemsIn([&] { core::ReadParams(core::ParseJson(json, "test"), kind); });
  };
  EXPECT_THAT(problems(R"({"x": 1})"), IsEmpty());
  EXPECT_THAT(problems(R"({"x": 0.1})"), core::OneProblem("x", "is too low", "use more"));
  EXPECT_THAT(problems(R"({"x": -1})"), core::OneProblem("x", "below the smallest"));
}

TEST_F(ProcessTest, ThatSpeaksAnotherVersionIsRefused) {
  EXPECT_THAT(RefusalOf("serve(None, description=dict(DESCRIPTION, protocol=2))"),
              HasSubstr("speaks version 2 of the protocol, and this program 1"));
  EXPECT_THAT(RefusalOf("serve(None, description=dict(DESCRIPTION, protocol='1'))"),
              HasSubstr("speaks version"));
  EXPECT_THAT(RefusalOf("serve(None, description={'name': 'mine'})"),
              HasSubstr("speaks version (none)"));
}

TEST_F(ProcessTest, ThatDoesNotSayWhatItIsIsRefused) {
  EXPECT_THAT(RefusalOf("raise SystemExit(3)"), HasSubstr("exit code 3"));
  EXPECT_THAT(RefusalOf("print('words to help'); sys.exit(3)"), HasSubstr("words to help"));
  EXPECT_THAT(RefusalOf("tell({'error': 'not today'}); time.sleep(300)"), HasSubstr("not today"));
  EXPECT_THAT(RefusalOf("serve(None, description=dict(DESCRIPTION, name=3))"),
              HasSubstr("name is no text"));
  EXPECT_THAT(RefusalOf("serve(None, traits=lambda p: {})"), "");
  EXPECT_THAT(core::RefusalOf([&] { OpenProcess("./no_such_program", folder().path()); }),
              HasSubstr("cannot be run"));
  ExpectNoneIsLeft();
}

TEST_F(ProcessTest, TraitsThatAreNoneAreRefused) {
  const auto opened = Open("serve(None, traits=lambda p: {})");
  ForeignKind kind(opened.source);
  EXPECT_THAT(core::RefusalOf([&] { kind.traits(); }), HasSubstr("traits.reads"));
  const auto ends = Open("serve(None, traits=lambda p: sys.exit(3))");
  EXPECT_THAT(core::RefusalOf([&] { ForeignKind(ends.source).traits(); }),
              HasSubstr("exit code 3"));
}

// What it is told of itself, and what it may do where it is kept apart.
TEST_F(ProcessTest, KnowsThatItIsANavigatorAndWritesNoFileWhereItIsConfined) {
  const auto opened = Open(R"(
def writes():
    try:
        open("written", "w").close()
        return "writes"
    except OSError:
        return "does not write"
serve(None, description=dict(DESCRIPTION, doc=os.environ["ROCKYARD_NAVIGATOR"] + " " + writes()))
)");
  EXPECT_EQ(opened.source->description().doc, opened.confined ? "1 does not write" : "1 writes");
}

}  // namespace
}  // namespace rockyard::plugin
