#include "report/trace_csv.h"

#include <cstddef>
#include <vector>

#include "report/csv.h"

namespace rockyard::report {
namespace {

constexpr const char* kHeader =
    "row,time_s,kind,true_x_m,true_y_m,true_heading_rad,tilt_rad,believed_x_m,believed_y_m,"
    "believed_heading_rad,odometer_m,detail\n";

// `sample` gives what is neither time nor true pose; null leaves it empty.
std::string Line(const char* row, double time_s, const std::string& kind, const math::Pose2& pose,
                 const truth::TraceSample* sample, const std::string& detail) {
  std::vector<std::string> fields = {row,
                                     CsvNumber(time_s),
                                     CsvField(kind),
                                     CsvNumber(pose.x_m),
                                     CsvNumber(pose.y_m),
                                     CsvNumber(pose.heading_rad)};
  if (sample == nullptr) {
    fields.resize(fields.size() + 5);
  } else {
    const messages::PoseEstimate& e = sample->estimate;
    for (const double value : {sample->tilt_rad, e.x_m, e.y_m, e.heading_rad, e.distance_m}) {
      fields.push_back(CsvNumber(value));
    }
  }
  fields.push_back(CsvField(detail));
  return CsvLine(fields);
}

}  // namespace

std::string TraceCsv(const truth::Trace& trace) {
  std::string csv = kHeader;
  std::size_t next = 0;
  const truth::TraceSample* last = nullptr;
  const auto events_before = [&](double time_s) {
    for (; next < trace.events.size() && trace.events[next].time_s < time_s; ++next) {
      const truth::TraceEvent& event = trace.events[next];
      csv += Line("event", event.time_s, event.kind, event.pose, last, event.detail);
    }
  };
  for (const truth::TraceSample& sample : trace.samples) {
    events_before(sample.time_s);
    csv += Line("sample", sample.time_s, sample.activity, sample.pose, &sample, "");
    last = &sample;
  }
  for (; next < trace.events.size(); ++next) {
    const truth::TraceEvent& event = trace.events[next];
    csv += Line("event", event.time_s, event.kind, event.pose, last, event.detail);
  }
  return csv;
}

}  // namespace rockyard::report
