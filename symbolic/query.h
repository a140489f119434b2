// Asking a scene about its expressions: by name, or by any expression of the language.  The commands `print` and
// `count` ask like this, and a console can.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/diagnostic.h"
#include "symbolic/emit.h"
#include "symbolic/model.h"
#include "symbolic/print.h"

namespace spacetime::symbolic {

// A scene whose statements have been given their meaning, without programs.  Questions may enter new nodes into its
// graph; they do not change what the scene means.
struct Understood {
  Scene scene;
  std::vector<Diagnostic> diagnostics;  // the scene's; nothing can be asked of a scene with mistakes
  Programs programs;
  Model model{scene, programs, diagnostics};
};
std::unique_ptr<Understood> understand(std::string_view text);

struct Answer {
  std::vector<Expr> values;  // a component each
  std::string name;          // that the language could declare: "arm_force_by_arm_elbow"
  std::string what;          // "the joint forces of 'arm'", for lists and titles

  // Where there is no answer: what is wrong, and with which text.
  std::vector<Diagnostic> diagnostics;
  std::string asked;
  explicit operator bool() const { return diagnostics.empty(); }
};

// The expression that `what` names or is.  Names are those of the scene; a constraint's means its residual (zero, or at
// most zero, where it holds), an objective term's the integrand, or all of it where it is not one integral, and a
// constant's what it follows from.  `what` may also be statements `let NAME = ...`, of which the last is meant: so the
// text that print_text gives is a question, too.
// No larger than a scene (largest_scene).
// With `by` (a degree of freedom or a derivative of it, a constant, a parameter): the partial derivative.
Answer query(Understood& scene, std::string_view what, std::string_view by = {});

// Everything with a name that can be printed, in the order of the scene.
struct Printable {
  std::string name, what;
  std::vector<Expr> values;
};
std::vector<Printable> printable(Understood& scene);

// Names for a print of this answer that the scene has not taken.
PrintedNames names_for(const Understood& scene, const Answer& answer);

// How large expressions are.  Functionals count as what they are made of.
struct Sizes {
  Size nodes;  // as a tree, and shared
  // Operations of a program for the values; with the Jacobian by all unknowns; and with the Hessian.
  std::size_t values = 0, jacobian = 0, hessian = 0;
};
Sizes sizes_of(Understood& scene, const std::vector<Expr>& values);

}  // namespace spacetime::symbolic
