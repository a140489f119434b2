#include "gui/views/texts.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string_view>

#include "gui/words.h"

namespace spacetime::gui {
namespace {

const Diagnostic* mistake_in(const std::vector<Diagnostic>& mistakes, int line) {
  const auto found = std::ranges::find_if(mistakes, [&](const Diagnostic& d) { return d.span.line == line; });
  return found == mistakes.end() ? nullptr : &*found;
}

// `statement`: that which begins there, if one does.
void draw_line(Ui& ui, std::string_view line, int number, const Statement* statement, const Diagnostic* mistake) {
  const Colours& colours = ui.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const float digit = ImGui::CalcTextSize("0").x;  // all letters are as wide
  // What is scrolled away takes its room.
  const ImVec2 room{4 * digit + ui.scaled(10) + digit * static_cast<float>(line.size()), height};
  if (!mistake && ui.memory.scroll_to_line != number && !ImGui::IsRectVisible(room)) return ImGui::Dummy(room);
  if (statement && !statement->name.empty() && statement->name == ui.state.selection.constraint)
    list.AddRectFilled({at.x - 4, at.y - 1}, {at.x + width, at.y + height + 1}, packed(colours.accent, 0.18F), 3);
  if (ui.memory.scroll_to_line == number) {
    ImGui::SetScrollHereY(0.4F);
    ui.memory.scroll_to_line = 0;
  }
  ImGui::TextDisabled("%3d", number);
  ImGui::SameLine(0, ui.scaled(10));
  // Comments stand back; the word a statement begins with stands out.
  const std::size_t comment = std::min(line.find('#'), line.size());
  std::string_view code = line.substr(0, comment);
  const float gap = 0;
  if (statement && code.find(statement->word) == code.find_first_not_of(' ')) {
    const std::size_t end = code.find(statement->word) + statement->word.size();
    ImGui::PushStyleColor(ImGuiCol_Text, colours.accent);
    ImGui::TextUnformatted(code.data(), code.data() + end);
    ImGui::PopStyleColor();
    ImGui::SameLine(0, gap);
    code = code.substr(end);
  }
  ImGui::TextUnformatted(code.data(), code.data() + code.size());
  if (comment < line.size()) {
    ImGui::SameLine(0, gap);
    ImGui::PushStyleColor(ImGuiCol_Text, colours.faint);
    ImGui::TextUnformatted(line.data() + comment, line.data() + line.size());
    ImGui::PopStyleColor();
  }
  if (mistake) {
    const float left = at.x + 3 * digit + ui.scaled(10) + static_cast<float>(mistake->span.column - 1) * digit;
    const float right = left + static_cast<float>(std::max(1, mistake->span.length)) * digit, y = at.y + height;
    for (float x = left; x < right; x += 4)
      list.AddLine({x, y + 1}, {std::min(x + 2, right), y - 1}, packed(colours.bad), 1.5F);
    ImGui::PushFont(ui.memory.fonts.text);
    ImGui::PushStyleColor(ImGuiCol_Text, colours.bad);
    ImGui::Indent(left - at.x);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(mistake->message.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Unindent(left - at.x);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ui.here(fmt::format("mistake {}", number));
  }
}

// In the font that is set.
LogLine line_of(const Entry& entry, bool first, float width) {
  LogLine line;
  line.number = entry.number;
  line.motion = entry.motion;
  line.length = entry.text.size();
  line.width = width;
  // What came of it first; the line may be long.
  line.text = first ? "the scene as it was opened" : in_one_line(entry.text);
  if (!first && entry.motion && entry.iterated)
    line.text = fmt::format("{}, {}:  {}", name_of(entry.motion->status), shown(entry.motion->objective), line.text);
  line.height = ImGui::CalcTextSize(line.text.c_str(), nullptr, false, width).y;
  return line;
}

}  // namespace

void draw_text(Ui& ui) {
  const State& s = ui.state;
  ui.notices(Notice::Place::scene_text);
  if (!s.scene) {
    ImGui::TextDisabled("No scene is open.");
    return;
  }
  if (!s.scene->problem && !s.scene->diagnostics.empty())
    ImGui::TextWrapped("Correct it in an editor: the file is read again when it is saved.");
  ImGui::PushFont(ui.memory.fonts.code);
  ImGui::BeginChild("text", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
  int number = 0;
  std::string_view rest = s.scene->text;
  auto statement = s.scene->outline.begin();  // they stand in the order of their lines
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    ++number;
    while (statement != s.scene->outline.end() && statement->line < number) ++statement;
    const bool begins = statement != s.scene->outline.end() && statement->line == number;
    draw_line(ui, rest.substr(0, end), number, begins ? &*statement : nullptr,
              mistake_in(s.scene->diagnostics, number));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  ImGui::EndChild();
  ImGui::PopFont();
}

void draw_log(Ui& ui) {
  const State& s = ui.state;
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours().faint);
  ImGui::TextWrapped("Every act is a line of the scene. Click one to go back to it.");
  ImGui::PopStyleColor();
  ImGui::BeginChild("entries");
  const float width = ImGui::GetContentRegionAvail().x;
  const bool grown = ui.memory.log_lines.size() < s.log.size();
  ui.memory.log_lines.resize(s.log.size());
  for (std::size_t i = 0; i < s.log.size(); ++i) {
    const Entry& entry = s.log[i];
    const bool future = static_cast<int>(i) > s.present, here = static_cast<int>(i) == s.present;
    ImGui::PushFont(i == 0 ? ui.memory.fonts.text : ui.memory.fonts.code);
    LogLine& line = ui.memory.log_lines[i];
    if (line.number != entry.number || line.motion != entry.motion || line.length != entry.text.size() ||
        line.width != width)
      line = line_of(entry, i == 0, width);
    const ImVec2 at = ImGui::GetCursorScreenPos(), room{width, line.height};
    if (!ImGui::IsRectVisible(room)) {
      ImGui::Dummy(room);
      ImGui::PopFont();
      if (here && grown) ImGui::SetScrollHereY(1);
      continue;
    }
    if (ImGui::Selectable(fmt::format("##entry {}", i).c_str(), here, 0, room) && entry.checkpoint)
      ui.emit(GoTo{static_cast<int>(i)});
    ui.control(fmt::format("entry {}", i),
               (future ? "Undone: click to redo up to here.\n" : "Click to go back to here.\n") + line.text);
    ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at,
                                        packed(future ? ui.colours().faint : ui.colours().text), line.text.c_str(),
                                        nullptr, width);
    ImGui::PopFont();
    if (here && grown) ImGui::SetScrollHereY(1);
  }
  for (const std::string& line : s.script) {
    ImGui::TextDisabled("to do: %s", line.c_str());
    ui.help("The file asks for this: Run performs it.");
  }
  ImGui::EndChild();
}

void draw_console(Ui& ui) {
  Memory& m = ui.memory;
  ImGui::PushFont(m.fonts.code);
  const float below = 2 * ImGui::GetFrameHeightWithSpacing() + ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("answers", {0, -below});
  for (const ConsoleLine& line : ui.state.console) {
    ImGui::TextColored(ui.colours().accent, "> %s", line.asked.c_str());
    ImGui::PushStyleColor(ImGuiCol_Text, line.wrong ? ui.colours().bad : ui.colours().text);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(line.waiting ? "..." : line.answer.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }
  if (ui.state.console.empty())
    ImGui::TextDisabled("Ask for an expression of the scene:\n  arm.elbow.force\nor its derivative by something.");
  if (!ui.state.console.empty() && ui.state.console.back().waiting) ImGui::SetScrollHereY(1);
  ImGui::EndChild();
  ImGui::SetNextItemWidth(-1);
  bool asked = ImGui::InputTextWithHint("##expression", "expression", &m.console, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.control("console", "An expression over the names of the scene; Enter asks.");
  ImGui::SetNextItemWidth(-ui.scaled(60));
  asked |= ImGui::InputTextWithHint("##by", "differentiate by (optional)", &m.console_by,
                                    ImGuiInputTextFlags_EnterReturnsTrue);
  ui.control("console by", "A degree of freedom, a parameter or a constant: its partial derivative is asked for.");
  ImGui::SameLine();
  asked |= ImGui::Button("Ask", {-1, 0});
  ui.control("ask", "Print it, evaluate it, and count its operations.");
  ImGui::PopFont();
  ui.notices(Notice::Place::console);
  if (!asked || m.console.empty()) return;
  ui.emit(Ask{m.console, m.console_by});
  m.console.clear();
}

}  // namespace spacetime::gui
