#include "gui/screen.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

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

void Screen::move(float x, float y) { ImGui::GetIO().MousePos = {x, y}; }

void Screen::button(int which, bool down) { ImGui::GetIO().MouseDown[which] = down; }

void Screen::wheel(float by) { ImGui::GetIO().MouseWheel += by; }

void Screen::key(int glfw_key, bool down) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeysDown[glfw_key] = down;
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT];
  io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT];
}

void Screen::type(const std::string& text) { ImGui::GetIO().AddInputCharactersUTF8(text.c_str()); }

void Screen::finish() { glFinish(); }

std::vector<Event> Screen::frame(const State& state, double seconds) {
  ImGui::GetIO().DeltaTime = static_cast<float>(seconds);
  ImGui_ImplOpenGL3_NewFrame();
  const std::vector<Event> events = draw_frame(state, memory_, *scene_);
  target_.bind();
  paint(memory_, target_.width(), target_.height());
  return events;
}

}  // namespace spacetime::gui
