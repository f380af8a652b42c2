// Where navigators, estimators and readers that the program does not hold come from, and kinds of
// them with their parameters: what they have in common.
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

// The source of one kind of `Thing`, of which a plugin says no more than what is wrong with
// parameters.
template <typename Thing, typename Setup>
class CheckedSource : public ForeignSource<Problems> {
 public:
  using ForeignSource::ForeignSource;

  // Returns what is wrong with parameters; lasts as long as the source. Throws core::UserError
  // where the plugin fails to say it. Asks once for the same parameters.
  const Problems& ProblemsOf(const Parameters& parameters) const {
    return AnswerTo(parameters, [&] { return ReadProblems(AskProblems(parameters), name()); });
  }
  // Makes the thing of one drive. Throws navigation::NavigatorFault.
  virtual std::unique_ptr<Thing> Make(const Parameters& parameters, const Setup& setup) const = 0;

 protected:
  // Returns an object with "problems". Throws core::UserError.
  virtual core::JsonValue AskProblems(const Parameters& parameters) const = 0;
};

// A kind of such things, with its parameters: `Kind` of a set, and `Derived` what it is in the end.
template <typename Derived, typename Kind, typename Source, typename Thing, typename Setup>
class CheckedKind : public Kind {
 public:
  explicit CheckedKind(std::shared_ptr<const Source> source)
      : Kind(source->description().name, source->description().doc),
        source_(std::move(source)),
        parameters_(source_->description()) {}

  bool has_params() const override { return !parameters_.values().empty(); }
  void Visit(core::FieldVisitor& v) override {
    parameters_.Visit(v);
    for (const core::Problem& problem : source_->ProblemsOf(parameters_)) {
      v.Require(problem.path, false, problem.reason, problem.suggestion);
    }
  }
  bool foreign() const override { return true; }
  bool IsOf(const std::shared_ptr<const Source>& source) const { return source_ == source; }
  std::unique_ptr<Thing> Make(const Setup& setup) const override {
    return source_->Make(parameters_, setup);
  }
  std::unique_ptr<Kind> Clone() const override {
    return std::make_unique<Derived>(static_cast<const Derived&>(*this));
  }

 protected:
  const Description& description() const { return source_->description(); }

 private:
  std::shared_ptr<const Source> source_;
  Parameters parameters_;
};

}  // namespace rockyard::plugin
