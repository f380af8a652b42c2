// What one run of an experiment is: a pure function from (seed, index) to a record.
#pragma once

#include <cstdint>
#include <memory>

#include "experiments/experiment_params.h"
#include "trial/watchers.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Thread-safe: Run may be called at the same time from several threads with different indices.
class Experiment {
 public:
  virtual ~Experiment() = default;

  virtual const truth::RecordSchema& schema() const = 0;

  // The record of trial `index` of the campaign `seed`: the same bits whatever ran before, on
  // whatever thread. Simulator faults (contract violations, NaN, exceptions of the simulation) come
  // back as an outcome with a detail that names the seed and the index; nothing is thrown for them.
  // Throws what core::IsMachineFailure: the machine was short of memory, files or disk.
  virtual truth::Record Run(std::uint64_t seed, std::uint64_t index) const = 0;
};

// Makes the experiment that `experiment` names, on `drive`. `watchers` are shown what
// runs see and decide, without any influence on the records; they must stand calls from several
// threads where Run is called from several.
std::unique_ptr<Experiment> MakeExperiment(const ExperimentParams& experiment,
                                           const trial::DriveParams& drive,
                                           const trial::Watchers& watchers = {});

// The schema of a store, which keeps names and no roles, with the roles of its columns: those of
// the experiment that knows the most of the names. A column that it does not know (any more) stays
// a value, which cells do not add up.
truth::RecordSchema WithRoles(truth::RecordSchema stored);

}  // namespace rockyard::experiments
