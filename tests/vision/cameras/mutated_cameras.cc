#include "vision/cameras/mutated_cameras.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>

#include "core/error.h"
#include "core/json_text.h"
#include "core/random.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

std::size_t Below(core::RandomStream& stream, std::size_t bound) {
  return static_cast<std::size_t>(stream.NextU64() % bound);
}

template <std::size_t count>
std::string OneOf(const std::array<std::string_view, count>& texts, core::RandomStream& stream) {
  return std::string(texts[Below(stream, count)]);
}

std::string OddValue(core::RandomStream& stream) {
  constexpr std::array<std::string_view, 20> kValues{"0",
                                                     "-0",
                                                     "1",
                                                     "-1",
                                                     "1e308",
                                                     "-1e308",
                                                     "1e-308",
                                                     "4e-324",
                                                     "1e999",
                                                     "nan",
                                                     "inf",
                                                     "0x10",
                                                     "1e7",
                                                     "10000001",
                                                     "65536",
                                                     "65537",
                                                     "-1e7",
                                                     "0.5",
                                                     "9223372036854775808",
                                                     "1.0000000001"};
  return OneOf(kValues, stream);
}

std::string OddPiece(core::RandomStream& stream) {
  using namespace std::string_view_literals;
  constexpr std::array<std::string_view, 26> kPieces{"="sv,
                                                     "\n"sv,
                                                     "\r\n"sv,
                                                     "-"sv,
                                                     "\""sv,
                                                     "["sv,
                                                     "]"sv,
                                                     "{"sv,
                                                     "}"sv,
                                                     ","sv,
                                                     ":"sv,
                                                     "#"sv,
                                                     "\0"sv,
                                                     "\xff\xfe"sv,
                                                     "Camera = left\n"sv,
                                                     "S =\n"sv,
                                                     "null"sv,
                                                     "true"sv,
                                                     "Model = CAHVORE"sv,
                                                     "Model = CAHV = perspective, linear\n"sv,
                                                     "P = 0.3\n"sv,
                                                     "T = 3\n"sv,
                                                     "Mtype = 2\n"sv,
                                                     "\"E\": []"sv,
                                                     "\\u0000"sv,
                                                     "general"sv};
  return OneOf(kPieces, stream);
}

bool IsOfNumber(char character) {
  return (character >= '0' && character <= '9') || character == '.' || character == '-' ||
         character == 'e';
}

// The number at or behind a place, replaced.
void ReplaceNumber(core::RandomStream& stream, std::string& text, std::size_t at) {
  const auto from = std::find_if(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(),
                                 [](char c) { return c >= '0' && c <= '9'; });
  const auto to = std::find_if_not(from, text.end(), IsOfNumber);
  text.replace(from, to, OddValue(stream));
}

// The line around a place, with its end.
std::pair<std::size_t, std::size_t> LineAt(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = text.find('\n', at);
  return {first, (end == std::string::npos ? text.size() : end + 1) - first};
}

void Edit(const std::vector<CameraSeed>& seeds, core::RandomStream& stream, std::string& text) {
  if (text.empty()) return;
  const std::size_t at = Below(stream, text.size());
  const std::size_t length = 1 + Below(stream, 40);
  const std::string& other = seeds[Below(stream, seeds.size())].text;
  const auto [line, line_length] = LineAt(text, at);
  switch (Below(stream, 12)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ 1 << Below(stream, 8));
      break;
    case 1:
      text[at] = static_cast<char>(stream.NextU32() & 0xffU);
      break;
    case 2:
    case 3:
    case 4:
      ReplaceNumber(stream, text, at);
      break;
    case 5:
      text.erase(at, length);
      break;
    case 6:
      text.erase(line, line_length);
      break;
    case 7:
      text.insert(line, text.substr(line, line_length));
      break;
    case 8:
      text.insert(at, OddPiece(stream));
      break;
    case 9:
      text.replace(at, length, other.substr(Below(stream, other.size()), length));
      break;
    case 10: {
      const std::size_t times = Below(stream, 8) == 0 ? 5000 : 10;
      std::string many;
      const std::string piece = OddPiece(stream);
      for (std::size_t i = 0; i < times; ++i) many += piece;
      text.insert(at, many);
      break;
    }
    default:
      if (Below(stream, 3) == 0) text.resize(at);
  }
}

