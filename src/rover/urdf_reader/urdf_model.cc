#include "rover/urdf_reader/urdf_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/text.h"
#include "rover/urdf_reader/urdf_elements.h"
#include "rover/urdf_reader/urdf_links.h"
#include "rover/urdf_reader/urdf_xml.h"

namespace rockyard::rover {
namespace {

using math::Transform;
using math::Vector3;

// By UrdfJointKind.
constexpr std::array<std::string_view, 6> kJointKinds{"fixed",     "continuous", "revolute",
                                                      "prismatic", "floating",   "planar"};
// Huge numbers often mean "no limit". Six of these have a finite sum.
constexpr core::Bounds kLimit = {-1e100, 1e100};

// Where a name stands in its list, for all links or all joints.
using Names = std::unordered_map<std::string, std::size_t>;

class UrdfBuilder {
 public:
  explicit UrdfBuilder(UrdfFindings& findings) : findings_(findings), elements_(findings) {}

  UrdfModel Build(const XmlElement& robot) {
    CheckRobot(robot);
    if (const std::string* name = robot.Attribute("name")) model_.name = *name;
    // Joints name links that may come later.
    for (const XmlElement& child : robot.children) {
      if (child.name == "link") {
        AddLink(child);
      } else if (child.name != "joint") {
        TakeOther(child);
      }
    }
    for (const XmlElement& child : robot.children) {
      if (child.name == "joint") AddJoint(child);
    }
    for (const auto& [joint, mimic] : mimics_) ReadMimic(model_.joints[joint], *mimic);
    // Without this the tree would blame what the problems so far have left out.
    findings_.ThrowIfFailed();
    OrderLinks();
    findings_.ThrowIfFailed();
    for (const auto& [name, entry] : unused_) {
      findings_.NotTaken(fmt::format("line {}: element {}", entry.line, ShownName(name)),
                         entry.count == 1
                             ? std::string("is not read")
                             : fmt::format("is not read, nor {} more", entry.count - 1));
    }
    return std::move(model_);
  }

 private:
  void CheckRobot(const XmlElement& robot) {
    if (robot.name == "robot") return;
    findings_.Fail(
        fmt::format("line {}", robot.line),
        fmt::format("begins with the element {}, which is no robot", ShownName(robot.name)),
        "name a URDF file, whose first element is <robot>");
    findings_.ThrowIfFailed();
  }

  void TakeOther(const XmlElement& element) {
    if (element.name.starts_with("xacro:")) {
      findings_.Fail(fmt::format("line {}", element.line),
                     fmt::format("{} is a macro that is not expanded", ShownName(element.name)),
                     "expand it first: xacro FILE > rover.urdf");
      return;
    }
    AddUnused(unused_, element);
  }

  void AddLink(const XmlElement& element) {
    UrdfLink link = ReadUrdfLink(element, elements_, unused_);
    AddName(links_, link.name, link.place, model_.links.size());
    model_.links.push_back(std::move(link));
  }

  void AddName(Names& names, const std::string& name, const std::string& place, std::size_t index) {
    if (name.empty()) return;  // told already
    if (!names.emplace(name, index).second) {
      findings_.Fail(place, "has the name of an earlier one", "give it a name of its own");
    }
  }

  // Returns the link that <parent> or <child> names.
  std::optional<std::size_t> LinkOf(const XmlElement& joint, std::string_view end,
                                    const std::string& place) {
    const XmlElement* const element = elements_.Only(joint, end, place);
    const std::string* const name = element == nullptr ? nullptr : element->Attribute("link");
    if (name == nullptr) {
      findings_.Fail(place, fmt::format("has no <{} link=\"...\">", end),
                     "name the two links that it joins");
      return std::nullopt;
    }
    const auto found = links_.find(*name);
    if (found != links_.end()) return found->second;
    findings_.Fail(place, fmt::format("has the {} {}, which is no link", end, ShownName(*name)),
                   "name a link of this file");
    return std::nullopt;
  }

  void AddJoint(const XmlElement& element) {
    UrdfJoint joint;
    joint.name = elements_.NameOf(element);
    joint.place = UrdfPlace(element, joint.name);
    joint.kind = KindOf(element, joint.place);
    joint.X_PC = elements_.Origin(element, joint.place);
    if (joint.kind != UrdfJointKind::kFixed) ReadAxis(element, joint);
    ReadLimit(element, joint);
    const auto parent = LinkOf(element, "parent", joint.place);
    const auto child = LinkOf(element, "child", joint.place);
    TakeRest(element);
    if (!parent || !child) return;
    joint.parent = *parent;
    joint.child = *child;
    const std::size_t index = model_.joints.size();
    AddName(joints_, joint.name, joint.place, index);
    UrdfLink& carried = model_.links[*child];
    if (carried.parent_joint) {
      findings_.Fail(
          joint.place,
          fmt::format("carries {}, which another joint carries", ShownName(carried.name)),
          "let each link have one parent");
    }
    carried.parent_joint = index;
    if (const XmlElement* mimic = elements_.Only(element, "mimic", joint.place)) {
      mimics_.emplace_back(index, mimic);
    }
    model_.joints.push_back(std::move(joint));
  }

