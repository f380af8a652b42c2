// A trial that waits for its caller at every decision: the drive's own loop, on a stack of its own,
// with the caller in the place of the navigator.
#pragma once

#include <boost/context/fiber.hpp>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>

#include "experiments/experiment.h"
#include "messages/estimates.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "truth/record.h"

namespace rockyard::python {

// Where a stack lies.
struct StackPlace {
  const void* bottom = nullptr;
  std::size_t bytes = 0;
};

// One trial after the other, from one thread.
class SteppedDrive {
 public:
  SteppedDrive() = default;
  ~SteppedDrive() { Abandon(); }
  SteppedDrive(const SteppedDrive&) = delete;
  SteppedDrive& operator=(const SteppedDrive&) = delete;

  // Begins a trial and goes on to its first decision; one under way is given up. Throws what the
  // trial throws.
  void Begin(const experiments::Experiment& experiment, std::uint64_t seed, std::uint64_t trial);
  // Makes the decision and goes on to the next one, or to the end. Requires is_driving().
  void Step(const navigation::NavigatorDecision& decision);

  bool is_driving() const { return input_ != nullptr; }
  // Return what the decision is made on; require is_driving().
  const navigation::NavigatorInput& input() const { return *input_; }
  const messages::Goal& goal() const { return goal_; }
  // Returns the record; nothing before the end.
  const std::optional<truth::Record>& record() const { return record_; }

 private:
  friend class CallerNavigator;

  void Resume();
  void Abandon();
  navigation::NavigatorDecision Ask(const navigation::NavigatorInput& input);

  // The exceptions that are being handled on a stack, which the language keeps by thread.
  struct Handled {
    void* caught = nullptr;
    unsigned int uncaught = 0;
  };
  static Handled ExchangeHandled(const Handled& with);

  Handled handled_;
  boost::context::fiber drive_;
  boost::context::fiber caller_;
  StackPlace own_stack_;  // these two for the address sanitizer alone
  StackPlace caller_stack_;
  bool abandoned_ = false;
  const navigation::NavigatorInput* input_ = nullptr;
  messages::Goal goal_;
  navigation::NavigatorDecision decision_;
  std::optional<truth::Record> record_;
  std::exception_ptr thrown_;
};

// Adds the navigator "caller", which can drive by SteppedDrive alone.
void AddCaller(navigation::NavigatorSet& navigators);

}  // namespace rockyard::python
