#include "navigation/action_log.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "navigation/navigator_fault.h"

namespace rockyard::navigation {
namespace {

// One byte before each part of a log.
enum class Part : std::uint8_t {
  kSame = 0,    // the answer before once more
  kAnswer = 1,  // which numbers differ from the answer before, small values, those numbers
  kEnd = 2,     // counts, own values, whether there is a view; nothing follows
};

// The numbers of an answer, in the order of the bits that say which of them are told.
using Numbers = std::array<std::uint64_t, 10>;
// Status, look, whether it looks on the move, kind of motion, direction.
using Small = std::array<std::uint8_t, 5>;

struct Answer {
  Numbers numbers{};
  Small small{};

  bool operator==(const Answer&) const = default;
};

Answer AnswerOf(const NavigatorDecision& decision) {
  const messages::MotionCommand& motion = decision.motion;
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  return {.numbers = {bits(motion.curvature_per_m), bits(motion.curvature_rate_per_m2),
                      bits(motion.speed_share), bits(motion.end_m),
                      static_cast<std::uint64_t>(motion.move), bits(decision.until.period_s),
                      bits(decision.until.distance_m), bits(decision.until.turn_rad),
                      bits(decision.until.near_goal_m), bits(decision.work_ops)},
          .small = {
              byte(decision.status), byte(decision.look ? 1 + static_cast<int>(*decision.look) : 0),
              byte(decision.looks_on_the_move), byte(motion.kind), byte(1 + motion.direction)}};
}

NavigatorDecision DecisionOf(const Answer& answer) {
  const auto number = [&](std::size_t i) { return std::bit_cast<double>(answer.numbers.at(i)); };
  NavigatorDecision decision;
  decision.status = static_cast<NavigatorStatus>(answer.small[0]);
  if (answer.small[1] != 0) decision.look = messages::LookDirection{answer.small[1] - 1};
  decision.looks_on_the_move = answer.small[2] != 0;
  decision.motion = {.kind = static_cast<messages::MotionKind>(answer.small[3]),
                     .curvature_per_m = number(0),
                     .direction = answer.small[4] - 1,
                     .curvature_rate_per_m2 = number(1),
                     .speed_share = number(2),
                     .end_m = number(3),
                     .move = static_cast<std::int64_t>(answer.numbers[4])};
  decision.until = {number(5), number(6), number(7), number(8)};
  decision.work_ops = number(9);
  return decision;
}

class Writer {
 public:
  void Add(const Answer& answer) {
    if (any_ && answer == last_) return Byte(Part::kSame);
    Byte(Part::kAnswer);
    std::uint64_t told = 0;
    for (std::size_t i = 0; i < answer.numbers.size(); ++i) {
      if (answer.numbers.at(i) != last_.numbers.at(i)) told |= std::uint64_t{1} << i;
    }
    Byte(told & 0xff);
    Byte(told >> 8);
    for (const std::uint8_t value : answer.small) Byte(value);
    for (std::size_t i = 0; i < answer.numbers.size(); ++i) {
      if ((told >> i & 1) != 0) Word(answer.numbers.at(i));
    }
    last_ = answer;
    any_ = true;
  }

  void End(const PlanCounts& counts, std::span<const double> own_values, bool view) {
    Byte(Part::kEnd);
    for (const std::int64_t count : {counts.plans, counts.unsafe, counts.late, counts.started}) {
      Word(static_cast<std::uint64_t>(count));
    }
    Word(std::bit_cast<std::uint64_t>(counts.start_error_squared_m2));
    Byte(view);
    Word(own_values.size());
    for (const double value : own_values) Word(std::bit_cast<std::uint64_t>(value));
  }

  std::string Take() { return std::move(bytes_); }

 private:
  template <typename Value>
  void Byte(Value value) {
    bytes_ += static_cast<char>(static_cast<std::uint8_t>(value));
  }
  void Word(std::uint64_t value) {
    for (int i = 0; i < 8; ++i) Byte(value >> 8 * i & 0xff);
  }

  std::string bytes_{kActionLogHead};
  Answer last_;
  bool any_ = false;
};

NavigatorFault Bad(const char* what) { return {FaultKind::kNonsense, what}; }

class Reader {
 public:
  explicit Reader(std::string log) : log_(std::move(log)), at_(kActionLogHead.size()) {
    if (!log_.starts_with(kActionLogHead)) throw Bad("the log of actions is none");
  }

  Answer Next() {
    const auto part = static_cast<Part>(Byte());
    if (part == Part::kEnd) throw Bad("the log of actions has no further answer");
    if (part != Part::kSame) {
      const auto low = Byte();
      const auto told = static_cast<unsigned>(low) | static_cast<unsigned>(Byte()) << 8;
      for (std::uint8_t& value : last_.small) value = Byte();
      for (std::size_t i = 0; i < last_.numbers.size(); ++i) {
        if ((told >> i & 1) != 0) last_.numbers.at(i) = Word();
      }
    }
    return last_;
  }

