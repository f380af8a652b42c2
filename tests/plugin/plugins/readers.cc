// Readers of images for the tests of the layer and of its host, and a navigator beside them: `told`
// makes a point of each number that it was told, (number, place, 0); `faulty` fails as its
// parameter says.
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "plugin/navigator_plugin.h"
#include "plugin/reader_plugin.h"
#include "plugin/whole_messages.h"

namespace {

using namespace rockyard;

struct ToldParams {
  double shift_m = 0.5;
  double reach_m = 2.0;

  void Visit(core::FieldVisitor& v) {
    v.Real("shift_m", shift_m, core::Assumed("of all points", "a test", {-10.0, 10.0}));
    v.Real("reach_m", reach_m, core::Setting("how far it sees"));
    v.Require("shift_m", shift_m <= reach_m, "is beyond reach_m", "use less");
  }
};

class Told final : public perception::PointReader {
 public:
  Told(const ToldParams& params, const perception::PointReaderSetup& setup)
      : params_(params), setup_(setup) {}

  std::vector<math::Vector3> Points(const messages::LookImages& images) const override {
    plugin::MemberList list;
    plugin::AddImages(images, list);
    plugin::AddRover(setup_.rover, list);
    list.Add("setup.max_range_m", setup_.max_range_m);
    list.Add("shift_m", params_.shift_m);
    std::vector<math::Vector3> points;
    for (const auto& [path, value] : list.values()) {
      points.emplace_back(value, static_cast<double>(points.size()), 0.0);
    }
    return points;
  }

 private:
  ToldParams params_;
  perception::PointReaderSetup setup_;
};

perception::PointReaderDescription<ToldParams> DescribeTold() {
  return {.name = "told",
          .doc = "shows what it was told",
          .make = [](const ToldParams& params, const perception::PointReaderSetup& setup)
              -> std::unique_ptr<perception::PointReader> {
            return std::make_unique<Told>(params, setup);
          }};
}

enum class Way { kNone, kThrows, kNotANumber, kSlow, kNothing, kThrowsAtStart };

struct FaultyParams {
  std::int64_t way = 0;

  void Visit(core::FieldVisitor& v) {
    v.Integer("way", way, core::Setting("how it fails, of Way", {0, 5}));
  }
};

class Faulty final : public perception::PointReader {
 public:
  explicit Faulty(Way way) : way_(way) {}

  std::vector<math::Vector3> Points(const messages::LookImages&) const override {
    if (way_ == Way::kThrows) throw std::runtime_error("it rains");
    if (way_ == Way::kNotANumber) return {{1.0, 2.0, 3.0}, {1.0, std::nan(""), 3.0}};
    if (way_ == Way::kSlow) {
      volatile double sum = 0.0;
      for (int i = 0; i < 100'000'000; ++i) sum = sum + 1.0;
    }
    if (way_ == Way::kNothing) return {};
    return {{1.0, 2.0, 3.0}};
  }

 private:
  Way way_;
};

perception::PointReaderDescription<FaultyParams> DescribeFaulty() {
  return {
      .name = "faulty",
      .doc = "fails",
      .make = [](const FaultyParams& params,
                 const perception::PointReaderSetup&) -> std::unique_ptr<perception::PointReader> {
        const auto way = static_cast<Way>(params.way);
        if (way == Way::kThrowsAtStart) throw std::runtime_error("it sleeps");
        return std::make_unique<Faulty>(way);
      }};
}

class Idle final : public navigation::Navigator {
 public:
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput&) override { return {}; }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
};

navigation::NavigatorDescription<core::NoParams> DescribeIdle() {
  return {.name = "idle",
          .doc = "stands",
          .traits = [](const core::NoParams&) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {"", 0.25}};
          },
          .make = [](const core::NoParams&, const navigation::NavigatorSetup&)
              -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Idle>(); }};
}

}  // namespace

ROCKYARD_PLUGIN(DescribeTold, DescribeIdle, DescribeFaulty)
