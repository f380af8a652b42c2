#include "vision/cameras/camera_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/archive.h"
#include "core/check.h"
#include "core/error.h"
#include "core/text.h"
#include "vision/cameras/camera_fields.h"

namespace rockyard::vision {

namespace {

using core::JsonValue;
using core::Problem;

// Returns a problem of a field as one of the line in which the field stands.
Problem OfLine(const Problem& problem, const CameraBlock& block, std::string_view source_name) {
  const std::string_view field = std::string_view(problem.path).substr(0, problem.path.find('['));
  const auto line = block.lines.find(field);
  const std::string place = line == block.lines.end() ? fmt::format("line {} ff.", block.line)
                                                      : fmt::format("line {}", line->second);
  return {std::string(source_name), fmt::format("{}: {} {}", place, problem.path, problem.reason),
          problem.suggestion};
}

CameraModel ModelIn(const CameraBlock& block, std::string_view source_name) {
  // Types 1 and 2 have a fixed linearity; files repeat it or say 0.
  JsonValue json = block.fields;
  const JsonValue* type = json.Find("type");
  if (type != nullptr && type->text() != "general") json.Erase("linearity");
  CameraFields fields;
  try {
    core::ReadParams(json, fields);
  } catch (const core::UserError& error) {
    std::vector<Problem> problems;
    for (const Problem& problem : error.problems()) {
      problems.push_back(OfLine(problem, block, source_name));
    }
    throw core::UserError(std::move(problems));
  }
  return ModelOf(fields);
}

CameraBlocks BlocksIn(std::string_view text, std::string_view source_name) {
  if (text.size() > kLargestCameraFile) {
    throw core::UserError(
        std::string(source_name),
        fmt::format("has {} bytes, more than the {} allowed", text.size(), kLargestCameraFile),
        "check that this is the right file");
  }
  CameraBlocks blocks = SortLines(text, source_name);
  if (!blocks.problems.empty()) throw core::UserError(std::move(blocks.problems));
  return blocks;
}

std::string Commented(std::string_view comment) {
  std::string lines;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    lines += fmt::format("# {}\n", comment.substr(0, end));
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return lines;
}

std::string ModelLine(const CameraModel& camera) {
  if (std::holds_alternative<Cahv>(camera.lens)) return "Model = CAHV = perspective, linear\n";
  const auto* cahvore = std::get_if<Cahvore>(&camera.lens);
  if (cahvore == nullptr) return "Model = CAHVOR = perspective, distortion\n";
  switch (cahvore->type) {
    case CahvoreType::kPerspective:
      return "Model = CAHVORE1 = perspective, distortion, pupil\n";
    case CahvoreType::kFisheye:
      return "Model = CAHVORE2 = fish-eye\n";
    case CahvoreType::kGeneral:
      break;
  }
  return fmt::format("Model = CAHVORE3,{} = general\n", cahvore->general_linearity);
}

std::string VectorLine(std::string_view key, const math::Vector3& v) {
  return fmt::format("{} = {} {} {}\n", key, v.x(), v.y(), v.z());
}

std::string LinearLines(const Cahv& lens) {
  return VectorLine("C", lens.C) + VectorLine("A", lens.A) + VectorLine("H", lens.H) +
         VectorLine("V", lens.V);
}

std::string LensLines(const Cahv& lens) { return LinearLines(lens); }
std::string LensLines(const Cahvor& lens) {
  return LinearLines(lens.linear) + VectorLine("O", lens.O) + VectorLine("R", lens.R);
}
std::string LensLines(const Cahvore& lens) {
  return LinearLines(lens.linear) + VectorLine("O", lens.O) + VectorLine("R", lens.R) +
         VectorLine("E", lens.E);
}
// The text form has no keys for other lenses; CameraText refuses them.
template <typename Lens>
std::string LensLines(const Lens&) {
  return {};
}

}  // namespace

CameraModel ParseCameraText(std::string_view text, std::string_view source_name) {
  const CameraBlocks sorted = BlocksIn(text, source_name);
  const CameraBlock& block = sorted.blocks.front();
  if (!block.camera.empty()) {
    throw core::UserError(
        std::string(source_name),
        fmt::format("line {} begins a pair, where one camera is wanted", block.line),
        "give the file of one camera");
  }
  return ModelIn(block, source_name);
}

CameraPair ParseCameraPairText(std::string_view text, std::string_view source_name) {
  const CameraBlocks sorted = BlocksIn(text, source_name);
  const auto& blocks = sorted.blocks;
  const bool is_pair =
      blocks.size() == 2 && ((blocks[0].camera == "left" && blocks[1].camera == "right") ||
                             (blocks[0].camera == "right" && blocks[1].camera == "left"));
  if (!is_pair) {
    throw core::UserError(std::string(source_name), "is no pair of a left and a right camera",
                          "begin each camera with a line Camera = left or Camera = right, once");
  }
  const std::size_t left = blocks[0].camera == "left" ? 0 : 1;
  return {ModelIn(blocks[left], source_name), ModelIn(blocks[1 - left], source_name)};
}

std::string CameraText(const CameraModel& camera, std::string_view comment) {
  EXPECT(!std::holds_alternative<BrownPinhole>(camera.lens));
  return Commented(comment) + ModelLine(camera) +
         fmt::format("Dimensions = {} {}\n", camera.size.columns, camera.size.rows) +
         std::visit([](const auto& lens) { return LensLines(lens); }, camera.lens);
}

std::string CameraPairText(const CameraPair& pair, std::string_view comment) {
  return Commented(comment) + "Camera = left\n" + CameraText(pair.left) + "Camera = right\n" +
         CameraText(pair.right);
}

namespace {

using core::JsonValue;

constexpr std::size_t kMostTextProblems = 20;
constexpr std::size_t kMostBlocks = 3;  // one more than a pair has, to tell that there are too many
constexpr std::size_t kMostShown = 40;
constexpr std::string_view kBlanks = " \t\r\f\v";

constexpr std::array<std::string_view, 7> kVectorKeys = {"C", "A", "H", "V", "O", "R", "E"};
constexpr std::array<std::string_view, 7> kPassedOver = {"S",  "S internal", "Hs",   "Hc",
                                                         "Vs", "Vc",         "Theta"};
constexpr std::array<std::string_view, 16> kKnownKeys = {
    "Model", "Mclass", "Mtype", "T", "Mparm", "P", "Dimensions", "Camera",
    "C",     "A",      "H",     "V", "O",     "R", "E",          "S"};

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Returns a text for messages: printable and short.
std::string Shown(std::string_view text) {
  std::string shown(text.substr(0, kMostShown));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

// Returns the first `most` words, and one more where the text has more.
std::vector<std::string_view> Words(std::string_view text, std::size_t most) {
  std::vector<std::string_view> words;
  while (words.size() <= most) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(kBlanks, first), text.size());
    words.push_back(text.substr(first, end - first));
    text.remove_prefix(end);
  }
  return words;
}

// Returns a whole word as a finite number.
template <typename Number>
std::optional<Number> NumberIn(std::string_view word) {
  if constexpr (std::is_floating_point_v<Number>) {
    return core::FiniteNumber(word);
  } else {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const char* const end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || stopped != end) return std::nullopt;
    return value;
  }
}

