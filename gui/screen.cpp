#include "gui/screen.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui_internal.h>

#include "gui/views/keys.h"

namespace spacetime::gui {

Screen::Screen(int width, int height, float scale) : target_(width, height, 1) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  map_keys(io);
  memory_.scale = scale;
  memory_.fonts = load_fonts(scale);
  ImGui_ImplOpenGL3_Init("#version 330");
  scene_ = std::make_unique<SceneView>();
}

Screen::~Screen() {
  scene_.reset();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Screen::move(float x, float y) { mouse_ = {x, y}; }

void Screen::button(int which, bool down) { input_.button(which, down, mouse_); }

void Screen::wheel(float by) { ImGui::GetIO().MouseWheel += by; }

void Screen::key(int glfw_key, bool down) { input_.key(glfw_key, down, 0); }

void Screen::type(const std::string& text) {
  for (const char* at = text.c_str(); *at != '\0';) {
    unsigned code = 0;
    at += ImTextCharFromUtf8(&code, at, nullptr);
    input_.character(code);
  }
}

void Screen::finish() { glFinish(); }

std::vector<Event> Screen::frame(const State& state, double seconds) {
  ImGui::GetIO().DeltaTime = static_cast<float>(seconds);
  ImGui_ImplOpenGL3_NewFrame();
  input_.give(ImGui::GetIO(), mouse_);
  const std::vector<Event> events = draw_frame(state, memory_, *scene_);
  target_.bind();
  paint(memory_, target_.width(), target_.height());
  return events;
}

}  // namespace spacetime::gui
