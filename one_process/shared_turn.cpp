#include "one_process/shared_turn.hpp"

#include "one_process/death_notice.hpp"
#include "one_process/program_output.hpp"

namespace skein::one_process {
namespace {

/// While it exists, this thread works for the same program as the thread that shares its turn.
class Helping {
 public:
  Helping(const ProgramOutput* output, const DeathNotice* notice)
      : helps_(ProgramOutput::here() != output || DeathNotice::here() != notice) {
    if (!helps_) return;
    if (output != nullptr) output->enter_beside();
    if (notice != nullptr) notice->enter();
  }
  ~Helping() {
    if (!helps_) return;
    DeathNotice::stand_down();
    ProgramOutput::leave_beside();
  }
  Helping(const Helping&) = delete;
  Helping& operator=(const Helping&) = delete;

 private:
  const bool helps_;
};

}  // namespace

ForEach shared_turn(Workers& workers) {
  return [&workers](std::size_t count, const std::function<void(std::size_t)>& work) {
    const ProgramOutput* const output = ProgramOutput::here();
    const DeathNotice* const notice = DeathNotice::here();
    workers.run(count, [&](std::size_t i) {
      const Helping helping(output, notice);
      work(i);
    });
  };
}

}  // namespace skein::one_process
