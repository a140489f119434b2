#include "gui/render/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/assert.h"
#include "common/diagnostic.h"

extern char** environ;

namespace spacetime::gui {

FilmFile::FilmFile(std::string file, int width, int height, double frames_per_second)
    : file_(std::move(file)), beside_(file_ + ".part") {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  // Pictures of odd size are widened by a pixel, which the format asks for.
  std::vector<std::string> words{"ffmpeg",
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pix_fmt",
                                 "rgba",
                                 "-s",
                                 size,
                                 "-r",
                                 std::to_string(frames_per_second),
                                 "-i",
                                 "-",
                                 "-an",
                                 "-vf",
                                 "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                 "-c:v",
                                 "libx264",
                                 "-pix_fmt",
                                 "yuv420p",
                                 "-crf",
                                 "18",
                                 "-movflags",
                                 "+faststart",
                                 "-f",
                                 "mp4",
                                 "file:" + beside_};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError(std::string("no pipe to ffmpeg: ") + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C is for us: we then end the film in order
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (failed != 0) {
    process_ = -1;
    close(pipe_);
    throw InputError("a film is made by ffmpeg, which cannot be started (" + std::string(std::strerror(failed)) +
                     "): install the package ffmpeg, or write pictures: -o 'frames/%04d.png'");
  }
  std::signal(SIGPIPE, SIG_IGN);  // where ffmpeg gives up, writing tells
}

FilmFile::~FilmFile() {
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  end();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

int FilmFile::end() {
  close(pipe_);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

void FilmFile::add(const Image& picture) {
  SPACETIME_ASSERT(process_ >= 0);
  for (std::size_t done = 0; done < picture.rgba.size();) {
    const ssize_t written = write(pipe_, picture.rgba.data() + done, picture.rgba.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw InputError("ffmpeg cannot write '" + file_ + "'; it says why above");
    done += static_cast<std::size_t>(written);
  }
}

void FilmFile::finish() {
  if (end() != 0) throw InputError("ffmpeg cannot write '" + file_ + "'; it says why above");
  std::error_code failed;
  std::filesystem::rename(beside_, file_, failed);
  if (failed) throw InputError("'" + file_ + "' cannot be written: " + failed.message());
}

}  // namespace spacetime::gui
