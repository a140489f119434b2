#include "tests/process/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "protocol/motion_json.h"

namespace spacetime::test {
namespace {

constexpr std::chrono::seconds patience{60};

struct Pipe {
  std::array<int, 2> end{};
  Pipe() {
    if (pipe2(end.data(), O_CLOEXEC) != 0) std::abort();
  }
  void close_end(int which) {
    if (end[which] >= 0) close(end[which]);
    end[which] = -1;
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
};

// Takes what has arrived; false at the end of the stream.
bool drain(int descriptor, std::string& into) {
  std::array<char, 1 << 16> block;
  const auto got = read(descriptor, block.data(), block.size());
  if (got > 0) into.append(block.data(), static_cast<std::size_t>(got));
  return got > 0;
}

}  // namespace

Result run(const std::string& program, const std::vector<std::string>& arguments, const std::string& input,
           const std::string& interrupt_after) {
  signal(SIGPIPE, SIG_IGN);
  Pipe in, out, err;
  const std::string path = std::string(SPACETIME_BIN_DIR) + "/" + program;
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    dup2(in.end[0], 0);
    dup2(out.end[1], 1);
    dup2(err.end[1], 2);
    execv(path.c_str(), argv.data());
    _exit(127);
  }
  in.close_end(0);
  out.close_end(1);
  err.close_end(1);
  fcntl(in.end[1], F_SETFL, O_NONBLOCK);

  Result result;
  std::size_t sent = 0;
  bool interrupted = interrupt_after.empty(), out_open = true, err_open = true;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (out_open || err_open) {
    if (sent == input.size()) in.close_end(1);
    std::array<pollfd, 3> wait{
        {{out_open ? out.end[0] : -1, POLLIN, 0}, {err_open ? err.end[0] : -1, POLLIN, 0}, {in.end[1], POLLOUT, 0}}};
    poll(wait.data(), wait.size(), 100);
    if (wait[0].revents) out_open = drain(out.end[0], result.out);
    if (wait[1].revents) err_open = drain(err.end[0], result.err);
    if (wait[2].revents & POLLERR) {
      sent = input.size();  // the program does not read to the end, as after an error in its arguments
    } else if (wait[2].revents) {
      const auto wrote = ::write(in.end[1], input.data() + sent, input.size() - sent);
      if (wrote > 0) sent += static_cast<std::size_t>(wrote);
    }
    if (!interrupted && result.err.find(interrupt_after) != std::string::npos) {
      interrupted = true;
      kill(child, SIGINT);
    }
    if (std::chrono::steady_clock::now() > deadline) {
      kill(child, SIGKILL);
      break;
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

Result solve_scene(const std::string& scene_text, const std::vector<std::string>& arguments) {
  const Result compiled = run("spacetime-symbolic", {"compile", "-"}, scene_text);
  EXPECT_EQ(compiled.code, 0) << compiled.err;
  std::vector<std::string> all{"solve"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run("spacetime-optimizer", all, compiled.out);
}

std::string text_of(const std::string& path) {
  std::ifstream in(std::string(SPACETIME_SOURCE_DIR) + "/" + path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string scratch(const std::string& name) {
  static const std::string directory = [] {
    std::string pattern = (std::filesystem::temp_directory_path() / "spacetime-XXXXXX").string();
    if (!mkdtemp(pattern.data())) std::abort();
    static struct Remove {
      std::string path;
      ~Remove() { std::filesystem::remove_all(path); }
    } remove{pattern};
    return pattern;
  }();
  return directory + "/" + name;
}

std::string without_seconds(const std::string& motion) {
  Motion read = read_motion(motion);
  read.seconds = {};
  return write(read);
}

}  // namespace spacetime::test
