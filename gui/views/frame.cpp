#include "gui/views/frame.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include "gui/views/layout.h"

namespace spacetime::gui {

std::vector<Event> draw_frame(const State& state, Memory& memory, SceneView& scene) {
  if (memory.dark != state.dark) {
    memory.dark = state.dark;
    memory.colours = colours_of(state.dark);
    apply(memory.colours, memory.scale);
  }
  std::vector<Event> events;
  Ui ui{state, memory, events};
  ImGui::GetIO().ConfigDragClickToInputText = true;
  ImGui::NewFrame();
  draw_window(ui, scene);
  ImGui::Render();
  return events;
}

void paint(const Memory& memory, int width, int height) {
  const ImVec4& ground = memory.colours.ground;
  glViewport(0, 0, width, height);
  glClearColor(ground.x, ground.y, ground.z, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace spacetime::gui
