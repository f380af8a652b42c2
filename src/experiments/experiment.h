/// @file
/// What one run of an experiment is: a pure function from (seed, index) to a record. Campaigns run
/// experiments through this interface, and `api` gives it to other programs.
#pragma once

#include <cstdint>

#include "truth/record.h"

namespace rockyard::experiments {

/// An experiment with all its parameters fixed. Thread-safe: Run may be called at the same time
/// from several threads with different indices.
class Experiment {
 public:
  virtual ~Experiment() = default;

  /// Returns name, unit and meaning of each value of a record, in their order.
  virtual const truth::RecordSchema& schema() const = 0;

  /// Returns the record of trial `index` of the campaign `seed`: the same bits whatever ran before,
  /// on whatever thread. All random numbers come from streams of (seed, index). Simulator faults
  /// (contract violations, NaN, exceptions of the simulation) come back as an outcome with a detail
  /// that names the seed and the index; nothing is thrown for them. Throws what
  /// core::IsMachineFailure: the machine was short of memory, files or disk. Cost: from
  /// milliseconds to minutes of one thread, by the scenario.
  virtual truth::Record Run(std::uint64_t seed, std::uint64_t index) const = 0;
};

}  // namespace rockyard::experiments
