#include "plugin/answerer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/json_text.h"
#include "plugin/messages_json.h"

namespace rockyard::plugin {
namespace {

using core::JsonValue;
using navigation::FaultKind;
using navigation::LimitParams;
using navigation::NavigatorFault;

constexpr std::int64_t kProtocol = 1;

// Asks, and reads the answer. Throws NavigatorFault, also where the answer is an error.
JsonValue AskJson(Answerer& answerer, const JsonValue& request, const LimitParams& limits,
                  double left_cpu_s) {
  JsonValue numbered = request;
  const JsonValue id(answerer.asked() + 1);
  numbered.Set("id", id);
  const std::string text = answerer.Ask(core::CompactJson(numbered), limits, left_cpu_s);
  JsonValue answer;
  try {
    answer = core::ParseJson(text, "its answer", {.max_bytes = kLongestMessage});
  } catch (const core::UserError& error) {
    throw NavigatorFault(FaultKind::kMessage, error.what());
  }
  if (!answer.Is(JsonValue::Type::kObject)) {
    throw NavigatorFault(FaultKind::kMessage, "its answer is no object");
  }
  // One that answers twice would be one answer behind from then on.
  if (const JsonValue* of = answer.Find("id");
      of != nullptr && core::CompactJson(*of) != core::CompactJson(id)) {
    throw NavigatorFault(FaultKind::kMessage,
                         fmt::format("its answer is to request {}, and {} was asked",
                                     core::Abbreviate(*of), core::CompactJson(id)));
  }
  if (const JsonValue* error = answer.Find("error")) {
    throw NavigatorFault(FaultKind::kThrew, error->Is(JsonValue::Type::kText)
                                                ? error->text()
                                                : std::string("without a text"));
  }
  return answer;
}

// The answerers that wait for a drive.
class Pool {
 public:
  explicit Pool(MakeAnswerer make) : make_(std::move(make)) {}

  std::unique_ptr<Answerer> Take() {
    {
      const std::lock_guard lock(mutex_);
      while (!idle_.empty()) {
        std::unique_ptr<Answerer> answerer = std::move(idle_.back());
        idle_.pop_back();
        if (answerer->usable()) return answerer;
      }
    }
    return make_();
  }
  void Return(std::unique_ptr<Answerer> answerer) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(answerer));
  }

 private:
  const MakeAnswerer make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Answerer>> idle_;
};

// The navigator of one drive.
class AnsweringNavigator final : public navigation::Navigator {
 public:
  AnsweringNavigator(Pool& pool, const navigation::NavigatorSetup& setup, std::size_t own_values)
      : pool_(pool),
        limits_(setup.limits),
        on_end_(setup.on_end),
        answerer_(pool.Take()),
        own_values_(own_values, 0.0) {}
  ~AnsweringNavigator() override {
    if (on_end_) on_end_(use_);
    // What failed once is not trusted with another drive.
    if (answerer_ != nullptr && !failed_) pool_.Return(std::move(answerer_));
  }
  AnsweringNavigator(const AnsweringNavigator&) = delete;
  AnsweringNavigator& operator=(const AnsweringNavigator&) = delete;

