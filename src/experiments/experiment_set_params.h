// The experiments that a scenario can name: each with its parameters, what it asks of the drive,
// how it is made, and its columns. A part of every scenario; whoever reads a store takes the roles
// of its columns from here.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "core/kind_set.h"
#include "trial/drive_checks_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {
struct Watchers;
}
namespace rockyard::truth {
struct ValueInfo;
}

namespace rockyard::experiments {

class Experiment;

using Columns = std::vector<truth::ValueInfo>;  // truth::RecordSchema

// All that is needed to add an experiment. `Params` has `void Visit(core::FieldVisitor&)`; one
// without parameters takes core::NoParams.
template <typename Params>
struct ExperimentDescription {
  std::string_view name;  // a literal; scenario files and stored runs hold it, so it must stay
  // What it asks of the drive beside trial::RequireConsistency.
  void (*require)(const Params&, const trial::DriveParams&, core::FieldVisitor&) = nullptr;
  std::unique_ptr<Experiment> (*make)(const Params&, const trial::DriveParams&,
                                      const trial::Watchers&) = nullptr;
  // Every column that a record of it may have, with roles, but the number of the cell.
  const Columns& (*columns)() = nullptr;
  trial::LightStripeUse light_stripe = trial::LightStripeUse::kAsTerrainSensor;
};

// One of a set, whatever its parameters.
class ExperimentKind : public core::Kind {
 public:
  using core::Kind::Kind;

  virtual std::unique_ptr<ExperimentKind> Clone() const = 0;
  virtual void Require(const trial::DriveParams& drive, core::FieldVisitor& v) const = 0;
  virtual std::unique_ptr<Experiment> Make(const trial::DriveParams& drive,
                                           const trial::Watchers& watchers) const = 0;
  virtual const Columns& columns() const = 0;
};

class ExperimentSet : public core::KindSet<ExperimentKind> {
 public:
  ExperimentSet();

  // Throws core::UserError where the name is taken or is no key at all. Needs
  // experiments/experiment.h.
  template <typename Params>
  void Add(const ExperimentDescription<Params>& description) {
    AddKind(std::make_unique<KindOf<Params>>(description));
  }

 private:
  template <typename Params>
  struct KindOf final : core::KindWithParams<ExperimentKind, Params> {
    explicit KindOf(const ExperimentDescription<Params>& of)
        : core::KindWithParams<ExperimentKind, Params>(of.name, "the experiment of that name", {}),
          description(of) {}

    std::unique_ptr<ExperimentKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }
    void Require(const trial::DriveParams& drive, core::FieldVisitor& v) const override {
      trial::RequireConsistency(drive, description.light_stripe, v);
      description.require(this->params, drive, v);
    }
    std::unique_ptr<Experiment> Make(const trial::DriveParams& drive,
                                     const trial::Watchers& watchers) const override {
      return description.make(this->params, drive, watchers);
    }
    const Columns& columns() const override { return description.columns(); }

    ExperimentDescription<Params> description;
  };
};

// The one list of them. Chosen: drive.
ExperimentSet StandardExperiments();

}  // namespace rockyard::experiments
