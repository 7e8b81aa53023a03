#include "view/pages.hpp"

#include <algorithm>

#include "core/files/file_bytes.hpp"
#include "core/types.hpp"
#include "report/html.hpp"
#include "report/style.hpp"
#include "report/web_bundle.hpp"
#include "view/kept_flight.hpp"

namespace skein::view {
namespace {

std::string document(const std::string& title, const std::string& head, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<link rel=\"icon\" href=\"data:,\"/>\n<title>" +
         report::escaped(title) + "</title>\n" + head + "</head>\n" + body + "</html>\n";
}

constexpr std::uintmax_t kLargestScript = 8 << 20;

std::string style_element(std::string_view more = {}) {
  return "<style>\n" + std::string(report::base_style()) + std::string(more) + "</style>\n";
}

/// The style element of a page that shows a flight.
std::string run_style_element() {
  return style_element(std::string(report::drawing_style()) + std::string(report::run_style()));
}

}  // namespace

std::filesystem::path find_script() {
  if (const auto file = report::find_web_bundle(report::kLiveScript)) return *file;
  throw InputError(
      "the page's script live.js is missing: packages of Skein contain it, and a build from source makes it with npm "
      "(docs/view.md)");
}

Site site_of(const std::string& title, const std::filesystem::path& script) {
  const std::string head = run_style_element() + "<script src=\"/live.js\" defer=\"defer\"></script>\n";
  return {document("Skein: " + title, head,
                   "<body class=\"run watch\">\n<noscript>This page needs JavaScript.</noscript>\n"
                   "<main id=\"flight\"><p class=\"soft\">Waiting for the flight to begin.</p></main>\n</body>\n"),
          read_file_bytes(script, kLargestScript)};
}

std::string kept_page(const std::string& title, const Feed& flight, std::size_t most_bytes) {
  const auto script = report::web_bundle(report::kLiveScript);
  if (!script) find_script();
  if (!script) throw InputError("the page's script live.js is damaged: it cannot be embedded in a page");
  const std::string head = "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
                           report::escaped(report::policy_of_file(script)) + "\"/>\n" + run_style_element();
  constexpr std::size_t kOtherHtml = 1000;  // estimated bytes of the other elements
  const std::size_t fixed_bytes = head.size() + script->size() + kOtherHtml;
  // Without room, 1 byte: kept_flight() then leaves out maps and points, and says so. With 0 it would not mention them.
  const std::size_t room = most_bytes > fixed_bytes ? most_bytes - fixed_bytes : std::min<std::size_t>(most_bytes, 1);
  return document("Skein: " + title, head,
                  "<body class=\"run watch\">\n<noscript>This page needs JavaScript.</noscript>\n"
                  "<main id=\"flight\"><p class=\"soft\">One moment, please.</p></main>\n"
                  "<script type=\"text/plain\" id=\"kept\">" +
                      kept_flight(flight, room) + "</script>\n<script>" + *script + "</script>\n</body>\n");
}

std::string door_page(bool refused) {
  return document(
      "Skein: the key, please", style_element(),
      "<body>\n<main>\n<h1>The key, please</h1>\n" +
          std::string(refused ? "<p role=\"alert\"><strong>That is not the key of this run.</strong></p>\n" : "") +
          "<p>To watch a run, or to pause it, you need its key. Open the file <code>view.html</code> whose path "
          "<code>skein</code> printed, or paste here the content of the file <code>view.key</code> in the same "
          "folder.</p>\n"
          "<form method=\"post\" action=\"/enter\"><label>Key <input name=\"key\" type=\"password\" "
          "autocomplete=\"off\" autofocus=\"autofocus\" size=\"40\"/></label> <button>Enter</button></form>\n"
          "</main>\n</body>\n");
}

std::string entered_page() {
  return document("Skein", "<meta http-equiv=\"refresh\" content=\"0;url=/\"/>\n" + style_element(),
                  "<body><main><p><a href=\"/\">To the run</a></p></main></body>\n");
}

std::string key_file_page(const std::string& host, const Key& key, bool waits) {
  const std::string enter = "document.getElementById('enter').submit()";
  // The browser does not let a local file read the server's answer, but fetch() succeeds once the server answers.
  const std::string when_served = "function knock() { fetch('http://" + host + "/', {mode: 'no-cors'}).then(() => " +
                                  enter + ", () => setTimeout(knock, 500)); }\nknock();";
  return document("Skein", style_element(),
                  "<body>\n<main>\n<form id=\"enter\" method=\"post\" action=\"http://" + host +
                      "/enter\"><input type=\"hidden\" name=\"key\" value=\"" + key.text() +
                      "\"/><button>Open the page of the run</button></form>\n" +
                      (waits ? "<p>The page opens by itself as soon as the fleet is running.</p>\n" : "") +
                      "</main>\n<script>" + (waits ? when_served : enter + ";") + "</script>\n</body>\n");
}

std::string page_policy() {
  return "default-src 'none'; script-src 'self'; style-src 'unsafe-inline'; connect-src 'self'; img-src data: blob:; "
         "base-uri 'none'; form-action 'self'; frame-ancestors 'none'";
}

}  // namespace skein::view
