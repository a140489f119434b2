// What could stand at a place in a text that is being written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spacetime::symbolic {

struct Completion {
  enum class Kind : std::uint8_t {
    keyword,
    function,
    constant,
    parameter,
    dof,
    let,
    argument,  // of the function being defined
    creature,
    script,
    link,
    point,
    member,      // what every creature, scripted body or tuple has
    constraint,  // named constraints and ...
    term,        // ... terms of the objective
  } kind = Kind::keyword;
  std::string label;
  std::string detail;  // how it is written or declared, and what it means
  std::string insert;  // what to put in place of the word at the cursor
};

std::string_view name_of(Completion::Kind kind);

// Everything that could continue the text at a line and column (both from 1; columns count characters; the cursor is in
// front of that one), beginning with the letters there are; in the order of the language's tables, then of the text.
// What stands behind the cursor is not looked at (a text that is too large for a scene not at all), and what stands
// before it may be unfinished or wrong.
std::vector<Completion> complete(std::string_view text, int line, int column);

// What the name there is; nothing where none is known.
std::optional<Completion> describe(std::string_view text, int line, int column);

}  // namespace spacetime::symbolic
