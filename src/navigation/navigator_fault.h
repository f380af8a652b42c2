/// @file
/// What the host of a plugin or of a navigator's process throws where that navigator, or the
/// estimator or reader of a plugin, fails. A drive ends by it with the outcome navigator_fault;
/// nothing of rockyard's own throws it.
#pragma once

#include <stdexcept>
#include <string>

namespace rockyard::navigation {

/// How a navigator failed.
enum class FaultKind {
  kThrew,     ///< it reported an error or threw
  kNonsense,  ///< it decided what cannot be done: a curvature that is no number
  kMessage,   ///< its answer is no message of the protocol
  kEnded,     ///< its process ended
  kCpuTime,   ///< it used more CPU time than it may
  kMemory,    ///< it used more memory than it may
  kSilent,    ///< it gave no answer, and used no CPU time
};

/// A failure of the navigator or estimator, not of the simulator.
class NavigatorFault : public std::runtime_error {
 public:
  /// `text`: what happened, for people.
  NavigatorFault(FaultKind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}

  FaultKind kind() const { return kind_; }
  /// Returns whether a machine that is short of something could have done it as well: the drive is
  /// then driven once more, and the second fault counts.
  bool may_be_the_machine() const { return kind_ >= FaultKind::kEnded; }

 private:
  FaultKind kind_;
};

}  // namespace rockyard::navigation
