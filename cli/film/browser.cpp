#include "cli/film/browser.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cctype>
#include <stdexcept>

#include "core/text/base64.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {
namespace {

/// With options that make pictures alike on all machines: software rendering, one colour profile, no hinting of fonts.
ProgramSpec chromium_spec(const std::filesystem::path& chromium, const std::filesystem::path& scratch) {
  ProgramSpec spec;
  spec.name = "chromium";
  // Chromium reads from descriptor 3 and writes to 4, opposite to Skein's own programs.
  spec.argv = {"/bin/sh",
               "-c",
               "exec \"$@\" 5<&4 4>&3 3<&5 5<&-",
               "sh",
               chromium,
               "--headless",
               "--remote-debugging-pipe",
               "--user-data-dir=" + (scratch / "profile").string(),
               "--no-first-run",
               "--no-default-browser-check",
               "--disable-background-networking",
               "--disable-component-update",
               "--disable-extensions",
               "--disable-sync",
               "--disable-dev-shm-usage",
               "--use-angle=swiftshader",
               "--enable-unsafe-swiftshader",
               "--force-color-profile=srgb",
               "--font-render-hinting=none",
               "--hide-scrollbars"};
  if (::geteuid() == 0) spec.argv.emplace_back("--no-sandbox");  // root cannot use the sandbox
  spec.env = environment_with({{"TMPDIR", scratch.string()}});   // a killed Chromium leaves files there
  spec.log = scratch / "chromium.log";
  spec.minded = true;
  return spec;
}

}  // namespace

std::string file_url(const std::filesystem::path& file) {
  std::string url = "file://";
  for (const char letter : std::filesystem::absolute(file).string()) {
    const auto code = static_cast<unsigned char>(letter);
    const bool plain =
        code < 128 && (std::isalnum(code) || std::string_view("/-._~").find(letter) != std::string::npos);
    url += plain ? std::string(1, letter) : fmt::format("%{:02X}", code);
  }
  return url;
}

Browser::Browser(const std::filesystem::path& chromium, const std::filesystem::path& scratch,
                 const HeldSignals& signals)
    : program_(chromium_spec(chromium, scratch), signals) {
  const Json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                 .at("sessionId")
                 .get<std::string>();
  call("Page.enable", Json::object());
}

void Browser::open(const std::filesystem::path& file, PictureSize size) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", size.width}, {"height", size.height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  call("Emulation.setEmulatedMedia",
       {{"features", Json::array({{{"name", "prefers-color-scheme"}, {"value", "light"}}})}});
  const Json loaded = call("Page.navigate", {{"url", file_url(file)}});
  if (loaded.contains("errorText")) {
    throw std::runtime_error("chromium cannot load " + file.string() + ": " + loaded["errorText"].dump());
  }
}

Json Browser::evaluate(const std::string& script) {
  const Json answer =
      call("Runtime.evaluate", {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    throw std::runtime_error("the page in chromium: " + answer["exceptionDetails"].dump());
  }
  return value_or(answer.at("result"), "value", nullptr);
}

std::vector<std::uint8_t> Browser::picture() {
  const Json answer = call("Page.captureScreenshot", {{"format", "png"}, {"optimizeForSpeed", true}});
  const auto bytes = read_base64(answer.at("data").get<std::string>());
  if (!bytes) throw std::runtime_error("chromium's picture is not base64");
  return *bytes;
}

void Browser::close() {
  session_.clear();
  call("Browser.close", Json::object());
  program_.finish();
}

std::string Browser::next_message() {
  std::size_t end = received_.find('\0');
  while (end == std::string::npos) {
    const std::size_t looked = received_.size();
    received_ += program_.read();
    end = received_.find('\0', looked);
  }
  std::string message = received_.substr(0, end);
  received_.erase(0, end + 1);
  return message;
}

Json Browser::call(const std::string& method, Json parameters) {
  Json message = {{"id", ++last_call_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty()) message["sessionId"] = session_;
  std::string text = message.dump();
  text += '\0';
  program_.write(text);
  while (true) {
    const Json answer = parse_json(next_message());
    if (value_or(answer, "id", 0) != last_call_) continue;  // an event
    if (answer.contains("error")) throw std::runtime_error("chromium, " + method + ": " + answer["error"].dump());
    return value_or(answer, "result", Json::object());
  }
}

}  // namespace skein::cli
