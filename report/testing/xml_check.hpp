// For tests: checks that a text is well-formed XML as Skein writes it, and lists its elements.
#pragma once

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace skein::report {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
};

/// @returns all elements in document order. @throws std::runtime_error if the text is not well-formed.
inline std::vector<XmlElement> xml_elements(const std::string& text) {
  const auto check = [&](bool good, const std::string& what, std::ptrdiff_t at = 0) {
    if (!good) throw std::runtime_error(what + " near: " + text.substr(static_cast<std::size_t>(at), 120));
  };
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  check(static_cast<bool>(result), result.description(), result.offset);
  // pugixml accepts these mistakes: a bare '&', control characters, two roots, an attribute twice.
  static const std::regex kBare("&(?!(amp|lt|gt|quot|#39|#10);)");
  std::smatch bare;
  if (std::regex_search(text, bare, kBare)) check(false, "a bare '&'", bare.position());
  const auto is_control = [](unsigned char c) { return c < 0x20 && c != '\n' && c != '\t'; };
  check(std::none_of(text.begin(), text.end(), is_control), "a control character");
  const auto roots = document.children();
  const auto is_element = [](const pugi::xml_node& node) { return node.type() == pugi::node_element; };
  check(std::count_if(roots.begin(), roots.end(), is_element) == 1, "a second root");

  struct Walker : pugi::xml_tree_walker {
    std::vector<XmlElement> elements;
    std::string twice;
    bool for_each(pugi::xml_node& node) override {
      if (node.type() != pugi::node_element) return true;
      XmlElement element{node.name(), {}};
      for (const pugi::xml_attribute& attribute : node.attributes()) {
        if (!element.attributes.emplace(attribute.name(), attribute.value()).second) twice = attribute.name();
      }
      elements.push_back(std::move(element));
      return true;
    }
  } walker;
  document.traverse(walker);
  check(walker.twice.empty(), "'" + walker.twice + "' twice");
  return walker.elements;
}

}  // namespace skein::report