bool Contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class LineSorter {
 public:
  explicit LineSorter(std::string_view source_name) : source_name_(source_name) {
    sorted_.blocks.emplace_back();
  }

  void Take(std::string_view line) {
    ++line_;
    line = Trim(line.substr(0, line.find('#')));
    if (line.empty()) return;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      TakeRow(line);
      return;
    }
    const std::string_view key = Trim(line.substr(0, equals));
    in_matrix_ = key == "S" || key == "S internal";
    if (!Contains(kPassedOver, key)) TakeField(key, Trim(line.substr(equals + 1)));
  }

  CameraBlocks Finish() && { return std::move(sorted_); }

 private:
  // Takes a line without a key: a row of a covariance, or a problem.
  void TakeRow(std::string_view line) {
    if (in_matrix_ && NumberIn<double>(Words(line, 1).front())) return;
    Add(fmt::format("is \"{}\", without a \"=\"", Shown(line)), "write a line KEY = VALUES");
  }

  void TakeField(std::string_view key, std::string_view value) {
    if (key == "Camera") {
      Begin(value);
    } else if (key == "Model" || key == "Mclass") {
      TakeModel(value);
    } else if (key == "Mtype" || key == "T") {
      TakeType(value);
    } else if (key == "Mparm" || key == "P") {
      TakeLinearity(value);
    } else if (key == "Dimensions") {
      if (const auto sides = Numbers<std::int64_t>(key, value, 2)) {
        Set("columns", JsonValue(sides->at(0)));
        Set("rows", JsonValue(sides->at(1)));
      }
    } else if (Contains(kVectorKeys, key)) {
      if (const auto vector = Numbers<double>(key, value, 3)) Set(key, core::ListOf(*vector));
    } else {
      Add(fmt::format("has the key \"{}\", which is not known", Shown(key)),
          core::Suggest(key, kKnownKeys));
    }
  }

  void Begin(std::string_view name) {
    const CameraBlock& first = sorted_.blocks.front();
    const bool unused = sorted_.blocks.size() == 1 && first.camera.empty() && first.lines.empty();
    if (first.camera.empty() && !unused) {
      Add("begins a camera below lines of none", "put the line Camera = left first");
    }
    if (!unused && sorted_.blocks.size() < kMostBlocks) sorted_.blocks.emplace_back();
    sorted_.blocks.back().camera = Shown(name);
    sorted_.blocks.back().line = line_;
  }

  // "CAHVORE3,0.37 = general"
  void TakeModel(std::string_view value) {
    std::string_view name = Trim(value.substr(0, value.find('=')));
    std::string_view linearity;
    if (const std::size_t comma = name.find(','); comma != std::string_view::npos) {
      linearity = Trim(name.substr(comma + 1));
      name = Trim(name.substr(0, comma));
    }
    if (name == "CAHV") {
      Set("model", JsonValue("cahv"));
    } else if (name == "CAHVOR") {
      Set("model", JsonValue("cahvor"));
    } else if (name.starts_with("CAHVORE") && name.size() <= 8) {
      Set("model", JsonValue("cahvore"));
      if (name.size() == 8) TakeType(name.substr(7));
    } else {
      Add(fmt::format("has the model \"{}\", which is not known", Shown(name)),
          "one of: CAHV, CAHVOR, CAHVORE1, CAHVORE2, CAHVORE3,LINEARITY");
      return;
    }
    if (!linearity.empty()) TakeLinearity(linearity);
  }

  void TakeType(std::string_view value) {
    // By the flight software's number less 1. Must agree with kTypeNames (camera_fields.cc).
    constexpr std::array<std::string_view, 3> kTypes = {"perspective", "fisheye", "general"};
    const std::optional<int> number = NumberIn<int>(value);
    if (!number || *number < 1 || *number > 3) {
      Add(fmt::format("has the type \"{}\" of a CAHVORE", Shown(value)),
          "use 1 (perspective), 2 (fisheye) or 3 (general)");
      return;
    }
    Set("type", JsonValue(kTypes[static_cast<std::size_t>(*number - 1)]));
  }

  void TakeLinearity(std::string_view value) {
    const std::optional<double> number = NumberIn<double>(value);
    if (!number) {
      Add(fmt::format("has the linearity \"{}\"", Shown(value)), "use a number from -1 to 1");
      return;
    }
    Set("linearity", JsonValue(*number));
  }

  template <typename Number>
  std::optional<std::vector<Number>> Numbers(std::string_view key, std::string_view value,
                                             std::size_t count) {
    const std::vector<std::string_view> words = Words(value, count);
    std::vector<Number> numbers;
    for (const std::string_view word : words) {
      const std::optional<Number> number = NumberIn<Number>(word);
      if (!number) {
        Add(fmt::format("has \"{}\" in {}", Shown(word), key),
            std::is_integral_v<Number> ? "write whole numbers" : "write finite numbers");
        return std::nullopt;
      }
      numbers.push_back(*number);
    }
    if (numbers.size() != count) {
      Add(fmt::format("gives {}{} numbers for {}, not {}",
                      numbers.size() > count ? "more than " : "", std::min(numbers.size(), count),
                      key, count),
          fmt::format("write {} numbers behind {} =", count, key));
      return std::nullopt;
    }
    return numbers;
  }

  void Set(std::string_view field, JsonValue value) {
    CameraBlock& block = sorted_.blocks.back();
    const auto [place, is_new] = block.lines.emplace(field, line_);
    if (!is_new) {
      Add(fmt::format("gives {} again, after line {}", field, place->second), "give it once");
      return;
    }
    block.fields.Append(std::string(field), std::move(value));
  }

  void Add(std::string_view reason, std::string_view suggestion) {
    if (sorted_.problems.size() >= kMostTextProblems) return;
    sorted_.problems.push_back(
        {source_name_, fmt::format("line {} {}", line_, reason), std::string(suggestion)});
  }

  std::string source_name_;
  CameraBlocks sorted_;
  int line_ = 0;
  bool in_matrix_ = false;
};

}  // namespace

CameraBlocks SortLines(std::string_view text, std::string_view source_name) {
  LineSorter sorter(source_name);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    sorter.Take(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::move(sorter).Finish();
}

}  // namespace rockyard::vision
