// A film file, made by ffmpeg from pictures one after another.
#pragma once

#include <string>

#include "gui/render/image.h"

namespace spacetime::gui {

class FilmFile {
 public:
  // Starts ffmpeg.  Throws InputError where it is missing or the file cannot be written.
  FilmFile(std::string file, int width, int height, double frames_per_second);
  ~FilmFile();  // what is not finished is thrown away
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  void add(const Image& picture);  // of the film's size; throws InputError where ffmpeg has given up
  void finish();                   // only then is there a file; throws InputError

 private:
  int end();  // closes the pipe and waits: ffmpeg's exit code

  std::string file_, beside_;
  int process_ = -1, pipe_ = -1;
};

}  // namespace spacetime::gui
