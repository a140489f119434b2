#include "symbolic/colour.h"

namespace spacetime::symbolic {
namespace {

// Select graphic rendition (ECMA-48, 8.3.117).
constexpr std::string_view bold = "\x1b[1m", red = "\x1b[1;31m", cyan = "\x1b[1;36m", green = "\x1b[1;32m",
                           plain = "\x1b[0m";

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

void paint(std::string& out, std::string_view colour, std::string_view text) {
  out.append(colour).append(text).append(plain);
}

// One report as `render` writes it: "place: kind: message" and, where there is such a line, the text and the mark.
void paint_report(std::string& out, std::string_view rendered, std::string_view file, std::string_view kind) {
  const std::string_view heading = take_line(rendered);
  const std::size_t place = heading.find(kind, file.size());
  paint(out, bold, heading.substr(0, place));
  paint(out, kind == "error: " ? red : cyan, kind);
  paint(out, bold, heading.substr(place + kind.size()));
  out += '\n';
  if (rendered.empty()) return;
  out.append(take_line(rendered)) += '\n';
  paint(out, green, take_line(rendered));
  out += '\n';
}

}  // namespace

std::string render_coloured(const Diagnostic& diagnostic, std::string_view file, std::string_view text) {
  std::string out;
  paint_report(out, render({diagnostic.span, diagnostic.message, {}}, file, text), file, "error: ");
  for (const Diagnostic::Note& note : diagnostic.notes) {
    // `render` writes a note behind the report it belongs to.
    const std::string before = render({note.span, "", {}}, file, text);
    const std::string both = render({note.span, "", {note}}, file, text);
    paint_report(out, std::string_view(both).substr(before.size()), file, "note: ");
  }
  return out;
}

}  // namespace spacetime::symbolic
