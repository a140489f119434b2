#include "protocol/diagnostics_json.h"

namespace spacetime {
namespace {

void write_members(Writer& to, const Span& span, std::string_view message) {
  to.member("line", span.line);
  to.member("column", span.column);
  to.member("length", span.length);
  to.member("message", message);
}

}  // namespace

void write_diagnostics(Writer& to, std::span<const Diagnostic> diagnostics) {
  to.key("diagnostics");
  to.list_of(
      diagnostics,
      [&](const Diagnostic& diagnostic) {
        to.object([&] {
          write_members(to, diagnostic.span, diagnostic.message);
          if (diagnostic.notes.empty()) return;
          to.key("notes");
          to.list_of(diagnostic.notes, [&](const Diagnostic::Note& note) {
            to.object([&] { write_members(to, note.span, note.message); });
          });
        });
      },
      Set::in_lines);
}

std::string write_diagnostics(std::span<const Diagnostic> diagnostics, std::string_view file) {
  Writer to;
  to.object(
      [&] {
        to.member("format", "spacetime-diagnostics/1");
        to.member("file", file);
        write_diagnostics(to, diagnostics);
      },
      Set::in_lines);
  return to.take();
}

}  // namespace spacetime
