#include "experiments/hazard_detection/hazard_detection.h"

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "experiments/hazard_detection/columns.h"
#include "experiments/record_of.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

std::unique_ptr<HazardStudyRunner> MakeStudy(const HazardDetectionParams& params,
                                             const trial::DriveParams& drive,
                                             const trial::ScanWatcher& watcher) {
  switch (params.study) {
    case HazardStudy::kDetection:
      return MakeDetectionStudy(params, drive, watcher);
    case HazardStudy::kApproach:
      return MakeApproachStudy(params, drive, watcher);
    case HazardStudy::kFalseAlarm:
      return MakeAlarmStudy(params, drive, watcher);
    case HazardStudy::kMissed:
      return MakeMissedStudy(params, drive, watcher);
    case HazardStudy::kPrecision:
      return MakePrecisionStudy(params, drive, watcher);
  }
  throw std::logic_error("unknown study");
}

truth::RecordSchema MakeSchema(const CellTable& table, const HazardStudyRunner& study) {
  std::vector<std::string_view> names = table.columns();
  for (const std::string_view name : study.columns()) names.push_back(name);
  return truth::MeasurementSchema(HazardColumns(), names);
}

}  // namespace

HazardDetectionExperiment::HazardDetectionExperiment(const HazardDetectionParams& params,
                                                     const trial::DriveParams& drive,
                                                     const trial::ScanWatcher& watcher)
    : table_(params.Factors()),
      study_(MakeStudy(params, drive, watcher)),
      schema_(MakeSchema(table_, *study_)) {}

truth::Record HazardDetectionExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t cell = index % table_.size();
    truth::Record record{index, truth::TrialOutcome::kMeasured, "", {static_cast<double>(cell)}};
    for (const double value : table_.Values(cell)) record.values.push_back(value);
    for (const double value : study_->Measure(cell, key)) record.values.push_back(value);
    return record;
  });
}

}  // namespace rockyard::experiments
