// The words of the language, one row each: what they begin, where they stand, what they mean.  Errors, completion and
// the editors' grammar take them from here; a test compares them with what the parser accepts.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace spacetime::symbolic {

struct Word {
  enum class Kind : std::uint8_t {
    declaration,
    action,
    item,    // begins an item of a block
    clause,  // goes on with a statement or an item
  } kind = Kind::clause;
  std::string_view word;
  std::string_view of;  // the words of statements and items it belongs to, with a space between: "dof parameter bound"
  std::string_view usage;
  std::string_view meaning;
};

std::span<const Word> vocabulary();

// Whether the word belongs to statements or items that begin with `owner`.
bool belongs_to(const Word& word, std::string_view owner);

// Whether a statement may begin with it.
bool begins_statement(std::string_view text);

}  // namespace spacetime::symbolic
