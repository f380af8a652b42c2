// Two navigators for the tests of the layer and of its host: `echo` shows all that it was told as
// lines of its overlay, "PATH" through the point (value, 0), and decides what its parameters say;
// `every_type` has a parameter of each type, and shows those in the same way.
#include <string>
#include <vector>

#include "plugin/navigator_plugin.h"
#include "plugin/whole_messages.h"

namespace {

using namespace rockyard;
using core::Setting;
using navigation::NavigatorDecision;

enum class Place { kFirst, kSecond, kThird };

}  // namespace

template <>
struct rockyard::core::EnumNames<Place> {
  static constexpr std::array<std::string_view, 3> kNames{"first", "second", "third"};
};

namespace {

// Shows numbers and texts.
class Shown {
 public:
  void Add(const std::string& name, double value) {
    overlay_.lines.push_back({name, {{value, 0.0}}});
  }
  void Add(const std::string& prefix, const std::map<std::string, double>& members) {
    for (const auto& [path, value] : members) Add(prefix + path, value);
  }
  messages::Overlay& overlay() { return overlay_; }
  const messages::Overlay& overlay() const { return overlay_; }

 private:
  messages::Overlay overlay_;
};

struct EchoParams {
  double goal_tolerance_m = 0.25;
  std::int64_t status = 0;
  std::int64_t look = 2;
  std::int64_t kind = 1;
  bool shows_grid = false;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m, Setting("arrives within", {0.0, 5.0}));
    v.Integer("status", status, Setting("what it says", {0, 3}));
    v.Integer("look", look, Setting("0: none, 1: ahead, 2: behind", {0, 2}));
    v.Integer("kind", kind, Setting("of its motion", {0, 2}));
    v.Boolean("shows_grid", shows_grid, Setting("shows a grid, too"));
  }
};

class Echo final : public navigation::Navigator {
 public:
  Echo(const EchoParams& params, const navigation::NavigatorSetup& setup) : params_(params) {
    shown_.Add("setup.", plugin::MembersOf(setup));
  }

  NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    ++own_[0];
    own_[1] = input.time_s;
    shown_.overlay() = {};
    shown_.Add("input.", plugin::MembersOf(input));
    if (params_.shows_grid) {
      shown_.overlay().grids.push_back(
          {"cost", 1.5, 2.5, 0.25, 2, 1, {0.5, std::numeric_limits<double>::quiet_NaN()}});
    }
    NavigatorDecision decision = plugin::WholeDecision();
    decision.status = static_cast<navigation::NavigatorStatus>(params_.status);
    decision.look.reset();
    if (params_.look == 1) decision.look = messages::LookDirection::kAhead;
    if (params_.look == 2) decision.look = messages::LookDirection::kBehind;
    decision.motion.kind = static_cast<messages::MotionKind>(params_.kind);
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    Jump("update", before, after);
  }
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    Jump("correction", before, after);
  }
  void SetGoal(const messages::Goal& goal, navigation::GoalChange change) override {
    plugin::MemberList list;
    list.AddPlace(change == navigation::GoalChange::kMoved ? "moved" : "next", goal);
    shown_.Add("", list.values());
  }
  const messages::Overlay* overlay() const override { return &shown_.overlay(); }
  std::span<const double> own_values() const override { return own_; }

 private:
  void Jump(const std::string& name, const messages::PoseEstimate& before,
            const messages::PoseEstimate& after) {
    plugin::MemberList list;
    list.AddPose(name + ".before", before);
    list.AddPose(name + ".after", after);
    shown_.Add("", list.values());
  }

  EchoParams params_;
  Shown shown_;
  std::vector<double> own_{0.0, 0.0};
};

navigation::NavigatorDescription<EchoParams> DescribeEcho() {
  return {.name = "echo",
          .doc = "tells what it is told",
          .traits = [](const EchoParams& params) -> navigation::NavigatorTraits {
            navigation::NavigatorTraits traits(navigation::LookReading::kPoints,
                                               navigation::CostOfMap{0.5, 25.0},
                                               {"goal_tolerance_m", params.goal_tolerance_m});
            traits.steers_on_the_move = params.kind == 2;
            traits.images = params.look == 1;
            return traits;
          },
          .make = [](const EchoParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Echo>(params, setup);
          },
          .own_values = {{"decisions", "1", "how often it was asked"},
                         {"last_time_s", "s", "when it was asked last"}}};
}

struct InnerParams {
  double low = 1.0;
  double high = 2.0;

  void Visit(core::FieldVisitor& v) {
    v.Real("low", low, Setting("lower end"));
    v.Real("high", high, Setting("upper end"));
    v.Require("low", low <= high, "is above high", "use less");
  }
};

struct EveryTypeParams {
  double real = 1.5;
  double angle_rad = 0.5;
  std::int64_t integer = -7;
  bool boolean = true;
  std::string text = "a \"quoted\" \\ text\n\tof two lines";
  std::vector<double> reals{1.25, 2.25};
  std::array<double, 3> fixed{3.25, 4.25, 5.25};
  std::vector<std::int64_t> integers{6, -5};
  Place choice = Place::kSecond;
  InnerParams inner;

  void Visit(core::FieldVisitor& v) {
    v.Real("real", real,
           core::Assumed("a real \"number\"", "nobody knows", {-2.5, 2.5}, {1.0, 2.0}));
    v.Angle("angle_deg", angle_rad, core::Published("an angle", "a paper", {0.0, 180.0}));
    v.Integer("integer", integer, core::Calibrated("an integer", "a fit", {-10, 10}));
    v.Boolean("boolean", boolean, Setting("a boolean"));
    v.Text("text", text, Setting("a text"));
    v.Reals("reals", reals, Setting("reals", {0.0, 10.0}));
    v.FixedReals("fixed", fixed, Setting("three reals"));
    v.Integers("integers", integers, Setting("integers"));
    v.Choice("choice", choice, Setting("a choice"));
    v.Group("inner", inner, "a group in it");
    v.Require("real", real < 2.25, "is too large", "use less than 2.25");
  }
};

class EveryType final : public navigation::Navigator {
 public:
  explicit EveryType(const EveryTypeParams& params) {
    plugin::MemberList list;
    list.Add("real", params.real);
    list.Add("angle_rad", params.angle_rad);
    list.Add("integer", params.integer);
    list.Add("boolean", params.boolean);
    list.Add("text:" + params.text, 0.0);
    list.AddList("reals", params.reals);
    list.AddList("fixed", params.fixed);
    list.AddList("integers", params.integers);
    list.Add("choice", params.choice);
    list.Add("inner.low", params.inner.low);
    list.Add("inner.high", params.inner.high);
    shown_.Add("", list.values());
  }

  NavigatorDecision Decide(const navigation::NavigatorInput&) override { return {}; }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
  const messages::Overlay* overlay() const override { return &shown_.overlay(); }

 private:
  Shown shown_;
};

navigation::NavigatorDescription<EveryTypeParams> DescribeEveryType() {
  return {.name = "every_type",
          .doc = "has a parameter of each type",
          .traits = [](const EveryTypeParams& params) -> navigation::NavigatorTraits {
            navigation::NavigatorTraits traits(navigation::LookReading::kHazardReport,
                                               navigation::CostOfJudgement{},
                                               {"real", params.real});
            traits.looks_on_the_move = params.boolean;
            return traits;
          },
          .make = [](const EveryTypeParams& params,
                     const navigation::NavigatorSetup&) -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<EveryType>(params);
          }};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeEcho, DescribeEveryType)
