// Navigators that the program does not hold: of a shared library (library.h) or in a process of
// their own (process.h), as kinds of a NavigatorSet. Scenarios add them (plugin_use.h).
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "core/json_value.h"
#include "navigation/navigator.h"
#include "navigation/navigator_fault.h"
#include "navigation/navigator_set_params.h"
#include "plugin/description.h"
#include "plugin/foreign_source.h"

namespace rockyard::plugin {

// Where navigators of one kind come from. Shared by all copies of the kind; any thread may call it.
class NavigatorSource : public ForeignSource<Traits> {
 public:
  using ForeignSource::ForeignSource;

  // Returns what a trial has to know; lasts as long as the source. Throws core::UserError where the
  // plugin fails to say it. Asks once for the same parameters.
  const Traits& TraitsOf(const Parameters& parameters) const;
  // Makes the navigator of one drive. Throws navigation::NavigatorFault.
  virtual std::unique_ptr<navigation::Navigator> Make(
      const Parameters& parameters, const navigation::NavigatorSetup& setup) const = 0;

 protected:
  // Returns the answer to "traits". Throws core::UserError.
  virtual core::JsonValue AskTraits(const Parameters& parameters) const = 0;
};

// A kind of such navigators, with its parameters.
class ForeignKind final : public navigation::NavigatorKind {
 public:
  explicit ForeignKind(std::shared_ptr<const NavigatorSource> source)
      : NavigatorKind(source->description().name, source->description().doc),
        source_(std::move(source)),
        parameters_(source_->description()) {}

  bool has_params() const override { return !parameters_.values().empty(); }
  void Visit(core::FieldVisitor& v) override;
  navigation::NavigatorTraits traits() const override {
    const Traits& traits = traits_ != nullptr ? *traits_ : source_->TraitsOf(parameters_);
    return traits.AsNavigatorTraits();
  }
  std::span<const messages::OwnValue> own_values() const override {
    return source_->description().own_values;
  }
  bool foreign() const override { return true; }
  bool IsOf(const std::shared_ptr<const NavigatorSource>& source) const {
    return source_ == source;
  }
  std::unique_ptr<navigation::Navigator> Make(
      const navigation::NavigatorSetup& setup) const override {
    return source_->Make(parameters_, setup);
  }
  std::unique_ptr<navigation::NavigatorKind> Clone() const override {
    return std::make_unique<ForeignKind>(*this);
  }

 private:
  std::shared_ptr<const NavigatorSource> source_;  // which outlives the traits
  Parameters parameters_;
  const Traits* traits_ =
      nullptr;  // of parameters_, as the last Visit left them; null: never visited
};

// Throws navigation::NavigatorFault where the decision cannot be done: a number that is none, a
// speed share or a direction out of bounds.
void CheckDecision(const navigation::NavigatorDecision& decision);

// Throws navigation::NavigatorFault where an overlay is too large to show, or its grid is none.
void CheckOverlay(const messages::Overlay& overlay);

}  // namespace rockyard::plugin
