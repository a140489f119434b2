// How tokens stand beside one another on a line, and where a line may be broken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "symbolic/lexer.h"
#include "symbolic/scene.h"

namespace spacetime::symbolic {

// What the tree knows of a token that its text does not say.
enum class Role : std::uint8_t {
  plain,
  operand,  // a name or a member inside an expression
  call,     // a name with its arguments behind it
  sign,     // a + or - with nothing on its left
  clause,   // the word that begins a scope, a condition or a weight
};

struct Piece {
  Token token;
  Role role = Role::plain;
  int depth = 0;  // of ( ) and [ ] around it
};

// The tokens that carry meaning: without the end and without the line ends inside brackets, which count for nothing.
// `kept` gives for every token the piece it is, or the one that follows it.
struct Pieces {
  std::vector<Piece> pieces;
  std::vector<std::size_t> kept;
};
Pieces pieces_of(const std::vector<Token>& tokens, const Scene& scene);

bool is_separator(const Piece& piece);

// Spaces between neighbours on one line.
std::size_t gap(const Piece& left, const Piece& right);

// The characters of pieces on one line.
std::size_t width(std::span<const Piece> pieces);
std::string joined(std::span<const Piece> pieces);

// How willingly a line is broken behind a piece, the loosest bond first (lowest); none where it must not be.  Outside
// brackets only what makes a line go on can end one.
std::optional<int> bond(const Piece& left);

}  // namespace spacetime::symbolic
