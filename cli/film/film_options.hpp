// What a film of a run shows.
#pragma once

#include <optional>
#include <string>

namespace skein::cli {

/// Options of a film of a run (`skein replay --export FILE.mp4`).
struct FilmOptions {
  std::optional<int> fps;         ///< frames per second
  std::optional<double> seconds;  ///< length of the film
  std::optional<double> speed;    ///< or: simulated seconds per second of the film
  std::string address;            ///< what the page shows: the fragment (after #) of its URL; t is the film's start
  int width = 1280, height = 720;
};

}  // namespace skein::cli
