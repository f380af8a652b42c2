// Names, numbers and poses out of elements of a URDF file, with all that is wrong with them. Only
// what makes the model of a file (urdf_model.h) uses it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "math/pose.h"
#include "rover/urdf_reader/urdf_findings.h"
#include "rover/urdf_reader/urdf_xml.h"

namespace rockyard::rover {

// Bounds of lengths, masses and angles beyond which no rover is meant: sums and products of such
// numbers stay finite.
inline constexpr core::Bounds kSaneUrdf = {-1e6, 1e6};
inline constexpr core::Bounds kSaneUrdfSize = {0.0, 1e6};

class UrdfElements {
 public:
  explicit UrdfElements(UrdfFindings& findings) : findings_(findings) {}

  // Returns the name of a link or joint. One that is missing or empty is a problem.
  std::string NameOf(const XmlElement& element);

  // Returns the only child of that name, or nullptr. A second one is a problem.
  const XmlElement* Only(const XmlElement& parent, std::string_view name, std::string_view place);

  // Return an attribute, or nothing where it is missing, which is no problem. What is no number or
  // out of bounds is one, and gives nothing.
  std::optional<double> Number(const XmlElement& element, std::string_view attribute,
                               std::string_view place, core::Bounds bounds = kSaneUrdf);
  std::optional<math::Vector3> Triple(const XmlElement& element, std::string_view attribute,
                                      std::string_view place);

  // Returns the same of one that has to be there; `otherwise` after a problem.
  double Needed(const XmlElement& element, std::string_view attribute, std::string_view place,
                core::Bounds bounds, double otherwise);

  // Returns the pose that the <origin> of an element tells; none: no shift, no turn.
  math::Transform Origin(const XmlElement& parent, std::string_view place);

  UrdfFindings& findings() { return findings_; }

 private:
  UrdfFindings& findings_;
};

// Returns `line 12: joint "left_rocker"`.
std::string UrdfPlace(const XmlElement& element, std::string_view name);

}  // namespace rockyard::rover
