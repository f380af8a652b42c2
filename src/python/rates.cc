#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "python/parts.h"
#include "statistics/equivalence.h"
#include "statistics/multiple_testing.h"
#include "statistics/proportions.h"
#include "statistics/sample_size.h"
#include "statistics/sample_statistics.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
namespace st = statistics;

st::IntervalMethod MethodOf(const std::string& method) {
  if (method == "wilson") return st::IntervalMethod::kWilson;
  if (method == "clopper_pearson") return st::IntervalMethod::kClopperPearson;
  throw core::UserError("method", "is \"" + method + "\"", "use wilson or clopper_pearson");
}

void RequireConfidence(double confidence) {
  if (confidence > 0.0 && confidence < 1.0) return;
  throw core::UserError("confidence", "is not between 0 and 1", "use 0.95");
}

template <typename Number>
void RequireCounts(Number count, Number trials, double confidence) {
  if (!(count >= Number{0} && count <= trials)) {
    throw core::UserError("count", "is not from 0 to the number of trials", "");
  }
  RequireConfidence(confidence);
}

void RequireFinite(const std::vector<double>& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) throw core::UserError("values", "hold one that is not finite", "");
  }
}

py::tuple Ends(const st::Interval& interval) { return py::make_tuple(interval.low, interval.high); }

}  // namespace

void BindRates(py::module_& module) {
  module.def("proportion", [](std::int64_t count, std::int64_t trials, double confidence,
                              const std::string& method) {
    RequireCounts(count, trials, confidence);
    const st::Proportion made = st::MakeProportion(count, trials, confidence, MethodOf(method));
    return py::make_tuple(made.rate, made.interval.low, made.interval.high,
                          std::string(st::MethodName(made.method)));
  });
  module.def("exact_interval", [](double count, double trials, double confidence) {
    RequireCounts(count, trials, confidence);
    return Ends(st::ExactInterval(count, trials, confidence));
  });
  module.def("wilson_interval", [](std::int64_t count, std::int64_t trials, double confidence) {
    RequireCounts(count, trials, confidence);
    return Ends(st::ProportionInterval(count, trials, confidence));
  });
  module.def("difference", [](std::int64_t count_1, std::int64_t trials_1, std::int64_t count_2,
                              std::int64_t trials_2, double confidence) {
    RequireCounts(count_1, trials_1, confidence);
    RequireCounts(count_2, trials_2, confidence);
    return Ends(st::DifferenceInterval(st::MakeProportion(count_1, trials_1, confidence),
                                       st::MakeProportion(count_2, trials_2, confidence),
                                       confidence));
  });
  module.def("paired_difference", [](std::int64_t both, std::int64_t only_first,
                                     std::int64_t only_second, std::int64_t neither,
                                     double confidence, const std::string& method) {
    const st::PairedCounts counts{both, only_first, only_second, neither};
    RequireCounts(std::int64_t{0}, std::min({both, only_first, only_second, neither}), confidence);
    if (method == "tango") return Ends(st::DifferenceInterval(counts, confidence));
    if (method != "agresti_min") {
      throw core::UserError("method", "is \"" + method + "\"", "use agresti_min or tango");
    }
    const auto n = static_cast<double>(both + only_first + only_second + neither);
    const auto sum = static_cast<double>(only_second - only_first);
    const auto squares = static_cast<double>(only_second + only_first);
    return Ends(st::AgrestiMinInterval({.n = n, .sum = sum, .squares = squares}, confidence));
  });
  module.def("fisher", [](std::int64_t count_1, std::int64_t trials_1, std::int64_t count_2,
                          std::int64_t trials_2) {
    RequireCounts(count_1, trials_1, st::kConfidence);
    RequireCounts(count_2, trials_2, st::kConfidence);
    return st::FisherExactPValue({.success_1 = count_1,
                                  .failure_1 = trials_1 - count_1,
                                  .success_2 = count_2,
                                  .failure_2 = trials_2 - count_2});
  });
  module.def("mcnemar", [](std::int64_t only_first, std::int64_t only_second) {
    RequireCounts(std::int64_t{0}, std::min(only_first, only_second), st::kConfidence);
    return st::McNemarExactPValue(only_first, only_second);
  });
  module.def("poisson", [](std::int64_t count, double confidence) {
    RequireCounts(std::int64_t{0}, count, confidence);
    return Ends(st::PoissonInterval(count, confidence));
  });
  module.def("holm", [](const std::vector<double>& p_values) { return st::HolmAdjust(p_values); });
  module.def("quantile", [](const std::vector<double>& values, double share) {
    if (!(share >= 0.0 && share <= 1.0)) {
      throw core::UserError("share", "is not from 0 to 1", "use 0.5 for the median");
    }
    return st::Quantile(st::SortedFinite(values), share);
  });
  module.def("median_interval", [](const std::vector<double>& values, double confidence) {
    RequireConfidence(confidence);
    return Ends(st::MedianInterval(st::SortedFinite(values), confidence));
  });
  module.def("student_interval", [](const std::vector<double>& values, double confidence) {
    RequireConfidence(confidence);
    RequireFinite(values);
    return Ends(st::DifferenceInterval(st::PairedMeans(values), confidence));
  });
  module.def("student_tail", [](double t, double freedom) {
    if (!(t >= 0.0 && freedom > 0.0)) {
      throw core::UserError("t", "or the freedom is out of bounds", "use t >= 0, freedom > 0");
    }
    return 0.5 * st::ChangePValue({t, 1.0, freedom});
  });
  module.def("trials_for_half_width", [](double rate, double half_width, double confidence) {
    RequireConfidence(confidence);
    if (!(rate >= 0.0 && rate <= 1.0 && half_width > 0.0 && half_width < 0.5)) {
      throw core::UserError("half_width", "or rate is out of bounds",
                            "use a rate from 0 to 1 and a half-width between 0 and 0.5");
    }
    return st::TrialsForHalfWidth(rate, half_width, confidence, st::IntervalMethod::kWilson);
  });
}

}  // namespace rockyard::python
