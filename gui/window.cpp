#include "gui/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "common/diagnostic.h"
#include "gui/views/dialogs.h"
#include "gui/views/frame.h"
#include "gui/views/input.h"

namespace spacetime::gui {
namespace {

// Where nothing happens nothing is drawn.  What changes is drawn so often, until hover and fading have settled; a clock
// (a notice that goes) is looked at so rarely.
constexpr int frames_after_change = 30;
constexpr double longest_wait = 0.25;  // s

// Other threads wake the window from before it is there until after it is gone, when GLFW knows nothing of it.
std::mutex waking;
bool can_be_woken = false;

void let_wake(bool on) {
  const std::lock_guard lock(waking);
  can_be_woken = on;
}

// GLFW tells why only to a callback.
std::string last_error;
void take_error(int, const char* text) { last_error = text; }

Input input;
void take_key(GLFWwindow*, int key, int, int action, int modifiers) {
  if (action != GLFW_REPEAT) input.key(key, action == GLFW_PRESS, modifiers);
}
void take_character(GLFWwindow*, unsigned code) { input.character(code); }
void take_button(GLFWwindow* window, int which, int action, int) {
  double x = 0, y = 0;
  glfwGetCursorPos(window, &x, &y);
  input.button(which, action == GLFW_PRESS, {static_cast<float>(x), static_cast<float>(y)});
}

// Everything that lives as long as the window, and ends in the right order.
class Shell {
 public:
  Shell() {
    glfwSetErrorCallback(take_error);
    if (glfwInit() == GLFW_FALSE)
      throw InputError("no window can be opened (" + last_error +
                       "): start it in a graphical session, or use 'spacetime-gui render' for pictures");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window = glfwCreateWindow(1280, 800, "Spacetime", nullptr, nullptr);
    if (!window) {
      glfwTerminate();
      throw InputError("there is no OpenGL 3.3 here (" + last_error +
                       "): install a driver, or libgl1-mesa-dri to draw on the processor");
    }
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    glfwSetKeyCallback(window, take_key);  // ImGui's own, set next, call them first
    glfwSetMouseButtonCallback(window, take_button);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    glfwSetCharCallback(window, take_character);  // in place of ImGui's own, which passes the keys by
    ImGui_ImplOpenGL3_Init("#version 330");
    let_wake(true);
  }
  ~Shell() {
    let_wake(false);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window);
    glfwTerminate();
  }
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  GLFWwindow* window = nullptr;
};

}  // namespace

void wake_window() {
  const std::lock_guard lock(waking);
  if (can_be_woken) glfwPostEmptyEvent();
}

int run_window(Hub& hub, float scale, bool welcome) {
  Shell shell;
  Memory memory;
  if (scale <= 0) {
    float across = 1, down = 1;
    glfwGetWindowContentScale(shell.window, &across, &down);
    scale = across;
  }
  memory.scale = scale;
  memory.fonts = load_fonts(scale);
  memory.welcome = welcome;
  const auto scene = std::make_unique<SceneView>();
  auto before = std::chrono::steady_clock::now();
  int frames_awake = frames_after_change;
  while (!memory.quit) {
    const auto waited_since = std::chrono::steady_clock::now();
    if (frames_awake > 0)
      glfwPollEvents();
    else
      glfwWaitEventsTimeout(longest_wait);
    const auto now = std::chrono::steady_clock::now();
    const bool woken = frames_awake == 0 && std::chrono::duration<double>(now - waited_since).count() < longest_wait;
    frames_awake = std::max(0, frames_awake - 1);
    if (hub.step(std::chrono::duration<double>(now - before).count()) || woken) frames_awake = frames_after_change;
    before = now;
    const State& state = hub.state();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    input.give(ImGui::GetIO(), ImGui::GetIO().MousePos);
    std::vector<Event> events = draw_frame(state, memory, *scene);
    if (glfwWindowShouldClose(shell.window) == GLFW_TRUE) {
      glfwSetWindowShouldClose(shell.window, GLFW_FALSE);
      Ui ui{state, memory, events};
      leave_for(ui, {});
    }
    int width = 0, height = 0;
    glfwGetFramebufferSize(shell.window, &width, &height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    paint(memory, width, height);
    glfwSwapBuffers(shell.window);
    if (!events.empty() || input.waiting() || ImGui::IsAnyMouseDown() || ImGui::IsAnyItemActive())
      frames_awake = frames_after_change;
    for (Event& event : events) hub.post(std::move(event));
  }
  hub.close(memory.discard);
  return 0;
}

}  // namespace spacetime::gui
