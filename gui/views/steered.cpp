#include "gui/views/steered.h"

#include <cmath>

namespace spacetime::gui {

void draw_steered(Ui& ui, const SteeredNumber& number, const std::function<Steering(double)>& as) {
  double value = number.value;
  ImGui::SetNextItemWidth(-1);
  ImGui::DragScalar(("##" + number.name).c_str(), ImGuiDataType_Double, &value, static_cast<float>(number.speed),
                    &number.least, &number.most, "%.5g");
  ui.control(number.name, number.help + " Drag it, and the motion follows; click to write a number. Esc goes back.");
  const bool typing = ImGui::IsItemActive() && ImGui::GetIO().WantTextInput;
  const bool usable = std::isfinite(value) && !ui.memory.drag_dropped;
  if (ImGui::IsItemEdited() && !typing && usable) ui.emit(Steer{as(value)});
  if (ImGui::IsItemDeactivatedAfterEdit() && usable) {
    if (!ui.state.steering) ui.emit(Steer{as(value)});
    ui.emit(Steered{true});
  }
}

}  // namespace spacetime::gui