  void Begin(const Parameters& parameters, const navigation::NavigatorSetup& setup) {
    JsonValue request = Request("start");
    request.Set("parameters", parameters.ToJson());
    request.Set("setup", SetupToJson(setup));
    Ask(request);
  }

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    ++use_.questions;
    JsonValue request = Request("decide");
    request.Update(InputToJson(input));
    const JsonValue answer = Ask(request);
    navigation::NavigatorDecision decision = Read(answer);
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    OnJump(false, before, after);
  }
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    OnJump(true, before, after);
  }
  void SetGoal(const messages::Goal& goal, navigation::GoalChange change) override {
    JsonValue request = Request("goal");
    request.Set("goal", PlaceToJson(goal));
    request.Set("moved", JsonValue(change == navigation::GoalChange::kMoved));
    Ask(request);
  }
  const messages::Overlay* overlay() const override {
    // A drive is the same whether or not somebody watches it.
    overlay_ = OverlayFromJson(Ask(Request("overlay"), false));
    CheckOverlay(overlay_);
    return overlay_.lines.empty() && overlay_.grids.empty() ? nullptr : &overlay_;
  }
  std::span<const double> own_values() const override { return own_values_; }

 private:
  static JsonValue Request(std::string_view type) {
    return JsonValue::Object({{"type", JsonValue(type)}});
  }

  void OnJump(bool corrected, const messages::PoseEstimate& before,
              const messages::PoseEstimate& after) {
    JsonValue request = Request("jump");
    request.Set("corrected", JsonValue(corrected));
    request.Set("before", PoseToJson(before));
    request.Set("after", PoseToJson(after));
    Ask(request);
  }

  navigation::NavigatorDecision Read(const JsonValue& answer) {
    failed_ = true;  // unless all that follows goes well
    navigation::NavigatorDecision decision = DecisionFromJson(answer);
    CheckDecision(decision);
    if (const JsonValue* own = answer.Find("own_values")) OwnValuesFromJson(*own, own_values_);
    failed_ = false;
    return decision;
  }

  // `counts`: as CPU time of the drive.
  JsonValue Ask(const JsonValue& request, bool counts = true) const {
    failed_ = true;
    const double left_s = limits_.drive_cpu_s - (counts ? use_.cpu_s : 0.0);
    const auto began = std::chrono::steady_clock::now();
    JsonValue answer = AskJson(*answerer_, request, limits_, left_s);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    if (counts) {
      use_.cpu_s += answerer_->used_s();
      use_.wall_s += took.count();
      use_.longest_s = std::max(use_.longest_s, took.count());
    }
    failed_ = false;
    return answer;
  }

  Pool& pool_;
  const LimitParams limits_;
  const std::function<void(const messages::NavigatorUse&)> on_end_;
  std::unique_ptr<Answerer> answerer_;
  std::vector<double> own_values_;
  mutable messages::NavigatorUse use_;
  mutable bool failed_ = false;
  mutable messages::Overlay overlay_;
};

class AnsweringSource final : public NavigatorSource {
 public:
  AnsweringSource(std::string name, std::unique_ptr<const Description> description,
                  std::unique_ptr<Pool> pool)
      : NavigatorSource(std::move(name), std::move(description)), pool_(std::move(pool)) {}

  std::unique_ptr<navigation::Navigator> Make(
      const Parameters& parameters, const navigation::NavigatorSetup& setup) const override {
    auto navigator =
        std::make_unique<AnsweringNavigator>(*pool_, setup, description().own_values.size());
    navigator->Begin(parameters, setup);
    return navigator;
  }

 protected:
  JsonValue AskTraits(const Parameters& parameters) const override {
    JsonValue request = JsonValue::Object({{"type", JsonValue("traits")}});
    request.Set("parameters", parameters.ToJson());
    return AskOutside(*pool_, name(), request);
  }

 public:
  // Asks outside of a drive. Throws core::UserError.
  static JsonValue AskOutside(Pool& pool, const std::string& name, const JsonValue& request) {
    try {
      std::unique_ptr<Answerer> answerer = pool.Take();
      const LimitParams limits;
      JsonValue answer = AskJson(*answerer, request, limits, limits.drive_cpu_s);
      pool.Return(std::move(answerer));
      return answer;
    } catch (const NavigatorFault& fault) {
      throw core::UserError(name,
                            fmt::format("failed when it was asked what it is: {}", fault.what()),
                            "run it by itself, and see docs/navigators.md for what a "
                            "navigator answers");
    }
  }

 private:
  std::unique_ptr<Pool> pool_;
};

}  // namespace

std::shared_ptr<const NavigatorSource> OpenAnswerer(const std::string& name, MakeAnswerer make) {
  auto pool = std::make_unique<Pool>(std::move(make));
  const JsonValue answer = AnsweringSource::AskOutside(
      *pool, name,
      JsonValue::Object({{"type", JsonValue("describe")}, {"protocol", JsonValue(kProtocol)}}));
  const JsonValue* protocol = answer.Find("protocol");
  if (protocol == nullptr || !protocol->IsNumber() ||
      protocol->number() != static_cast<double>(kProtocol)) {
    throw core::UserError(
        name,
        fmt::format("speaks version {} of the protocol, and this program {}",
                    protocol == nullptr ? "(none)" : core::Abbreviate(*protocol), kProtocol),
        "answer \"describe\" with the version of this program");
  }
  return std::make_shared<AnsweringSource>(name, ReadDescription(answer, name), std::move(pool));
}

}  // namespace rockyard::plugin
