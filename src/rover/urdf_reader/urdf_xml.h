// The text of a URDF file as a tree of elements. ParseUrdf makes a model of it; only this file's
// .cc knows the XML library. No record depends on it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rockyard::rover {

// Most bytes of a file. Robots of a hundred links take a tenth of it.
inline constexpr std::size_t kMostUrdfBytes = std::size_t{2} << 20;

// An element with what stands in it, in the order of the file, but for comments and texts.
struct XmlElement {
  std::string name;
  int line = 0;  // where it begins, from 1
  std::vector<std::pair<std::string, std::string>> attributes{};
  std::vector<XmlElement> children{};

  // Return nullptr where there is none, and the first of several.
  const std::string* Attribute(std::string_view wanted) const;
  const XmlElement* Child(std::string_view wanted) const;
};

// Returns the only element at the top. Entities are not expanded, no other file is opened. Throws
// core::UserError whose path begins with `source_name` and has the line: more than kMostUrdfBytes,
// a tag of more than 4096 bytes, elements nested deeper than 100, what is no UTF-8 or no XML, a
// document type, anything but one element at the top.
XmlElement ParseXml(std::string_view text, std::string_view source_name);

}  // namespace rockyard::rover
