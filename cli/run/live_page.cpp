#include "cli/run/live_page.hpp"

#include <csignal>

#include "cli/run/supervisor.hpp"
#include "view/feed.hpp"
#include "view/finished_run.hpp"
#include "view/pages.hpp"
#include "view/server.hpp"

namespace skein::cli {
namespace {

constexpr const char* kKeyFile = "view.key";
constexpr const char* kDoorFile = "view.html";

/// Waits for a signal that ends a command. One that came while the results were written counts.
void wait_for_interrupt() {
  const sigset_t signals = interrupt_signals();
  sigset_t former;
  ::sigprocmask(SIG_BLOCK, &signals, &former);
  int signal = 0;
  ::sigwait(&signals, &signal);
  ::sigprocmask(SIG_SETMASK, &former, nullptr);
}

}  // namespace

LivePage::LivePage(std::uint16_t port) : script_(view::find_script()), listener_(port), key_(view::Key::draw()) {
  view::write_private_file(folder_.path() / kKeyFile, key_.text() + "\n");
  view::write_private_file(folder_.path() / kDoorFile, view::key_file_page(listener_.port(), key_));
}

WatchedBy LivePage::watched() const { return {listener_.fd(), folder_.path() / kKeyFile, script_}; }

std::string LivePage::address() const {
  return "watch it in a browser: open " + (folder_.path() / kDoorFile).string() +
         " (http://127.0.0.1:" + std::to_string(listener_.port()) + "/)";
}

void LivePage::replay(const std::filesystem::path& run) const {
  view::Feed feed;
  view::tell_finished_run(run, feed);
  const view::Server server(listener_.fd(), key_, view::site_of(view::title_of_run(run), script_), feed);
  wait_for_interrupt();
}

}  // namespace skein::cli
