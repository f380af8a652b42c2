// Navigators that answer messages (docs/navigators.md has the list), whoever carries them: a
// process at the other end of pipes (process.h), or an interpreter within the program.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "navigation/navigator_set_params.h"
#include "plugin/foreign_navigator.h"

namespace rockyard::plugin {

// One that answers. It serves one drive after the other, and one thread at a time.
class Answerer {
 public:
  virtual ~Answerer() = default;

  // Sends a message and returns the answer. `left_cpu_s`: what is left of the drive's limit. Throws
  // navigation::NavigatorFault; the answerer is of no use then.
  virtual std::string Ask(std::string_view message, const navigation::LimitParams& limits,
                          double left_cpu_s) = 0;

  // Returns how often it was asked.
  virtual std::int64_t asked() const = 0;
  // Returns the CPU time of the last answer, s.
  virtual double used_s() const = 0;
  // Returns whether it can still be asked by the process that calls.
  virtual bool usable() const = 0;
};

// Makes one; any thread may call it.
using MakeAnswerer = std::function<std::unique_ptr<Answerer>()>;

// The longest message, either way.
inline constexpr std::size_t kLongestMessage = std::size_t{64} << 20;

// Asks what the navigator is. There are as many answerers as drives at once. `name` names it in
// messages. Throws core::UserError: it fails, or answers with no description.
std::shared_ptr<const NavigatorSource> OpenAnswerer(const std::string& name, MakeAnswerer make);

}  // namespace rockyard::plugin