std::string FaultOf(const CameraModel& camera) {
  const ImageSize& size = camera.size;
  if (size.columns < 1 || size.rows < 1) return "an image without pixels";
  if (size.columns > kLongestSide_px || size.rows > kLongestSide_px) return "a side too long";
  for (const Pixel& pixel : {MiddleOf(size), Pixel(0.0, 0.0), Pixel(size.columns - 1.0, 0.0)}) {
    RayJacobian ray_by_pixel;
    const auto ray = BackProject(camera, pixel, &ray_by_pixel);
    if (!ray) continue;
    if (!ray->direction.allFinite() || !ray->origin.allFinite()) return "a ray that is not finite";
    const auto back = Project(camera, ray->origin + 3.0 * ray->direction);
    if (back && !back->allFinite()) return "a pixel that is not finite";
  }
  if (!std::holds_alternative<BrownPinhole>(camera.lens) &&
      ParseCamera(CameraText(camera), "again").size != size) {
    return "its text is another camera";
  }
  return ParseCamera(core::DumpJson(CameraJson(camera)), "again").size == size
             ? ""
             : "its JSON is another camera";
}

std::string CameraFault(const CameraSeed& file) {
  if (!file.is_pair) return FaultOf(ParseCamera(file.text, file.name));
  const CameraPair pair = ParseCameraPair(file.text, file.name);
  const std::string fault = FaultOf(pair.left);
  return fault.empty() ? FaultOf(pair.right) : fault;
}

}  // namespace

std::vector<CameraSeed> CameraSeeds() {
  std::vector<CameraSeed> seeds;
  for (const NamedCamera& named : ModelCameras()) {
    seeds.push_back({named.name + " as JSON", core::DumpJson(CameraJson(named.camera))});
    if (std::holds_alternative<BrownPinhole>(named.camera.lens)) continue;
    seeds.push_back({named.name + " as text", CameraText(named.camera, "of a test")});
  }
  const CameraPair pair{FlightCamera("M2020_HAZFLA"), FlightCamera("VW_MER_CAHVOR")};
  seeds.push_back({"pair as JSON", core::DumpJson(CameraPairJson(pair)), true});
  seeds.push_back({"pair as text", CameraPairText(pair), true});
  seeds.push_back({"text with covariance",
                   CameraText(pair.right) + "S =\n 1 2 3\n 4 5 6\nHs = 300\nTheta = 1.57\n"});
  return seeds;
}

CameraSeed MutatedCamera(const std::vector<CameraSeed>& seeds, std::uint64_t seed,
                         std::uint32_t number) {
  core::RandomStream stream({seed, number}, core::Purpose::kTest);
  CameraSeed file = seeds[Below(stream, seeds.size())];
  const std::size_t edits = 1 + Below(stream, 1 + Below(stream, 6));
  for (std::size_t i = 0; i < edits; ++i) Edit(seeds, stream, file.text);
  return file;
}

CameraVerdict JudgeCamera(const CameraSeed& file) {
  try {
    const std::string fault = CameraFault(file);
    return {fault.empty() ? CameraOutcome::kRead : CameraOutcome::kFailed, fault};
  } catch (const core::UserError& error) {
    for (const core::Problem& problem : error.problems()) {
      if (problem.path.empty() || problem.reason.empty() || problem.suggestion.empty() ||
          problem.path.starts_with("again")) {
        return {CameraOutcome::kFailed, std::string("a wrong refusal: ") + error.what()};
      }
    }
    return {CameraOutcome::kRefused, error.problems().front().reason};
  } catch (const std::exception& error) {
    return {CameraOutcome::kFailed, std::string("another exception: ") + error.what()};
  }
}

}  // namespace rockyard::vision
