#include "cli/film/film.hpp"

#include <cmath>
#include <stdexcept>

#include "core/files/command_file.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/json_text.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kMostPictures = 100'000;

fs::path needed(const char* command, const char* what) {
  fs::path file = command_file(command);
  if (file.empty()) {
    throw InputError(std::string("--export of a film needs ") + command + ", " + what + ": apt-get install " + command);
  }
  return file;
}

/// The same pictures make the same file, on any number of processors: the number of threads is fixed.
ProgramSpec ffmpeg_spec(const fs::path& ffmpeg, int fps, const fs::path& file, const fs::path& scratch) {
  ProgramSpec spec;
  spec.name = "ffmpeg";
  spec.argv = {ffmpeg,
               "-hide_banner",
               "-nostdin",
               "-loglevel",
               "error",
               "-f",
               "image2pipe",
               "-framerate",
               std::to_string(fps),
               "-c:v",
               "png",
               "-i",
               "pipe:" + std::to_string(kControlFd),
               "-c:v",
               "libx264",
               "-preset",
               "medium",
               "-crf",
               "20",
               "-pix_fmt",
               "yuv420p",
               "-threads",
               "4",
               "-fflags",
               "+bitexact",
               "-flags:v",
               "+bitexact",
               "-movflags",
               "+faststart",
               "-f",
               "mp4",
               "-y",
               file};
  spec.env = environment_with({});
  spec.log = scratch / "ffmpeg.log";
  return spec;
}

/// A temporary file beside `file`: keep() gives it that name, otherwise the destructor deletes it.
class Draft {
 public:
  explicit Draft(const fs::path& file) : file_(file), draft_(file.string() + ".part") {}
  ~Draft() {
    std::error_code ignored;
    fs::remove(draft_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  const fs::path& path() const { return draft_; }
  void keep() const { put_in_place(draft_, file_); }

 private:
  const fs::path file_, draft_;
};

/// Waits until the page is ready, since its script first unpacks the flight. The value is true if it draws in 3D.
constexpr const char* kFilmable = R"js(new Promise((done, failed) => {
  let tries = 0;
  const look = () => {
    if (document.getElementById('filmable') !== null) return done(document.querySelector('.stage canvas') !== null);
    if (++tries > 2400) return failed('the page shows no flight');
    setTimeout(look, 50);
  };
  look();
}))js";

void show_progress(const Console& console, std::size_t picture, std::size_t all) {
  if (console.terminal) console.err << "\rpicture " << picture << " of " << all << (picture == all ? "\n" : "");
  console.err << std::flush;
}

}  // namespace

FilmTimes::FilmTimes(const FilmOptions& options, double from_s, double end_s) : from_s_(from_s), end_s_(end_s) {
  const double flown_s = end_s - from_s;
  if (!(flown_s > 0.0)) {
    throw InputError("the film would begin at " + std::to_string(from_s) + " s, and the flight ends at " +
                     std::to_string(end_s) + " s");
  }
  const double speed = options.speed.value_or(flown_s / options.seconds.value_or(kUsualFilm_s));
  each_s_ = speed / options.fps.value_or(kUsualFps);
  const double pictures = std::ceil(flown_s / each_s_ - 1e-9) + 1.0;
  if (!(pictures <= kMostPictures)) {
    throw InputError("the film would have " + std::to_string(pictures) +
                     " pictures; give a greater --speed, less --seconds or less --fps");
  }
  size_ = static_cast<std::size_t>(pictures);
}

double FilmTimes::operator[](std::size_t picture) const {
  return picture + 1 >= size_ ? end_s_ : from_s_ + each_s_ * static_cast<double>(picture);
}

FilmPrograms::FilmPrograms()
    : chromium(needed("chromium", "which draws its pictures")),
      ffmpeg(needed("ffmpeg", "which makes a film of them")) {}

void write_film(const FilmPrograms& programs, const std::string& page, const FilmOptions& options, const fs::path& file,
                const Console& console) {
  const HeldSignals signals;
  const ScratchDir scratch;
  const fs::path html = scratch.path() / "film.html";
  write_file_atomically(html, page);
  Browser browser(programs.chromium, scratch.path(), signals);
  browser.open(html, {options.width, options.height});
  if (browser.evaluate(kFilmable) != Json(true)) throw std::runtime_error("chromium draws no 3D scenes here (WebGL)");
  const Json shown = browser.evaluate("film.begin(" + Json(options.address).dump() + ")");
  const FilmTimes times(options, shown.at("from").get<double>(), shown.at("end").get<double>());
  const Draft draft(file);
  PipedProgram ffmpeg(ffmpeg_spec(programs.ffmpeg, options.fps.value_or(kUsualFps), draft.path(), scratch.path()),
                      signals);
  for (std::size_t i = 0; i < times.size(); ++i) {
    browser.evaluate("film.show(" + Json(times[i]).dump() + ")");
    const std::vector<std::uint8_t> picture = browser.picture();
    ffmpeg.write({reinterpret_cast<const char*>(picture.data()), picture.size()});
    show_progress(console, i + 1, times.size());
  }
  const ExitStatus exit = ffmpeg.finish();
  if (!exit.ok()) {
    throw std::runtime_error("ffmpeg ended with " + exit.text() + last_lines_below(scratch.path() / "ffmpeg.log", 8));
  }
  browser.close();
  draft.keep();
}

}  // namespace skein::cli
