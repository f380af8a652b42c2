#include "python/stepped_drive.h"

#include <cxxabi.h>

#include <boost/context/preallocated.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <boost/context/stack_context.hpp>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/fields.h"
#include "navigation/navigator_fault.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#define ROCKYARD_STACKS_ARE_WATCHED 1
#endif

namespace rockyard::python {
namespace {

constexpr std::size_t kStackBytes = std::size_t{1} << 20;  // of which a drive touches a tenth

// The drive that runs on this thread: its navigator finds it so.
thread_local SteppedDrive* running = nullptr;

// Tells the address sanitizer that this thread goes on with another stack, and has come there.
// `kept` is what it keeps of the stack that is left; null where that one has ended.
void LeaveStack([[maybe_unused]] void** kept, [[maybe_unused]] const StackPlace& to) {
#if defined(ROCKYARD_STACKS_ARE_WATCHED)
  __sanitizer_start_switch_fiber(kept, to.bottom, to.bytes);
#endif
}
void EnterStack([[maybe_unused]] void* kept, [[maybe_unused]] StackPlace* from) {
#if defined(ROCKYARD_STACKS_ARE_WATCHED)
  StackPlace unused;
  StackPlace& left = from == nullptr ? unused : *from;
  __sanitizer_finish_switch_fiber(kept, &left.bottom, &left.bytes);
#endif
}

// Tells it that a stack is no more: others may get its memory.
void ForgetStack([[maybe_unused]] const StackPlace& stack) {
#if defined(ROCKYARD_STACKS_ARE_WATCHED)
  __asan_unpoison_memory_region(stack.bottom, stack.bytes);
#endif
}

}  // namespace

// Asks the caller.
class CallerNavigator final : public navigation::Navigator {
 public:
  CallerNavigator(SteppedDrive& drive, const navigation::NavigatorSetup& setup) : drive_(drive) {
    drive_.goal_ = setup.goal;
  }
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    return drive_.Ask(input);
  }
  // The next input says what is believed, and that operators moved the rover.
  void OnPoseUpdate(const messages::PoseEstimate& /*before*/,
                    const messages::PoseEstimate& /*after*/) override {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange /*change*/) override {
    drive_.goal_ = goal;
  }

 private:
  SteppedDrive& drive_;
};

void SteppedDrive::Begin(const experiments::Experiment& experiment, std::uint64_t seed,
                         std::uint64_t trial) {
  Abandon();
  abandoned_ = false;
  record_.reset();
  thrown_ = nullptr;
  boost::context::protected_fixedsize_stack stacks(kStackBytes);
  const boost::context::stack_context stack = stacks.allocate();
  own_stack_ = {static_cast<const char*>(stack.sp) - stack.size, stack.size};
  drive_ = boost::context::fiber(std::allocator_arg,
                                 boost::context::preallocated(stack.sp, stack.size, stack), stacks,
                                 [this, &experiment, seed, trial](boost::context::fiber&& caller) {
                                   EnterStack(nullptr, &caller_stack_);
                                   caller_ = std::move(caller);
                                   try {
                                     record_ = experiment.Run(seed, trial);
                                   } catch (...) {
                                     thrown_ = std::current_exception();
                                   }
                                   LeaveStack(nullptr, caller_stack_);
                                   return std::move(caller_);
                                 });
  Resume();
}

void SteppedDrive::Step(const navigation::NavigatorDecision& decision) {
  decision_ = decision;
  Resume();
}

SteppedDrive::Handled SteppedDrive::ExchangeHandled(const Handled& with) {
  Handled was;
  void* globals = abi::__cxa_get_globals();
  std::memcpy(&was, globals, sizeof was);
  std::memcpy(globals, &with, sizeof with);
  return was;
}

void SteppedDrive::Resume() {
  input_ = nullptr;
  SteppedDrive* const outer = std::exchange(running, this);
  const Handled handled = ExchangeHandled(handled_);
  void* kept = nullptr;
  LeaveStack(&kept, own_stack_);
  drive_ = std::move(drive_).resume();
  EnterStack(kept, nullptr);
  if (!drive_) ForgetStack(own_stack_);
  handled_ = ExchangeHandled(handled);
  running = outer;
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

navigation::NavigatorDecision SteppedDrive::Ask(const navigation::NavigatorInput& input) {
  if (!abandoned_) {
    input_ = &input;
    void* kept = nullptr;
    LeaveStack(&kept, caller_stack_);
    caller_ = std::move(caller_).resume();
    EnterStack(kept, &caller_stack_);
  }
  if (abandoned_) {
    throw navigation::NavigatorFault(navigation::FaultKind::kThrew, "the drive was given up");
  }
  return decision_;
}

void SteppedDrive::Abandon() {
  if (!drive_) return;
  abandoned_ = true;
  Resume();
}

namespace {

struct CallerParams {
  bool reads_points = false;
  double goal_tolerance_m = 0.3;
  double look_time_s = 0.0;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m,
           {.doc = "the caller takes the goal for reached within this distance",
            .min = 0.0,
            .max = 10.0});
    v.Real(
        "look_time_s", look_time_s,
        {.doc = "what the caller's software computes for after each look", .min = 0.0, .max = 1e4});
    v.Boolean("reads_points", reads_points,
              {.doc = "the caller reads the points of a look, not its hazards"});
  }
};

}  // namespace

void AddCaller(navigation::NavigatorSet& navigators) {
  navigation::NavigatorDescription<CallerParams> description{
      .name = "caller",
      .doc = "the program that drives step by step",
      .traits = [](const CallerParams& params) -> navigation::NavigatorTraits {
        using navigation::LookReading;
        return {params.reads_points ? LookReading::kPoints : LookReading::kHazardReport,
                navigation::CostOfLook{params.look_time_s},
                {.path = "goal_tolerance_m", .tolerance_m = params.goal_tolerance_m}};
      },
      .make = [](const CallerParams& /*params*/, const navigation::NavigatorSetup& setup)
          -> std::unique_ptr<navigation::Navigator> {
        if (running == nullptr) {
          throw navigation::NavigatorFault(navigation::FaultKind::kThrew,
                                           "the navigator \"caller\" drives in environments alone");
        }
        return std::make_unique<CallerNavigator>(*running, setup);
      },
      .own_values = {}};
  navigators.Add(description);
}

}  // namespace rockyard::python
