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
#include "protocol/problem_json.h"

namespace spacetime::gui {
namespace {

// What `render` says last, without the marks that overwrite a line on a terminal.
std::string last_line(const std::string& said) {
  std::string text = said;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t begin = text.find_last_of("\r\n");
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

std::string motion_file(const std::string& beside) { return beside + ".motion.json"; }
std::string problem_file(const std::string& beside) { return beside + ".problem.json"; }

}  // namespace

Filming::~Filming() {
  stop();
  for (Making& making : makings_) making.thread.join();
}

void Filming::stop() {
  for (Making& making : makings_) {
    const std::lock_guard lock(making.mutex);
    making.stopped = true;
    if (making.process > 0) ::kill(making.process, SIGTERM);
  }
}

void Filming::perform(const MakeFilm& effect) {
  stop();
  for (auto making = makings_.begin(); making != makings_.end();) {
    if (!making->over) {
      ++making;
      continue;
    }
    making->thread.join();
    making = makings_.erase(making);
  }
  Making& making = makings_.emplace_back();
  const std::string name = fmt::format("spacetime-{}-{}", getpid(), ++made_);
  making.thread = std::thread([this, &making, effect, name] {
    std::error_code none;
    const std::string beside = std::filesystem::temp_directory_path(none) / name;
    if (none)
      tell(making, {effect.film.file, "there is no folder for temporary files: TMPDIR", Filmed::What::failed});
    else
      make(making, effect, beside);
    std::filesystem::remove(motion_file(beside), none);
    std::filesystem::remove(problem_file(beside), none);
    making.over = true;
  });
}

void Filming::tell(Making& making, Filmed event) {
  const std::lock_guard lock(making.mutex);
  if (!making.stopped) post_(std::move(event));
}

void Filming::make(Making& making, const MakeFilm& effect, const std::string& beside) {
  const Film& film = effect.film;
  std::array<int, 2> pipe{};
  try {
    write_text(motion_file(beside), *effect.motion);
    if (effect.problem) write_text(problem_file(beside), write(*effect.problem));
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw InputError("no pipes are left");
  } catch (const InputError& error) {
    return tell(making, {film.file, error.what(), Filmed::What::failed});
  }
  std::error_code unknown;  // the program is not started then, and says so
  const std::string self = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "spacetime-gui";
  std::vector<std::string> words{self,      "render",  motion_file(beside),           "-o",
                                 film.file, "--theme", effect.dark ? "dark" : "light"};
  if (effect.problem) words.push_back("--problem=" + problem_file(beside));
  if (!film.camera.empty()) words.push_back("--camera=" + film.camera);
  if (film.width > 0) words.push_back(fmt::format("--size={}x{}", film.width, film.height));
  if (film.span) words.push_back(fmt::format("--from={}", film.span->first));
  if (film.span) words.push_back(fmt::format("--to={}", film.span->second));
  words.push_back(film.strip > 0 ? fmt::format("--strip={}", film.strip) : fmt::format("--rate={}", film.rate));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int child = -1;
  {
    const std::lock_guard lock(making.mutex);
    if (!making.stopped) child = ::fork();
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // with this thread, which waits for it
      ::dup2(pipe[1], STDERR_FILENO);
      ::execv(self.c_str(), arguments.data());
      ::_exit(127);
    }
    if (child > 0) making.process = child;
  }
  ::close(pipe[1]);
  if (child < 0) {
    ::close(pipe[0]);
    return tell(making, {film.file, "no process can be started", Filmed::What::failed});
  }
  std::string said;
  std::array<char, 4096> block{};
  while (true) {
    const ssize_t bytes = ::read(pipe[0], block.data(), block.size());
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes <= 0) break;
    said.append(block.data(), static_cast<std::size_t>(bytes));
    if (said.size() > block.size()) said.erase(0, said.size() - block.size());
    tell(making, {film.file, last_line(said), Filmed::What::progress});
  }
  ::close(pipe[0]);
  // It ends, and its number stays its own until it has been waited for.
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) continue;
  int status = 0;
  {
    const std::lock_guard lock(making.mutex);
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    making.process = 0;
  }
  const bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  tell(making, {film.file, last_line(said), done ? Filmed::What::done : Filmed::What::failed});
}

}  // namespace spacetime::gui
