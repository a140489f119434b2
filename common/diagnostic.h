// A mistake in a scene, or in a document: where it is and what to do about it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace spacetime {

// A span of scene text.  Lines and columns count from 1; columns count characters (code points), not bytes.
struct Span {
  int line = 0, column = 0;  // of the first character
  int length = 1;            // characters on that line
  bool operator==(const Span&) const = default;
};

struct Diagnostic {
  Span span;
  std::string message;  // one sentence: what is wrong and what to do
  struct Note {         // a second place, such as the earlier declaration of the same name
    Span span;
    std::string message;
    bool operator==(const Note&) const = default;
  };
  std::vector<Note> notes;
  bool operator==(const Diagnostic&) const = default;
};

// "file:line:col: error: message", the line of text and a mark under the span, then the notes alike.
std::string render(const Diagnostic& diagnostic, std::string_view file, std::string_view text);

// Malformed input from outside: thrown where it is found, caught once at the edge.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spacetime
