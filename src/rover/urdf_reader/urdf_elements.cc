#include "rover/urdf_reader/urdf_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/text.h"

namespace rockyard::rover {
namespace {

using math::Transform;
using math::Vector3;

constexpr std::string_view kXmlBlanks = " \t\r\n";

// Reads as many numbers as there is room for. Returns what is wrong, or nothing.
std::string ReadNumbers(std::string_view text, core::Bounds bounds, std::span<double> numbers) {
  std::size_t count = 0;
  std::string_view rest = text;
  for (;;) {
    const std::size_t first = rest.find_first_not_of(kXmlBlanks);
    if (first == std::string_view::npos) break;
    const std::size_t end = std::min(rest.find_first_of(kXmlBlanks, first), rest.size());
    const std::string_view word = rest.substr(first, end - first);
    rest.remove_prefix(end);
    if (count == numbers.size()) return fmt::format("has more than {} numbers", count);
    const std::optional<double> number = core::FiniteNumber(word);
    if (!number) return fmt::format("has {}, which is no finite number", ShownName(word));
    if (*number < bounds.low || *number > bounds.high) {
      return fmt::format("has {:g}, which is not between {:g} and {:g}", *number, bounds.low,
                         bounds.high);
    }
    numbers[count++] = *number;
  }
  if (count < numbers.size()) {
    return fmt::format("has {} numbers in place of {}", count, numbers.size());
  }
  return "";
}

std::string_view AdviceFor(std::string_view text) {
  return text.find("${") == std::string_view::npos ? "write decimal numbers in SI units"
                                                   : "expand it first: xacro FILE > rover.urdf";
}

}  // namespace

std::string UrdfPlace(const XmlElement& element, std::string_view name) {
  return fmt::format("line {}: {} {}", element.line, element.name, ShownName(name));
}

std::string UrdfElements::NameOf(const XmlElement& element) {
  const std::string* const name = element.Attribute("name");
  if (name != nullptr && !name->empty()) return *name;
  findings_.Fail(fmt::format("line {}: {}", element.line, element.name), "has no name",
                 "give each link and joint a name of its own");
  return "";
}

const XmlElement* UrdfElements::Only(const XmlElement& parent, std::string_view name,
                                     std::string_view place) {
  const XmlElement* const found = parent.Child(name);
  const auto count = std::count_if(parent.children.begin(), parent.children.end(),
                                   [&](const XmlElement& each) { return each.name == name; });
  if (count > 1) {
    findings_.Fail(place, fmt::format("has {} <{}>", count, name), "keep one of them");
  }
  return found;
}

std::optional<double> UrdfElements::Number(const XmlElement& element, std::string_view attribute,
                                           std::string_view place, core::Bounds bounds) {
  const std::string* const text = element.Attribute(attribute);
  if (text == nullptr) return std::nullopt;
  double number = 0.0;
  const std::string wrong = ReadNumbers(*text, bounds, {&number, 1});
  if (wrong.empty()) return number;
  findings_.Fail(
      place, fmt::format("{} of <{}> in line {} {}", attribute, element.name, element.line, wrong),
      std::string(AdviceFor(*text)));
  return std::nullopt;
}

std::optional<Vector3> UrdfElements::Triple(const XmlElement& element, std::string_view attribute,
                                            std::string_view place) {
  const std::string* const text = element.Attribute(attribute);
  if (text == nullptr) return std::nullopt;
  std::array<double, 3> numbers{};
  const std::string wrong = ReadNumbers(*text, kSaneUrdf, numbers);
  if (wrong.empty()) return Vector3(numbers[0], numbers[1], numbers[2]);
  findings_.Fail(
      place, fmt::format("{} of <{}> in line {} {}", attribute, element.name, element.line, wrong),
      std::string(AdviceFor(*text)));
  return std::nullopt;
}

double UrdfElements::Needed(const XmlElement& element, std::string_view attribute,
                            std::string_view place, core::Bounds bounds, double otherwise) {
  if (element.Attribute(attribute) == nullptr) {
    findings_.Fail(place,
                   fmt::format("<{}> in line {} has no {}", element.name, element.line, attribute),
                   "give it");
  }
  return Number(element, attribute, place, bounds).value_or(otherwise);
}

Transform UrdfElements::Origin(const XmlElement& parent, std::string_view place) {
  const XmlElement* const origin = Only(parent, "origin", place);
  if (origin == nullptr) return Transform::Identity();
  if (origin->Attribute("quat_xyzw") != nullptr) {
    findings_.Fail(place, fmt::format("<origin> in line {} has a quaternion", origin->line),
                   "write the turn as rpy");
  }
  const Vector3 xyz = Triple(*origin, "xyz", place).value_or(Vector3::Zero());
  const Vector3 rpy = Triple(*origin, "rpy", place).value_or(Vector3::Zero());
  return math::MakePose(xyz, rpy.z(), rpy.y(), rpy.x());
}

}  // namespace rockyard::rover
