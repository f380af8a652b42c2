// The links of a URDF file: masses, inertias and shapes. ParseUrdf calls it.
#pragma once

#include <map>
#include <string>

#include "rover/urdf_reader/urdf_elements.h"
#include "rover/urdf_reader/urdf_model.h"
#include "rover/urdf_reader/urdf_xml.h"

namespace rockyard::rover {

// Elements that rockyard has no use for, by their names: the line of the first and how many.
struct UnusedElements {
  int line = 0;
  std::size_t count = 0;
};
using UnusedByName = std::map<std::string, UnusedElements>;

// Notes an element that is not used.
void AddUnused(UnusedByName& unused, const XmlElement& element);

// Reads a link. Problems go to the findings of `elements`.
UrdfLink ReadUrdfLink(const XmlElement& element, UrdfElements& elements, UnusedByName& unused);

}  // namespace rockyard::rover
