#include <array>

#include "perception/point_reader.h"
#include "perception/point_reader_set_params.h"

namespace rockyard::perception {
namespace {

using core::Published;

// The other groups of perception. stereo is not listed, as it belongs to the reader of that name.
constexpr std::array<std::string_view, 9> kOtherGroups{
    "stripe_finder", "hazard",   "vehicle_hazard",   "stuck_detector", "dead_reckoning",
    "calibration",   "attitude", "cloud_elevations", "visual_odometry"};

// On-board stereo of rockyard, which has its parameters in a group that stands by itself.
class OwnStereo final : public PointReaderKind {
 public:
  OwnStereo() : PointReaderKind("stereo", "matching of stereo images") {}

  bool has_params() const override { return false; }
  void Visit(core::FieldVisitor& /*v*/) override {}
  bool is_own() const override { return true; }
  std::unique_ptr<PointReader> Make(const PointReaderSetup& /*setup*/) const override {
    return nullptr;
  }
  std::unique_ptr<PointReaderKind> Clone() const override { return std::make_unique<OwnStereo>(); }
};

}  // namespace

PointReaderSet::PointReaderSet()
    : KindSet({.group = "perception",
               .key = "reader",
               .one = "a reader of images",
               .others = kOtherGroups,
               .choice = Published("what makes range points of stereo images; the groups of other "
                                   "readers do nothing",
                                   "Goldberg 2002 sec. 2: stereo matching")}) {
  AddKind(std::make_unique<OwnStereo>());
}

}  // namespace rockyard::perception
