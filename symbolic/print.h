// Readings on paper: as text of the language, as LaTeX, and the graph itself as a picture.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "symbolic/reading.h"

namespace spacetime::symbolic {

// What the parts and the whole are called.
struct PrintedNames {
  std::string whole;  // a name that can be declared: "arm_force"
  std::string part;   // before the numbers of parts: "s"
};

inline constexpr std::size_t usual_width = 100;  // columns

// Statements of the scene language: a `let` for each part and one for the whole, a tuple where there are several
// components.  Behind the scene they came from they declare what they show, node for node.
std::string print_text(const Reading& reading, const PrintedNames& names, std::size_t width = usual_width);

// An `aligned` environment of amsmath in display mode, ready for a document.  `part` is the letter of the parts.
std::string print_latex(const Reading& reading, const std::string& name, const std::string& part = "s");

// A digraph for Graphviz of the nodes that the values are made of, with their operations as they are shared; operands
// from left to right.
std::string print_dot(Model& model, std::span<const Expr> values, const std::string& title);

}  // namespace spacetime::symbolic