  UrdfJointKind KindOf(const XmlElement& element, const std::string& place) {
    const std::string* const type = element.Attribute("type");
    for (std::size_t i = 0; type != nullptr && i < kJointKinds.size(); ++i) {
      if (*type == kJointKinds[i]) return static_cast<UrdfJointKind>(i);
    }
    findings_.Fail(
        place, type == nullptr ? "has no type" : fmt::format("has the type {}", ShownName(*type)),
        core::Suggest(type == nullptr ? "" : *type, kJointKinds));
    return UrdfJointKind::kFixed;
  }

  void ReadAxis(const XmlElement& element, UrdfJoint& joint) {
    const XmlElement* const axis = elements_.Only(element, "axis", joint.place);
    if (axis == nullptr) return;
    const auto xyz = elements_.Triple(*axis, "xyz", joint.place);
    if (!xyz) return;
    const double length = xyz->norm();
    if (length > 1e-6) {
      joint.axis_C = *xyz / length;
      return;
    }
    findings_.Fail(joint.place, "has an axis without direction", "give a vector such as 0 1 0");
  }

  void ReadLimit(const XmlElement& element, UrdfJoint& joint) {
    const XmlElement* const limit = elements_.Only(element, "limit", joint.place);
    if (limit == nullptr) return;
    joint.lower = elements_.Number(*limit, "lower", joint.place, kLimit).value_or(0.0);
    joint.upper = elements_.Number(*limit, "upper", joint.place, kLimit).value_or(0.0);
    joint.effort = elements_.Number(*limit, "effort", joint.place, kLimit);
    joint.velocity = elements_.Number(*limit, "velocity", joint.place, kLimit);
  }

  void TakeRest(const XmlElement& element) {
    constexpr std::array<std::string_view, 6> kRead{"origin", "parent", "child",
                                                    "axis",   "limit",  "mimic"};
    for (const XmlElement& child : element.children) {
      if (std::find(kRead.begin(), kRead.end(), child.name) == kRead.end()) {
        AddUnused(unused_, child);
      }
    }
  }

  void ReadMimic(UrdfJoint& joint, const XmlElement& mimic) {
    const std::string* const name = mimic.Attribute("joint");
    const auto found = name == nullptr ? joints_.end() : joints_.find(*name);
    if (found == joints_.end()) {
      findings_.Fail(joint.place, "has a <mimic> of no joint", "name a joint of this file");
      return;
    }
    joint.mimic =
        UrdfMimic{.joint = found->second,
                  .multiplier = elements_.Number(mimic, "multiplier", joint.place).value_or(1.0),
                  .offset = elements_.Number(mimic, "offset", joint.place).value_or(0.0)};
  }

  // Finds the root and puts every link behind its parent.
  void OrderLinks() {
    std::vector<std::vector<std::size_t>> carried(model_.links.size());
    for (const UrdfJoint& joint : model_.joints) carried[joint.parent].push_back(joint.child);
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (model_.links[i].parent_joint) continue;
      if (!model_.order.empty()) {
        findings_.Fail(model_.links[i].place,
                       fmt::format("is a second root beside {}",
                                   ShownName(model_.links[model_.order.front()].name)),
                       "join all links to one tree");
        continue;
      }
      model_.order.push_back(i);
    }
    findings_.ThrowIfFailed();
    for (std::size_t i = 0; i < model_.order.size(); ++i) {
      const std::vector<std::size_t>& next = carried[model_.order[i]];
      model_.order.insert(model_.order.end(), next.begin(), next.end());
    }
    if (model_.order.size() == model_.links.size() && !model_.links.empty()) return;
    findings_.Fail("", model_.links.empty() ? "has no links" : "has joints that make a circle",
                   "join all links to one tree");
  }

  UrdfFindings& findings_;
  UrdfElements elements_;
  UrdfModel model_;
  Names links_;
  Names joints_;
  UnusedByName unused_;
  std::vector<std::pair<std::size_t, const XmlElement*>> mimics_;  // of joints
};

}  // namespace

UrdfModel ParseUrdf(std::string_view text, std::string_view source_name, UrdfFindings& findings) {
  const XmlElement robot = ParseXml(text, source_name);
  return UrdfBuilder(findings).Build(robot);
}

std::vector<Transform> LinkPoses(const UrdfModel& model) {
  std::vector<Transform> X_0L(model.links.size(), Transform::Identity());
  for (const std::size_t link : model.order) {
    if (!model.links[link].parent_joint) continue;
    const UrdfJoint& joint = model.joints[*model.links[link].parent_joint];
    X_0L[link] = X_0L[joint.parent] * joint.X_PC;
  }
  return X_0L;
}

}  // namespace rockyard::rover
