#include "rover/urdf_reader/urdf_xml.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "core/text.h"

namespace rockyard::rover {
namespace {

[[noreturn]] void RefuseXml(std::string_view source_name, int line, const std::string& reason,
                            const std::string& suggestion) {
  throw core::UserError(fmt::format("{}: line {}", source_name, line), reason, suggestion);
}

// Returns "mismatched element" of the library's XML_ERROR_MISMATCHED_ELEMENT.
std::string WordsOfError(const tinyxml2::XMLDocument& document) {
  std::string words = document.ErrorName();
  for (const std::string_view mark : {"XML_", "ERROR_"}) {
    if (words.starts_with(mark)) words.erase(0, mark.size());
  }
  std::transform(words.begin(), words.end(), words.begin(), [](unsigned char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  });
  return words;
}

// Copies an element of the library. It is no deeper than the library's own bound.
XmlElement Copied(const tinyxml2::XMLElement& from) {
  XmlElement to{.name = from.Name(), .line = from.GetLineNum()};
  for (const tinyxml2::XMLAttribute* each = from.FirstAttribute(); each != nullptr;
       each = each->Next()) {
    to.attributes.emplace_back(each->Name(), each->Value());
  }
  for (const tinyxml2::XMLElement* each = from.FirstChildElement(); each != nullptr;
       each = each->NextSiblingElement()) {
    to.children.push_back(Copied(*each));
  }
  return to;
}

int LineAt(std::string_view text, std::size_t at) {
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// Returns the place behind the tag that begins at `start`, past its quotes.
std::size_t EndOfTag(std::string_view text, std::size_t start) {
  char quote = '\0';
  std::size_t at = start;
  for (; at < text.size() && (quote != '\0' || text[at] != '>'); ++at) {
    if (text[at] == quote) {
      quote = '\0';
    } else if (quote == '\0' && (text[at] == '"' || text[at] == '\'')) {
      quote = text[at];
    }
  }
  return at;
}

// Refuses tags that are so long that the library, which holds each attribute against all before it,
// would take minutes.
void CheckTags(std::string_view text, std::string_view source_name) {
  constexpr std::size_t kLongestTag = 4096;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kTexts{
      {{"<!--", "-->"}, {"<![CDATA[", "]]>"}}};
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const auto skipped = std::find_if(kTexts.begin(), kTexts.end(), [&](const auto& each) {
      return text.substr(at).starts_with(each.first);
    });
    if (skipped != kTexts.end()) {
      at = std::min(text.find(skipped->second, at), text.size());
      continue;
    }
    const std::size_t end = EndOfTag(text, at);
    if (end - at > kLongestTag) {
      RefuseXml(
          source_name, LineAt(text, at),
          fmt::format("has a tag of {} bytes, more than the {} allowed", end - at, kLongestTag),
          "name a URDF file, as xacro writes it");
    }
    at = end;
  }
}

// Refuses what the library lets pass beside the top element.
void CheckTop(const tinyxml2::XMLDocument& document, std::string_view source_name) {
  const tinyxml2::XMLElement* const top = document.RootElement();
  for (const tinyxml2::XMLNode* node = document.FirstChild(); node != nullptr;
       node = node->NextSibling()) {
    if (node->ToUnknown() != nullptr) {
      RefuseXml(source_name, node->GetLineNum(), "has a document type, which is not read",
                "remove <!DOCTYPE ...>");
    }
    const bool known = node->ToDeclaration() != nullptr || node->ToComment() != nullptr;
    if (node != top && !known) {
      RefuseXml(source_name, node->GetLineNum(), "stands outside of the element at the top",
                "write one element <robot> that holds everything");
    }
  }
  if (top == nullptr) RefuseXml(source_name, 1, "holds no element", "name a URDF file");
}

}  // namespace

const std::string* XmlElement::Attribute(std::string_view wanted) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& each) { return each.first == wanted; });
  return found == attributes.end() ? nullptr : &found->second;
}

const XmlElement* XmlElement::Child(std::string_view wanted) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& each) { return each.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

XmlElement ParseXml(std::string_view text, std::string_view source_name) {
  if (text.size() > kMostUrdfBytes) {
    throw core::UserError(
        std::string(source_name),
        fmt::format("has {} bytes, more than the {} allowed", text.size(), kMostUrdfBytes),
        "check that this is the right file");
  }
  const std::size_t good = std::min(core::Utf8Bytes(text), text.find('\0'));
  if (good < text.size()) {
    RefuseXml(
        source_name, LineAt(text, good),
        fmt::format("byte {:#04x} is no text of UTF-8", static_cast<unsigned char>(text[good])),
        "save the file as UTF-8");
  }
  CheckTags(text, source_name);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    RefuseXml(source_name, std::max(document.ErrorLineNum(), 1),
              fmt::format("is no XML that can be read: {}", WordsOfError(document)),
              "name a URDF file, as xacro writes it");
  }
  CheckTop(document, source_name);
  return Copied(*document.RootElement());
}

}  // namespace rockyard::rover
