#include "common/diagnostic.h"

#include <algorithm>

namespace spacetime {
namespace {

constexpr std::size_t longest_line = 100;  // characters of scene text shown; a longer line is cut around the span
constexpr std::size_t context = 20;        // characters kept before the span of a cut line
constexpr std::string_view cut = "...";

// Line `number` of the text, counted from 1; empty where it has no such line.
std::string_view line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const auto end = text.find('\n');
    if (end == text.npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

// Takes the first character (UTF-8 code point) away.  Bytes that continue no character stay with the one before them.
std::string_view take_character(std::string_view& text) {
  constexpr std::size_t longest = 4;  // bytes
  std::size_t size = 1;
  while (size < std::min(longest, text.size()) && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) ++size;
  const std::string_view character = text.substr(0, size);
  text.remove_prefix(size);
  return character;
}

bool is_control(std::string_view character) {
  const auto byte = static_cast<unsigned char>(character.front());
  return byte != '\t' && (byte < 0x20 || byte == 0x7F);
}

// The line and, below it, the mark.  The mark's line repeats the text's tabs, so that both are as wide.
void excerpt(std::string& out, const Span& span, std::string_view text) {
  const std::string_view line = line_of(text, span.line);
  if (line.empty() || span.column < 1) return;
  // What stands far behind the span is not counted: a line may be as long as a file.
  const std::size_t last = static_cast<std::size_t>(span.column) + 2 * longest_line;
  std::size_t size = 0;
  for (std::string_view rest = line; !rest.empty() && size < last; ++size) take_character(rest);
  const std::size_t begin = std::min<std::size_t>(span.column - 1, size);  // one past the last: a missing end
  const std::size_t room = std::max<std::size_t>(size - begin, 1);
  std::size_t length = std::min<std::size_t>(std::max(span.length, 1), room);

  std::size_t from = 0, to = size;
  if (size > longest_line) {
    from = std::min(begin > context ? begin - context : 0, size - longest_line);
    to = from + longest_line;
    length = std::min(length, std::max<std::size_t>(to - begin, 1));
  }
  std::string mark;
  if (from > 0) {
    out += cut;
    mark.append(cut.size(), ' ');
  }
  std::string_view rest = line;
  for (std::size_t i = 0; i < from; ++i) take_character(rest);
  for (std::size_t i = from; i < to; ++i) {
    const std::string_view character = take_character(rest);
    if (is_control(character)) {
      out += "\uFFFD";  // an escape sequence in a scene must not reach the terminal
    } else {
      out += character;
    }
    if (i < begin) mark += character == "\t" ? '\t' : ' ';
  }
  if (to < size) out += cut;
  mark += '^';
  mark.append(length - 1, '~');
  out += '\n';
  out += mark;
  out += '\n';
}

void render_one(std::string& out, const Span& span, std::string_view kind, std::string_view message,
                std::string_view file, std::string_view text) {
  out += file;
  if (span.line > 0) {
    out += ':' + std::to_string(span.line);
    if (span.column > 0) out += ':' + std::to_string(span.column);
  }
  out += ": ";
  out += kind;
  out += ": ";
  out += message;
  out += '\n';
  if (span.line > 0) excerpt(out, span, text);
}

}  // namespace

std::string render(const Diagnostic& diagnostic, std::string_view file, std::string_view text) {
  std::string out;
  render_one(out, diagnostic.span, "error", diagnostic.message, file, text);
  for (const auto& note : diagnostic.notes) render_one(out, note.span, "note", note.message, file, text);
  return out;
}

}  // namespace spacetime
