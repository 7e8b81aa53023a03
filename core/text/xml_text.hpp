// XML documents that pugixml holds, written as text. Pure; safe from any thread.
#pragma once

#include <pugixml.hpp>
#include <string>

namespace skein {

/// Appends an element to `parent`. @param text  all that it holds, in UTF-8
void add_element(pugi::xml_node parent, const char* name, const std::string& text);

/// As a file has it: a declaration, then an element a line.
std::string xml_file(const pugi::xml_document& document);

/// As a setting has it: no declaration, all on one line.
std::string xml_line(const pugi::xml_document& document);

}  // namespace skein
