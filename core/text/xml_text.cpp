#include "core/text/xml_text.hpp"

#include <sstream>

namespace skein {
namespace {

std::string written(const pugi::xml_document& document, unsigned int format) {
  std::ostringstream out;
  document.save(out, "  ", format | pugi::format_no_declaration, pugi::encoding_utf8);
  return out.str();
}

}  // namespace

void add_element(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text() = text.c_str();
}

std::string xml_file(const pugi::xml_document& document) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + written(document, pugi::format_indent);
}

std::string xml_line(const pugi::xml_document& document) { return written(document, pugi::format_raw); }

}  // namespace skein
