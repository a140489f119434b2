#include "gui/views/theme.h"

#include <filesystem>
#include <utility>

namespace spacetime::gui {
namespace {

ImVec4 rgb(unsigned hex) {
  return {static_cast<float>(hex >> 16 & 255U) / 255, static_cast<float>(hex >> 8 & 255U) / 255,
          static_cast<float>(hex & 255U) / 255, 1};
}

ImFont* font(const char* file, float pixels) {
  // Latin, Greek, and the punctuation and arrows that we write.
  static const ImWchar glyphs[] = {0x20, 0xff, 0x370, 0x3ff, 0x2010, 0x2044, 0x2190, 0x2193, 0x2200, 0x22ff, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (!std::filesystem::exists(file)) return nullptr;
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  return atlas.AddFontFromFileTTF(file, pixels, &config, glyphs);
}

}  // namespace

Fonts load_fonts(float scale) {
  Fonts fonts;
  fonts.text = font("/usr/share/fonts/opentype/inter/Inter-Regular.otf", 15 * scale);
  if (!fonts.text) fonts.text = font("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", 14 * scale);
  if (!fonts.text) {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    fonts.text = ImGui::GetIO().Fonts->AddFontDefault(&config);
  }
  fonts.strong = font("/usr/share/fonts/opentype/inter/Inter-SemiBold.otf", 15 * scale);
  fonts.code = font("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", 13 * scale);
  if (!fonts.strong) fonts.strong = fonts.text;
  if (!fonts.code) fonts.code = fonts.text;
  return fonts;
}

Colours colours_of(bool dark) {
  if (dark)
    return {.ground = rgb(0x1b1e23),
            .panel = rgb(0x23272e),
            .raised = rgb(0x30353e),
            .line = rgb(0x3a404a),
            .text = rgb(0xe4e6ea),
            .faint = rgb(0x98a0ad),
            .accent = rgb(0x4c9be8),
            .good = rgb(0x5fbf87),
            .warning = rgb(0xe0a94a),
            .bad = rgb(0xef6f6c),
            .curves = {rgb(0x56b4e9), rgb(0xe69f00), rgb(0x3cc39a), rgb(0xe58fc0), rgb(0xf0e442), rgb(0xf07b3f),
                       rgb(0x8aa2ff), rgb(0xc8ccd4)}};
  return {.ground = rgb(0xe9ebee),
          .panel = rgb(0xf7f8f9),
          .raised = rgb(0xe3e6ea),
          .line = rgb(0xc9ced6),
          .text = rgb(0x22262c),
          .faint = rgb(0x606975),
          .accent = rgb(0x1f6fbf),
          .good = rgb(0x21804c),
          .warning = rgb(0x9a6500),
          .bad = rgb(0xc0322f),
          .curves = {rgb(0x0072b2), rgb(0xb87400), rgb(0x00805c), rgb(0xb04f86), rgb(0x857a00), rgb(0xc04a00),
                     rgb(0x4a56c0), rgb(0x555b66)}};
}

void apply(const Colours& p, float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  style.WindowPadding = {10, 8};
  style.FramePadding = {8, 4};
  style.CellPadding = {6, 3};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowBorderSize = 1;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameRounding = style.GrabRounding = style.TabRounding = style.ScrollbarRounding = 4;
  style.PopupRounding = style.WindowRounding = style.ChildRounding = 6;
  style.ScaleAllSizes(scale);
  const auto with = [](ImVec4 colour, float alpha) {
    colour.w = alpha;
    return colour;
  };
  const std::pair<ImGuiCol, ImVec4> table[]{
      {ImGuiCol_Text, p.text},
      {ImGuiCol_TextDisabled, p.faint},
      {ImGuiCol_WindowBg, p.ground},
      {ImGuiCol_ChildBg, p.panel},
      {ImGuiCol_PopupBg, p.panel},
      {ImGuiCol_Border, p.line},
      {ImGuiCol_FrameBg, p.raised},
      {ImGuiCol_FrameBgHovered, with(p.accent, 0.25F)},
      {ImGuiCol_FrameBgActive, with(p.accent, 0.35F)},
      {ImGuiCol_MenuBarBg, p.ground},
      {ImGuiCol_TitleBg, p.panel},
      {ImGuiCol_TitleBgActive, p.panel},
      {ImGuiCol_ScrollbarBg, with(p.panel, 0)},
      {ImGuiCol_ScrollbarGrab, p.line},
      {ImGuiCol_ScrollbarGrabHovered, p.faint},
      {ImGuiCol_ScrollbarGrabActive, p.faint},
      {ImGuiCol_CheckMark, p.accent},
      {ImGuiCol_SliderGrab, p.accent},
      {ImGuiCol_SliderGrabActive, p.accent},
      {ImGuiCol_Button, p.raised},
      {ImGuiCol_ButtonHovered, with(p.accent, 0.35F)},
      {ImGuiCol_ButtonActive, with(p.accent, 0.55F)},
      {ImGuiCol_Header, with(p.accent, 0.22F)},
      {ImGuiCol_HeaderHovered, with(p.accent, 0.30F)},
      {ImGuiCol_HeaderActive, with(p.accent, 0.40F)},
      {ImGuiCol_Separator, p.line},
      {ImGuiCol_Tab, with(p.panel, 0)},
      {ImGuiCol_TabHovered, with(p.accent, 0.30F)},
      {ImGuiCol_TabActive, with(p.accent, 0.22F)},
      {ImGuiCol_TableHeaderBg, p.panel},
      {ImGuiCol_TableBorderLight, p.line},
      {ImGuiCol_TableBorderStrong, p.line},
      {ImGuiCol_TableRowBgAlt, with(p.text, 0.03F)},
      {ImGuiCol_TextSelectedBg, with(p.accent, 0.35F)},
      {ImGuiCol_NavHighlight, p.accent},
      {ImGuiCol_ModalWindowDimBg, with(p.ground, 0.6F)},
  };
  for (const auto& [which, colour] : table) style.Colors[which] = colour;
}

ImU32 packed(const ImVec4& colour, float opacity) {
  ImVec4 c = colour;
  c.w *= opacity;
  return ImGui::ColorConvertFloat4ToU32(c);
}

}  // namespace spacetime::gui
