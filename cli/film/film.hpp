// Makes a film of a page that contains its flight (view::kept_page): pictures at given simulated times, however long
// the machine takes to draw them, so that the same command makes the same film.   Threads: one.
#pragma once

#include <filesystem>
#include <string>

#include "cli/console.hpp"
#include "cli/film/browser.hpp"
#include "cli/film/film_options.hpp"

namespace skein::cli {

/// Default length of a film, and its default number of frames per second.
inline constexpr double kUsualFilm_s = 30.0;
inline constexpr int kUsualFps = 25;

/// The simulated times of the pictures [s].
class FilmTimes {
 public:
  /// @throws InputError when the flight ends before `from_s`, or there would be too many pictures.
  FilmTimes(const FilmOptions& options, double from_s, double end_s);

  std::size_t size() const { return size_; }
  /// The last one is the end of the flight.
  double operator[](std::size_t picture) const;

 private:
  double from_s_, end_s_, each_s_;
  std::size_t size_;
};

/// The programs that make films. @throws InputError naming the Debian package of one that is missing.
struct FilmPrograms {
  FilmPrograms();
  std::filesystem::path chromium, ffmpeg;
};

/// Writes an MP4 file (H.264), completely or not at all. @param page  HTML of the page.
/// @throws Interrupted; std::runtime_error with what the browser or the encoder said.
void write_film(const FilmPrograms& programs, const std::string& page, const FilmOptions& options,
                const std::filesystem::path& file, const Console& console);

}  // namespace skein::cli
