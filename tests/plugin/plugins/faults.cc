// Navigators that fail, each in its own way: by the layer above the C interface.
#include <unistd.h>

#include <array>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "core/kind_set.h"
#include "plugin/navigator_plugin.h"

namespace {

using namespace rockyard;
using navigation::NavigatorDecision;

enum class Fault {
  kThrows,
  kThrowsAnything,
  kThrowsWhereItIsMade,
  kIsNone,
  kDecidesNoNumber,
  kHasOneOwnValueOfTwo,
  kForks,
  kComputes,
  kThrowsWhereItIsTold,
  kSleeps,
};

constexpr std::array<const char*, 10> kNames{
    "throws", "throws_anything", "throws_where_made", "none",  "no_number", "one_of_two",
    "forks",  "computes",        "throws_where_told", "sleeps"};

// Some 50 ms of the thread's own time.
void Compute() {
  const auto now_s = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double end_s = now_s() + 0.05;
  while (now_s() < end_s) {
  }
}

template <Fault kFault>
class Faulty final : public navigation::Navigator {
 public:
  NavigatorDecision Decide(const navigation::NavigatorInput&) override {
    if (kFault == Fault::kThrows) throw std::runtime_error("no way out of here");
    if (kFault == Fault::kThrowsAnything) throw 7;
    if (kFault == Fault::kForks) fork();
    if (kFault == Fault::kComputes) Compute();
    if (kFault == Fault::kSleeps) usleep(50'000);
    NavigatorDecision decision;
    if (kFault == Fault::kDecidesNoNumber) {
      decision.motion.curvature_per_m = std::numeric_limits<double>::quiet_NaN();
    }
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {
    if (kFault == Fault::kThrowsWhereItIsTold) throw std::runtime_error("not to be moved");
  }
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {
    if (kFault == Fault::kThrowsWhereItIsTold) throw std::runtime_error("not to be sent");
  }
  const messages::Overlay* overlay() const override {
    if (kFault == Fault::kThrowsWhereItIsTold) throw std::runtime_error("not to be seen");
    return nullptr;
  }
  std::span<const double> own_values() const override { return own_; }

 private:
  std::array<double, 1> own_{3.5};
};

template <Fault kFault>
navigation::NavigatorDescription<core::NoParams> Describe() {
  navigation::NavigatorDescription<core::NoParams> description;
  description.name = kNames[static_cast<std::size_t>(kFault)];
  description.doc = "fails";
  description.traits = [](const core::NoParams&) -> navigation::NavigatorTraits {
    return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {"", 0.25}};
  };
  description.make =
      [](const core::NoParams&,
         const navigation::NavigatorSetup&) -> std::unique_ptr<navigation::Navigator> {
    if (kFault == Fault::kThrowsWhereItIsMade) throw std::runtime_error("no place to begin");
    if (kFault == Fault::kIsNone) return nullptr;
    return std::make_unique<Faulty<kFault>>();
  };
  description.own_values = {{"first", "1", "the one that it has"}};
  if (kFault == Fault::kHasOneOwnValueOfTwo) {
    description.own_values.push_back({"second", "1", "the one that it lacks"});
  }
  return description;
}

}  // namespace

ROCKYARD_NAVIGATORS(Describe<Fault::kThrows>, Describe<Fault::kThrowsAnything>,
                    Describe<Fault::kThrowsWhereItIsMade>, Describe<Fault::kIsNone>,
                    Describe<Fault::kDecidesNoNumber>, Describe<Fault::kHasOneOwnValueOfTwo>,
                    Describe<Fault::kForks>, Describe<Fault::kComputes>,
                    Describe<Fault::kThrowsWhereItIsTold>, Describe<Fault::kSleeps>)
