// A campaign without some of its trials.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "batch/work_source.h"

namespace rockyard::batch {

// Hands out what `source` has, but for trials that hang or are killed: they stay pending. A round
// of a stopping rule that has one of them never ends, so that everything ends with it.
class LeavingOutSource final : public WorkSource {
 public:
  LeavingOutSource(LocalWorkSource& source, std::vector<TrialId> left_out);

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override { source_.Close(); }

 private:
  LocalWorkSource& source_;
  const std::vector<TrialId> left_out_;
  std::mutex mutex_;
  int running_ = 0;
};

}  // namespace rockyard::batch
