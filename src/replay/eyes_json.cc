// What the stereo cameras of a rover saw in a replay, as JSON.
#include <array>
#include <cstddef>
#include <string>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using core::JsonObject;

std::size_t PictureBytes(std::span<const ReplayLook> looks) {
  std::size_t bytes = 0;
  for (const ReplayLook& look : looks) bytes += look.left_png.size() + look.disparity_png.size();
  return bytes;
}

std::string LookText(const ReplayLook& look) {
  return JsonObject()
      .Add("t", Length(look.time_s))
      .AddInteger("number", look.number)
      .AddFlag("behind", look.behind)
      .AddInteger("points", look.points)
      .AddNumber("least", look.least_disparity_px)
      .AddNumber("most", look.most_disparity_px)
      .AddText("left", look.left_png)
      .AddText("disparity", look.disparity_png)
      .Text();
}

}  // namespace

std::string EyesJson(std::span<const ReplayLook> looks) {
  if (looks.empty()) return "null";
  const std::size_t every = (PictureBytes(looks) + kMaxLookBytes - 1) / kMaxLookBytes;
  std::vector<std::string> shown;
  std::array<std::size_t, 2> number{};  // of the next look ahead and behind
  for (const ReplayLook& look : looks) {
    if (number.at(look.behind ? 1 : 0)++ % every == 0) shown.push_back(LookText(look));
  }
  return JsonObject()
      .AddInteger("every", static_cast<std::int64_t>(every))
      .Add("looks", core::JsonList(shown))
      .Text();
}

}  // namespace rockyard::replay
