// A film file, made by ffmpeg from pictures one after another.
#pragma once

#include <string>

#include "gui/render/image.h"

namespace spacetime::gui {

class Film {
 public:
  // Starts ffmpeg.  Throws InputError where it is missing or the file cannot be written.
  Film(std::string file, int width, int height, double frames_per_second);
  ~Film();  // what is not finished is thrown away
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void add(const Image& picture);  // of the film's size; throws InputError where ffmpeg has given up
  void finish();                   // only then is there a file; throws InputError

 private:
  int end();  // closes the pipe and waits: ffmpeg's exit code

  std::string file_, beside_;
  int process_ = -1, pipe_ = -1;
};

}  // namespace spacetime::gui