  // What follows the last answer. Call it when all have been taken.
  struct End {
    PlanCounts counts;
    std::vector<double> own_values;
    bool view = false;
  };
  End ReadEnd() {
    if (static_cast<Part>(Byte()) != Part::kEnd) throw Bad("the log of actions goes on");
    End end;
    for (std::int64_t* count :
         {&end.counts.plans, &end.counts.unsafe, &end.counts.late, &end.counts.started}) {
      *count = static_cast<std::int64_t>(Word());
    }
    end.counts.start_error_squared_m2 = std::bit_cast<double>(Word());
    end.view = Byte() != 0;
    const std::uint64_t values = Word();
    if (values > (log_.size() - at_) / 8) throw Bad("the log of actions is cut off");
    for (std::uint64_t i = 0; i < values; ++i) {
      end.own_values.push_back(std::bit_cast<double>(Word()));
    }
    if (at_ != log_.size()) throw Bad("the log of actions is too long");
    return end;
  }

  // Also where the log is cut off here, which ReadEnd finds.
  bool at_end() const { return at_ == log_.size() || log_[at_] == static_cast<char>(Part::kEnd); }

 private:
  std::uint8_t Byte() {
    if (at_ == log_.size()) throw Bad("the log of actions is cut off");
    return static_cast<std::uint8_t>(log_[at_++]);
  }
  std::uint64_t Word() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value |= static_cast<std::uint64_t>(Byte()) << 8 * i;
    return value;
  }

  std::string log_;
  std::size_t at_;
  Answer last_;
};

class Recorder final : public Navigator {
 public:
  Recorder(std::unique_ptr<Navigator> navigator, std::uint64_t random_seed, ActionSink sink)
      : navigator_(std::move(navigator)), random_seed_(random_seed), sink_(std::move(sink)) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder() override {
    // A navigator that fails even here has no values; its drive ended by that.
    try {
      writer_.End(navigator_->plan_counts(), navigator_->own_values(),
                  navigator_->view() != nullptr);
    } catch (const std::exception&) {
      writer_.End({}, {}, false);
    }
    sink_(random_seed_, writer_.Take());
  }

  NavigatorDecision Decide(const NavigatorInput& input) override {
    NavigatorDecision decision = navigator_->Decide(input);
    writer_.Add(AnswerOf(decision));
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    navigator_->OnPoseUpdate(before, after);
  }
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    navigator_->OnCorrection(before, after);
  }
  void SetGoal(const messages::Goal& goal, GoalChange change) override {
    navigator_->SetGoal(goal, change);
  }
  const messages::NavigationView* view() const override { return navigator_->view(); }
  PlanCounts plan_counts() const override { return navigator_->plan_counts(); }
  const messages::Overlay* overlay() const override { return navigator_->overlay(); }
  std::span<const double> own_values() const override { return navigator_->own_values(); }

 private:
  std::unique_ptr<Navigator> navigator_;
  std::uint64_t random_seed_;
  ActionSink sink_;
  Writer writer_;
};

class Player final : public Navigator {
 public:
  explicit Player(std::string log) : reader_(std::move(log)) {}

  NavigatorDecision Decide(const NavigatorInput& /*input*/) override {
    const NavigatorDecision decision = DecisionOf(reader_.Next());
    if (reader_.at_end()) end_ = reader_.ReadEnd();
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, GoalChange) override {}
  const messages::NavigationView* view() const override { return end_.view ? &view_ : nullptr; }
  PlanCounts plan_counts() const override { return end_.counts; }
  std::span<const double> own_values() const override { return end_.own_values; }

 private:
  Reader reader_;
  Reader::End end_;
  messages::NavigationView view_;
};

// A kind whose navigators are made by another function.
class WrappedKind final : public NavigatorKind {
 public:
  using Maker =
      std::function<std::unique_ptr<Navigator>(const NavigatorKind&, const NavigatorSetup&)>;

  WrappedKind(std::unique_ptr<NavigatorKind> inner, Maker maker)
      : NavigatorKind(inner->name(), inner->doc()),
        inner_(std::move(inner)),
        maker_(std::move(maker)) {}

  bool has_params() const override { return inner_->has_params(); }
  void Visit(core::FieldVisitor& v) override { inner_->Visit(v); }
  NavigatorTraits traits() const override { return inner_->traits(); }
  std::span<const messages::OwnValue> own_values() const override { return inner_->own_values(); }
  bool foreign() const override { return inner_->foreign(); }
  std::unique_ptr<Navigator> Make(const NavigatorSetup& setup) const override {
    return maker_(*inner_, setup);
  }
  std::unique_ptr<NavigatorKind> Clone() const override {
    return std::make_unique<WrappedKind>(inner_->Clone(), maker_);
  }

 private:
  std::unique_ptr<NavigatorKind> inner_;
  Maker maker_;
};

}  // namespace

std::unique_ptr<NavigatorKind> Recorded(std::unique_ptr<NavigatorKind> kind, ActionSink sink) {
  return std::make_unique<WrappedKind>(
      std::move(kind), [sink = std::move(sink)](const NavigatorKind& of, const NavigatorSetup& s) {
        return std::make_unique<Recorder>(of.Make(s), s.random_seed, sink);
      });
}

std::unique_ptr<NavigatorKind> Played(std::unique_ptr<NavigatorKind> kind, ActionSource source) {
  return std::make_unique<WrappedKind>(
      std::move(kind), [source = std::move(source)](const NavigatorKind&, const NavigatorSetup& s) {
        return std::make_unique<Player>(source(s.random_seed));
      });
}

}  // namespace rockyard::navigation
