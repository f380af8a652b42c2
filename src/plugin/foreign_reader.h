// Readers of images that the program does not hold: of a shared library (library.h), as kinds of a
// PointReaderSet. Scenarios add them (plugin_use.h).
#pragma once

#include <memory>
#include <utility>

#include "perception/point_reader.h"
#include "perception/point_reader_set_params.h"
#include "plugin/description.h"
#include "plugin/foreign_source.h"

namespace rockyard::plugin {

// Where readers of one kind come from. Shared by all copies of the kind; any thread may call it.
class ReaderSource : public ForeignSource<Problems> {
 public:
  using ForeignSource::ForeignSource;

  // Returns what is wrong with parameters; lasts as long as the source. Throws core::UserError
  // where the plugin fails to say it. Asks once for the same parameters.
  const Problems& ProblemsOf(const Parameters& parameters) const {
    return AnswerTo(parameters, [&] { return ReadProblems(AskProblems(parameters), name()); });
  }
  // Makes the reader of one drive. Throws navigation::NavigatorFault.
  virtual std::unique_ptr<perception::PointReader> Make(
      const Parameters& parameters, const perception::PointReaderSetup& setup) const = 0;

 protected:
  // Returns an object with "problems". Throws core::UserError.
  virtual core::JsonValue AskProblems(const Parameters& parameters) const = 0;
};

// A kind of such readers, with its parameters.
class ForeignReaderKind final : public perception::PointReaderKind {
 public:
  explicit ForeignReaderKind(std::shared_ptr<const ReaderSource> source)
      : PointReaderKind(source->description().name, source->description().doc),
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
  bool IsOf(const std::shared_ptr<const ReaderSource>& source) const { return source_ == source; }
  std::unique_ptr<perception::PointReader> Make(
      const perception::PointReaderSetup& setup) const override {
    return source_->Make(parameters_, setup);
  }
  std::unique_ptr<perception::PointReaderKind> Clone() const override {
    return std::make_unique<ForeignReaderKind>(*this);
  }

 private:
  std::shared_ptr<const ReaderSource> source_;
  Parameters parameters_;
};

}  // namespace rockyard::plugin
