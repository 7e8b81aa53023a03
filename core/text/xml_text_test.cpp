#include "core/text/xml_text.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein {
namespace {

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

TEST(XmlText, AnyTextReadsBackTheSame) {
  std::mt19937 random(11);
  const std::string alphabet = "ab \n&<>\"';#/]=ü";
  for (int i = 0; i < 2000; ++i) {
    std::string text = "x";  // the parser drops texts that are only white space
    for (unsigned n = random() % 12; n > 0; --n) text += alphabet[random() % (alphabet.size() - 2)];
    text += random() % 2 ? "ü" : "";
    pugi::xml_document document;
    pugi::xml_node top = document.append_child("top");
    top.append_attribute("said") = text.c_str();
    add_element(top, "a", text);
    add_element(top, "b", "");
    for (const std::string& xml : {xml_file(document), xml_line(document)}) {
      const pugi::xml_document again = parsed(xml);
      EXPECT_EQ(again.child("top").attribute("said").value(), text) << xml;
      EXPECT_EQ(again.child("top").child("a").text().get(), text) << xml;
    }
  }
}

TEST(XmlText, AFileHasItsDeclarationAndALineHasNoBreaks) {
  pugi::xml_document document;
  add_element(document.append_child("top"), "a", "1");
  document.child("top").append_child("b").append_attribute("c") = true;
  EXPECT_EQ(xml_file(document),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<top>\n  <a>1</a>\n  <b c=\"true\" />\n</top>\n");
  EXPECT_EQ(xml_line(document), "<top><a>1</a><b c=\"true\"/></top>");
}

}  // namespace
}  // namespace skein
