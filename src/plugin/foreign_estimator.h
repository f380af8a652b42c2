// Estimators that the program does not hold: of a shared library (library.h), as kinds of an
// EstimatorSet. Scenarios add them (plugin_use.h).
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "plugin/description.h"
#include "plugin/foreign_source.h"

namespace rockyard::plugin {

// Where estimators of one kind come from. Shared by all copies of the kind; any thread may call it.
class EstimatorSource : public ForeignSource<Problems> {
 public:
  using ForeignSource::ForeignSource;

  // Returns what is wrong with parameters; lasts as long as the source. Throws core::UserError
  // where the plugin fails to say it. Asks once for the same parameters.
  const Problems& ProblemsOf(const Parameters& parameters) const {
    return AnswerTo(parameters, [&] { return ReadProblems(AskProblems(parameters), name()); });
  }
  // Makes the estimator of one drive. Throws navigation::NavigatorFault.
  virtual std::unique_ptr<localization::Estimator> Make(
      const Parameters& parameters, const localization::EstimatorSetup& setup) const = 0;

 protected:
  // Returns an object with "problems". Throws core::UserError.
  virtual core::JsonValue AskProblems(const Parameters& parameters) const = 0;
};

// A kind of such estimators, with its parameters.
class ForeignEstimatorKind final : public localization::EstimatorKind {
 public:
  explicit ForeignEstimatorKind(std::shared_ptr<const EstimatorSource> source)
      : EstimatorKind(source->description().name, source->description().doc),
        source_(std::move(source)),
        parameters_(source_->description()) {}

  bool has_params() const override { return !parameters_.values().empty(); }
  void Visit(core::FieldVisitor& v) override {
    parameters_.Visit(v);
    for (const core::Problem& problem : source_->ProblemsOf(parameters_)) {
      v.Require(problem.path, false, problem.reason, problem.suggestion);
    }
  }
  bool takes_fixes() const override { return source_->description().takes_fixes; }
  bool takes_motions() const override { return source_->description().takes_motions; }
  std::span<const messages::OwnValue> own_values() const override {
    return source_->description().own_values;
  }
  bool foreign() const override { return true; }
  bool IsOf(const std::shared_ptr<const EstimatorSource>& source) const {
    return source_ == source;
  }
  std::unique_ptr<localization::Estimator> Make(
      const localization::EstimatorSetup& setup) const override {
    return source_->Make(parameters_, setup);
  }
  std::unique_ptr<localization::EstimatorKind> Clone() const override {
    return std::make_unique<ForeignEstimatorKind>(*this);
  }

 private:
  std::shared_ptr<const EstimatorSource> source_;
  Parameters parameters_;
};

}  // namespace rockyard::plugin
