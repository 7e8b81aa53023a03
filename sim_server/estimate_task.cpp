#include "sim_server/estimate_task.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "process/files/user_cache.hpp"

namespace skein::sim {
namespace {

/// Limit of the oracle's computing time on an idle machine [s]. A run that ends earlier waits for the oracle.
constexpr double kPatience_s = 5.0;
constexpr int kLeastUrgent = 19;

}  // namespace

EstimateTask::EstimateTask(const Scenario& scenario, const Scene& scene, OracleRequest request)
    : thread_([this, &scenario, &scene, request = std::move(request)] {
        // This lowers only this thread's priority: on Linux each thread has its own.
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLeastUrgent);
        try {
          OracleReply reply = ask_oracle(scenario, scene, request);
          for (const std::string& warning : reply.warnings) spdlog::warn("{}", warning);
          answer_ = std::move(reply.summary);
        } catch (const std::exception& error) {
          spdlog::warn("the attainable score is not shown: {}", error.what());
        }
        done_ = true;
      }) {}

std::optional<OracleSummary> EstimateTask::take() {
  return done_ ? std::exchange(answer_, std::nullopt) : std::nullopt;
}

OracleRequest estimate_request() { return {.config = {}, .patience_s = kPatience_s, .cache = user_cache_folder()}; }

}  // namespace skein::sim
