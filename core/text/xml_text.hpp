// Builds pugixml documents and writes them as text. Pure; safe from any thread.
#pragma once

#include <pugixml.hpp>
#include <string>

namespace skein {

/// Appends an element to `parent`. @param text  the element's content, in UTF-8
void add_element(pugi::xml_node parent, const char* name, const std::string& text);

/// Text for a file: a declaration, then one element per line.
std::string xml_file(const pugi::xml_document& document);

/// Text for a setting: on one line, without a declaration.
std::string xml_line(const pugi::xml_document& document);

}  // namespace skein
