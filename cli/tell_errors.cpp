#include "cli/tell_errors.hpp"

#include <exception>
#include <filesystem>
#include <ostream>
#include <system_error>

#include "core/types.hpp"
#include "process/files/path_error.hpp"
#include "process/host/open_files.hpp"
#include "process/program.hpp"

namespace skein::cli {

int tell_errors(const Console& console, const std::function<int()>& work) try {
  return work();
} catch (const InputError& error) {
  console.err << error.what() << std::endl;
  return kExitBadInput;
} catch (const std::filesystem::filesystem_error& error) {
  console.err << "skein: " << path_error_text(error) << open_files_hint(error.code()) << std::endl;
  return is_wrong_path(error) ? kExitBadInput : kExitProcessFailed;
} catch (const std::system_error& error) {
  console.err << "skein: " << error.what() << open_files_hint(error.code()) << std::endl;
  return kExitProcessFailed;
} catch (const std::exception& error) {
  console.err << "skein: " << error.what() << std::endl;
  return kExitProcessFailed;
}

}  // namespace skein::cli
