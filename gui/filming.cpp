#include "gui/filming.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <vector>

#include "common/diagnostic.h"
#include "common/files.h"

namespace spacetime::gui {
namespace {

// What `render` says last, without the marks that overwrite a line on a terminal.
std::string last_line(const std::string& said) {
  std::string text = said;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t begin = text.find_last_of("\r\n");
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

}  // namespace

Filming::~Filming() { stop(); }

void Filming::stop() {
  if (const int process = process_; process > 0) ::kill(process, SIGTERM);
  if (thread_.joinable()) thread_.join();
  process_ = 0;
}

void Filming::perform(const MakeFilm& effect) {
  stop();
  const std::string motion_file =
      std::filesystem::temp_directory_path() / fmt::format("spacetime-{}.motion.json", getpid());
  std::array<int, 2> pipe{};
  try {
    write_text(motion_file, *effect.motion);
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw InputError("no pipes are left");
  } catch (const InputError& error) {
    return post_(Filmed{effect.file, error.what(), Filmed::What::failed});
  }
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "spacetime-gui";
  const std::string rate = fmt::format("{}", effect.rate);
  const std::string poses = fmt::format("{}", effect.strip);
  const std::string theme = effect.dark ? "dark" : "light";
  std::vector<const char*> arguments{self.c_str(),        "render",  motion_file.c_str(), "-o",
                                     effect.file.c_str(), "--theme", theme.c_str()};
  if (effect.strip > 0) {
    arguments.insert(arguments.end(), {"--strip", poses.c_str()});
  } else {
    arguments.insert(arguments.end(), {"--rate", rate.c_str()});
  }
  arguments.push_back(nullptr);
  const int child = ::fork();
  if (child < 0) {
    ::close(pipe[0]);
    ::close(pipe[1]);
    return post_(Filmed{effect.file, "no process can be started", Filmed::What::failed});
  }
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::dup2(pipe[1], STDERR_FILENO);
    ::execv(self.c_str(), const_cast<char**>(arguments.data()));
    ::_exit(127);
  }
  process_ = child;
  ::close(pipe[1]);
  thread_ = std::thread([this, output = pipe[0], process = child, motion_file, file = effect.file] {
    watch(output, process, motion_file, file);
  });
}

void Filming::watch(int output, int process, const std::string& motion_file, const std::string& file) {
  std::string said;
  std::array<char, 4096> block{};
  while (true) {
    const ssize_t bytes = ::read(output, block.data(), block.size());
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes <= 0) break;
    said.append(block.data(), static_cast<std::size_t>(bytes));
    if (said.size() > block.size()) said.erase(0, said.size() - block.size());
    post_(Filmed{file, last_line(said), Filmed::What::progress});
  }
  ::close(output);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  std::error_code none;
  std::filesystem::remove(motion_file, none);
  const bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  post_(Filmed{file, last_line(said), done ? Filmed::What::done : Filmed::What::failed});
}

}  // namespace spacetime::gui
