// Looks three times, reads the images alone, and tells what it got as own values: sums over bytes
// and cameras in which every place has another weight. photographer.py is the same as a process.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plugin/navigator_plugin.h"

namespace {

using namespace rockyard;

struct PhotographerParams {
  double goal_tolerance_m = 0.3;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m, core::Setting("never arrives", {0.0, 5.0}));
  }
};

// Exact in the 53 bits of a double.
double ByteSum(const messages::LookImage& image) {
  std::int64_t sum = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      sum += image.At(column, row) * (1 + column + 1000 * row);
    }
  }
  return static_cast<double>(sum);
}

double CameraSum(const messages::LinearCamera& camera) {
  double sum = 0.0;
  double weight = 1.0;
  for (const auto member : {&messages::LinearCamera::C_R, &messages::LinearCamera::A_R,
                            &messages::LinearCamera::H_R, &messages::LinearCamera::V_R}) {
    for (const double number : camera.*member) sum += weight++ * number;
  }
  return sum;
}

class Photographer final : public navigation::Navigator {
 public:
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    if (input.images != nullptr) {
      const messages::LookImages& images = *input.images;
      own_[0] += 1.0;
      own_[1] += ByteSum(images.left);
      own_[2] += ByteSum(images.right);
      own_[3] += CameraSum(images.left.camera);
      own_[4] += CameraSum(images.right.camera);
      own_[5] += static_cast<double>(images.number);
      own_[6] += images.direction == messages::LookDirection::kBehind ? 1.0 : 0.0;
      own_[7] += input.cloud != nullptr || input.report != nullptr ? 1.0 : 0.0;
    }
    if (own_[0] == 3.0) return navigation::Finish(navigation::NavigatorStatus::kGaveUp);
    return navigation::LookAt(own_[0] == 1.0 ? messages::LookDirection::kBehind
                                             : messages::LookDirection::kAhead);
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
  std::span<const double> own_values() const override { return own_; }

 private:
  std::vector<double> own_ = std::vector<double>(8, 0.0);
};

navigation::NavigatorDescription<PhotographerParams> DescribePhotographer() {
  return {.name = "photographer",
          .doc = "tells what images it gets",
          .traits = [](const PhotographerParams& params) -> navigation::NavigatorTraits {
            navigation::NavigatorTraits traits(navigation::LookReading::kNothing,
                                               navigation::CostOfLook{},
                                               {"goal_tolerance_m", params.goal_tolerance_m});
            traits.images = true;
            return traits;
          },
          .make = [](const PhotographerParams&,
                     const navigation::NavigatorSetup&) -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Photographer>();
          },
          .own_values = {{"images", "1", "looks that came with images"},
                         {"left", "1", "sum over bytes"},
                         {"right", "1", "sum over bytes"},
                         {"left_camera", "1", "sum over its vectors"},
                         {"right_camera", "1", "sum over its vectors"},
                         {"numbers", "1", "sum of numbers of looks"},
                         {"behind", "1", "looks behind"},
                         {"others", "1", "looks with a report or points"}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribePhotographer)
