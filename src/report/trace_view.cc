#include "report/trace_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "report/csv.h"

namespace rockyard::report {
namespace {

bool SameBits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

constexpr const char* kHeader =
    "row,time_s,kind,true_x_m,true_y_m,true_heading_rad,tilt_rad,believed_x_m,believed_y_m,"
    "believed_heading_rad,odometer_m,detail\n";

// `sample` gives what is neither time nor true pose; null leaves it empty.
std::string Line(const char* row, double time_s, const std::string& kind, const math::Pose2& pose,
                 const truth::TraceSample* sample, const std::string& detail) {
  CsvRow fields(row, time_s, kind, pose.x_m, pose.y_m, pose.heading_rad);
  if (sample == nullptr) {
    fields.AddEmpty(5);
  } else {
    const messages::PoseEstimate& e = sample->estimate;
    fields.Add(sample->tilt_rad, e.x_m, e.y_m, e.heading_rad, e.distance_m);
  }
  return fields.Add(detail).Line();
}

}  // namespace

const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s) {
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time_s,
      [](double t, const truth::TraceSample& sample) { return t < sample.time_s; });
  return after == samples.begin() ? nullptr : &*(after - 1);
}

std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now) {
  std::vector<std::string> differences;
  if (stored.outcome != now.outcome) {
    differences.push_back(fmt::format("outcome: stored {}, now {}", truth::Name(stored.outcome),
                                      truth::Name(now.outcome)));
  }
  if (stored.detail != now.detail) {
    differences.push_back(
        fmt::format("detail: stored \"{}\", now \"{}\"", stored.detail, now.detail));
  }
  if (stored.values.size() != now.values.size()) {
    differences.push_back(
        fmt::format("values: stored {}, now {}", stored.values.size(), now.values.size()));
    return differences;
  }
  for (std::size_t i = 0; i < now.values.size(); ++i) {
    if (SameBits(stored.values[i], now.values[i])) continue;
    const std::string name = i < schema.size() ? schema[i].name : fmt::format("value {}", i);
    differences.push_back(
        fmt::format("{}: stored {}, now {}", name, stored.values[i], now.values[i]));
  }
  return differences;
}

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
