#include "run/live_page.hpp"

#include <csignal>
#include <cstdlib>

#include "host/supervisor.hpp"
#include "process/files/private_file.hpp"
#include "process/host/host_name.hpp"
#include "run/browser.hpp"
#include "view/finished_run.hpp"
#include "view/pages.hpp"
#include "view/server.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Waits for a signal that ends a command. A signal that came while the results were written counts, too.
void wait_for_interrupt() {
  const sigset_t signals = interrupt_signals();
  sigset_t former;
  ::sigprocmask(SIG_BLOCK, &signals, &former);
  int signal = 0;
  ::sigwait(&signals, &signal);
  ::sigprocmask(SIG_SETMASK, &former, nullptr);
}

}  // namespace

LivePage::LivePage(const view::Endpoint& endpoint, bool in_container)
    : script_(view::find_script()),
      listener_(std::in_place, endpoint),
      endpoint_(listener_->endpoint()),
      key_(view::Key::draw()) {
  if (in_container) listener_.reset();
  write_private_file(folder_.path() / kViewKey, key_.text() + "\n");
  write_private_file(folder_.path() / kViewDoor, view::key_file_page(endpoint_.from_here().text(), key_, in_container));
}

WatchedBy LivePage::watched() const { return {listener_ ? listener_->fd() : -1, folder_.path() / kViewKey, script_}; }

void LivePage::announce(const std::function<void(const std::string&)>& say, bool in_browser) const {
  const fs::path door = folder_.path() / kViewDoor;
  say("watch it in a browser: open " + door.string() + " (http://" + endpoint_.from_here().text() + "/)");
  const char* const ssh = std::getenv("SSH_CONNECTION");
  const std::string port = std::to_string(endpoint_.port), key = (folder_.path() / kViewKey).string();
  if (!endpoint_.is_loopback()) {
    say("warning: the page is served at " + endpoint_.text() +
        ", beyond this host: anyone who reaches it and has the key may look and give orders, and plain HTTP hides "
        "neither; "
        "ssh -L is safer (docs/how-to-watch.md). From elsewhere: http://" +
        (endpoint_.is_any() ? host_name("HOST") + ":" + port : endpoint_.text()) + "/, with the key in " + key);
  } else if (ssh != nullptr && *ssh != '\0') {
    say("from your own machine: ssh -L " + port + ":" + endpoint_.text() + " " + host_name("HOST") +
        ", then http://localhost:" + port + "/ there, with the key in " + key);
  }
  if (!in_browser) return;
  const auto command = browser_command(door, [](const char* name) { return std::getenv(name); });
  if (!command.empty() && !start_browser(command)) say("warning: " + command[0] + " could not be started");
}

void LivePage::replay(const fs::path& run) {
  view::Feed feed;
  view::tell_finished_run(run, feed);
  show(feed, view::title_of_run(run));
}

void LivePage::stay_as_replay(const std::filesystem::path& run, const ViewOptions& options, std::ostream& err) {
  if (options.close) return;
  err << "the page shows the replay now; Ctrl-C ends it" << std::endl;
  try {
    replay(run);
  } catch (const InputError& error) {  // e.g. another program took the port that the Docker engine released
    err << error.what() << std::endl;
  }
}

void LivePage::show(view::Feed& feed, const std::string& title) {
  if (!listener_) listener_.emplace(endpoint_);
  const view::Server server(listener_->fd(), key_, view::site_of(title, script_), feed);
  wait_for_interrupt();
}

void write_for_station(const fs::path& folder, const view::Key& key) {
  const fs::path script = view::find_script();
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::owner_all);
  write_private_file(folder / kViewKey, key.text() + "\n");
  fs::copy_file(script, folder / kViewScript, fs::copy_options::overwrite_existing);
}

}  // namespace skein::cli
