// A planner that at a given time does something that no planner should do, for tests of the effect on other UAVs.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

enum class Nastiness {
  none,
  throws,
  throws_number,
  segfaults,
  aborts,
  exits,
  overflows,
  hangs,
  stops,
  closes,
  exits_now,
  exits_quickly,
  becomes,
  names_badly,
  names_many
};
constexpr std::array<EnumName<Nastiness>, 15> enum_names(Nastiness) {
  return {{{"none", Nastiness::none},
           {"throws", Nastiness::throws},
           {"throws_number", Nastiness::throws_number},
           {"segfaults", Nastiness::segfaults},
           {"aborts", Nastiness::aborts},
           {"exits", Nastiness::exits},
           {"overflows", Nastiness::overflows},
           {"hangs", Nastiness::hangs},
           {"stops", Nastiness::stops},
           {"closes", Nastiness::closes},
           {"exits_now", Nastiness::exits_now},
           {"exits_quickly", Nastiness::exits_quickly},
           {"becomes", Nastiness::becomes},
           {"names_badly", Nastiness::names_badly},
           {"names_many", Nastiness::names_many}}};
}

namespace {

/// The file to which the planner's destructor writes.
const char* last_will() {
  const char* file = std::getenv("NASTY_WILL");
  return file == nullptr ? "/dev/null" : file;
}

/// Recurses without end. Each call's local data are used, or the compiler would turn the recursion into a loop.
int sink(int depth) {
  static volatile int bottom = -1;  // is never reached
  volatile char room[4096] = {};
  room[depth % 4096] = 1;
  return depth == bottom ? 0 : sink(depth + 1) + room[0];
}

}  // namespace

class NastyPlanner final : public Planner {
 public:
  struct Config {
    Nastiness how = Nastiness::none;
    double at_s = 3.0;

    void describe(auto& r) {
      r.field("how", how);
      r.field("at_s", at_s, within(0.0, 1000.0));
    }
  };

  NastyPlanner(const Config& config, const AgentConfig&) : config_(config) { std::printf("nasty begins\n"); }

  /// Leaves a trace in a file; is not called when the program is killed.
  ~NastyPlanner() override { std::ofstream(last_will(), std::ios::app) << "I have lived\n"; }

  std::vector<std::string> debug_names() const override {
    if (config_.how == Nastiness::names_badly) return {"fine", "not fine"};
    std::vector<std::string> names;
    if (config_.how == Nastiness::names_many) {
      for (int i = 0; i < 65; ++i) names.push_back("n" + std::to_string(i));
    }
    return names;
  }

  PlannerOutput plan(const PlannerInput& in) override {
    if (!std::exchange(warned_, true)) std::cerr << "nasty plans\n";
    if (seconds(in.tick) >= config_.at_s && !std::exchange(done_, true)) misbehave();
    return {};
  }

 private:
  void misbehave() const {
    spdlog::info("nasty {}", name_of(config_.how));
    switch (config_.how) {
      case Nastiness::none:
      case Nastiness::names_badly:
      case Nastiness::names_many:
        return;
      case Nastiness::throws:
        throw std::runtime_error("I do not like it here");
      case Nastiness::throws_number:
        throw 42;
      case Nastiness::segfaults:
        std::raise(SIGSEGV);
        return;
      case Nastiness::aborts:
        std::abort();
      case Nastiness::exits:
        std::exit(0);
      case Nastiness::overflows:
        std::printf("%d\n", sink(0));
        return;
      case Nastiness::hangs:
        while (true) asm volatile("");
      case Nastiness::stops:
        std::raise(SIGSTOP);
        return;
      case Nastiness::closes:
        ::closefrom(0);
        return;
      case Nastiness::exits_now:
        ::_exit(0);
      case Nastiness::exits_quickly:
        std::quick_exit(0);
      case Nastiness::becomes:
        ::execl("/bin/true", "true", nullptr);
        return;
    }
  }

  const Config config_;
  bool done_ = false, warned_ = false;
};

SKEIN_REGISTER_PLANNER("nasty", NastyPlanner);

}  // namespace skein::agent
