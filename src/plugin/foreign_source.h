// Where navigators or estimators that the program does not hold come from, and the parameters of a
// kind of them: what both have in common.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/fields.h"
#include "core/json_text.h"
#include "core/json_value.h"
#include "plugin/description.h"

namespace rockyard::plugin {

// The source of one kind, shared by all copies of it; any thread may call it. `Answer` is what the
// plugin says of parameters, with a member `problems`.
template <typename Answer>
class ForeignSource {
 public:
  ForeignSource(std::string name, std::unique_ptr<const Description> description)
      : name_(std::move(name)), description_(std::move(description)) {}
  virtual ~ForeignSource() = default;
  ForeignSource(const ForeignSource&) = delete;
  ForeignSource& operator=(const ForeignSource&) = delete;

  // Returns the plugin in words, for messages.
  const std::string& name() const { return name_; }
  const Description& description() const { return *description_; }

 protected:
  // Returns what the plugin says of parameters; lasts as long as the source. `ask` is called once
  // for the same parameters.
  template <typename Ask>
  const Answer& AnswerTo(const Parameters& parameters, const Ask& ask) const {
    const std::string key = core::CompactJson(parameters.ToJson());
    const std::lock_guard lock(mutex_);
    const auto found = answers_.find(key);
    if (found != answers_.end()) return found->second;
    return answers_.emplace(key, ask()).first->second;
  }

 private:
  std::string name_;
  std::unique_ptr<const Description> description_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Answer> answers_;  // by the parameters as JSON
};

}  // namespace rockyard::plugin
