#include "symbolic/vocabulary.h"

#include <algorithm>
#include <array>

namespace spacetime::symbolic {
namespace {

using Kind = Word::Kind;

constexpr auto declaration = Kind::declaration;
constexpr auto action = Kind::action;
constexpr auto item = Kind::item;
constexpr auto clause = Kind::clause;

constexpr auto table = std::to_array<Word>({
    {declaration, "time", "", "time [a, b]", "the animation's span, in seconds"},
    {declaration, "constant", "", "constant NAME = expr", "a number that can be set without compiling again"},
    {declaration, "parameter", "", "parameter NAME = start [in [lo, hi]]",
     "one unknown number, chosen by the optimizer"},
    {declaration, "trajectory", "", "trajectory bspline spans N [for names]", "the basis of degrees of freedom"},
    {declaration, "dof", "", "dof NAME [= start] [in [lo, hi]]", "a degree of freedom"},
    {declaration, "let", "", "let NAME = expr", "a named expression, plotted by its name"},
    {declaration, "define", "", "define NAME(x, y) = expr", "a function of one's own"},
    {declaration, "eliminate", "", "eliminate DOF = expr", "replaces a degree of freedom by an expression"},
    {declaration, "creature", "", "creature NAME { ... }", "a linkage"},
    {declaration, "script", "", "script NAME { ... }", "a scripted body"},
    {declaration, "constrain", "", "constrain [NAME:] relation [scope] [when condition] [weight w]", "what must hold"},
    {declaration, "minimize", "", "minimize [NAME:] functional [weight w]", "a term of the objective"},
    {declaration, "keyframe", "", "keyframe time: name = value, ...", "a sketch to start from"},

    {action, "solve", "", "solve [method m] [iterations n] [tolerance e] [starts n]", "iterates to convergence"},
    {action, "iterate", "", "iterate n", "so many iterations and no more"},
    {action, "window", "", "window [a, b] [of names]", "the part of spacetime that is free"},
    {action, "refine", "", "refine [a, b] [of names] [times n]", "halves knot spans"},
    {action, "shake", "", "shake amplitude a [seed n] [of names]", "perturbs the motion"},
    {action, "filter", "", "filter strength s [of names]", "smooths the motion"},
    {action, "damp", "", "damp limit [of names]", "bounds the change an iteration may make"},
    {action, "adapt", "", "adapt tolerance e [levels n]", "lets wavelets come and go"},
    {action, "lock", "", "lock level n", "keeps the coarser wavelets fixed"},
    {action, "set", "", "set CONSTANT = expr", "changes a constant"},
    {action, "weight", "", "weight NAME = w", "changes the weight of a constraint or an objective term"},
    {action, "enable", "", "enable NAME", "lets a constraint or an objective term count again"},
    {action, "disable", "", "disable NAME", "lets a constraint or an objective term count no more"},
    {action, "delete", "", "delete NAME", "takes a constraint or an objective term away"},
    {action, "replace", "", "replace NAME: ...", "restates a constraint or an objective term"},
    {action, "scope", "", "scope NAME at times | over [a, b]", "changes the times of a constraint"},
    {action, "bound", "", "bound DOF in [lo, hi]", "changes the bounds of a degree of freedom"},
    {action, "key", "", "key time: name = value, ...", "pulls the motion through new keys"},
    {action, "control", "", "control DOF i = v", "moves one coefficient"},
    {action, "reset", "", "reset", "back to the sketch"},

    {item, "gravity", "creature", "gravity (x, y, z)", "acceleration of free fall"},
    {item, "link", "creature", "link NAME [on PARENT] { joint; geometry; mass }", "a rigid body behind a joint"},
    {item, "point", "creature", "point NAME on LINK (x, y, z)", "a named point of a link"},
    {item, "force", "creature", "force on POINT = (fx, fy, fz)", "an outside force"},
    {item, "revolute", "link", "revolute DOF [= start] [in [lo, hi]]", "a joint that turns about z"},
    {item, "prismatic", "link", "prismatic DOF [= start] [in [lo, hi]]", "a joint that slides along z"},
    {item, "fixed", "link", "fixed", "no joint"},
    {item, "offset", "link", "offset x", "added to the joint's coordinate"},
    {item, "a", "link", "a x", "Denavit-Hartenberg: length along x"},
    {item, "alpha", "link", "alpha x", "Denavit-Hartenberg: angle about x"},
    {item, "d", "link", "d x", "Denavit-Hartenberg: length along z"},
    {item, "theta", "link", "theta x", "Denavit-Hartenberg: angle about z"},
    {item, "axis", "link", "axis (x, y, z)", "the joint's axis in the parent's frame"},
    {item, "origin", "link", "origin (x, y, z)", "the joint's place in the parent's frame"},
    {item, "mass", "link", "mass m", "in kilograms"},
    {item, "com", "link", "com (x, y, z)", "the centre of mass in the link's frame"},
    {item, "inertia", "link", "inertia (ixx, iyy, izz[, ixy, ixz, iyz])", "about the centre of mass"},
    {item, "rod", "link", "rod [(x, y, z)]", "spreads the mass over a thin rod"},
    {item, "capsule", "link", "capsule r", "a shape to draw"},
    {item, "sphere", "link", "sphere r", "a shape to draw"},
    {item, "box", "link", "box (x, y, z)", "a shape to draw"},
    {item, "path", "script", "path [through] [p0, p1, ...] [knots [...]]", "where a scripted body goes"},
    {item, "travel", "script", "travel [(t, s), ...] [relative] | control [...] | constant", "how far, when"},
    {item, "orient", "script", "orient [(t, (w, x, y, z)), ...] | along up (x, y, z)", "how it turns"},

    {clause, "in", "dof parameter bound revolute prismatic", "in [lo, hi]", "bounds"},
    {clause, "bspline", "trajectory", "bspline spans N | knots [...]", "a cubic B-spline"},
    {clause, "wavelet", "trajectory", "wavelet level L", "B-spline wavelets"},
    {clause, "spans", "trajectory", "spans N", "so many even spans"},
    {clause, "knots", "trajectory path travel", "knots [u0, u1, ...]", "distinct breakpoints"},
    {clause, "level", "trajectory lock", "level n", "of wavelets: 2^n spans"},
    {clause, "for", "trajectory", "for names", "of these degrees of freedom"},
    {clause, "at", "constrain replace scope", "at t1, t2, ...", "at these times"},
    {clause, "over", "constrain replace scope", "over [a, b] [every h | count n]", "over this time"},
    {clause, "every", "constrain replace scope", "every h", "a, a + h, ..., and b"},
    {clause, "count", "constrain replace scope", "count n", "so many times, evenly spaced"},
    {clause, "when", "constrain replace", "when condition", "only while this holds"},
    {clause, "weight", "constrain minimize replace", "weight w", "makes it soft, or a term count more"},
    {clause, "inf", "constrain minimize replace weight", "inf", "the weight of what is hard"},
    {clause, "on", "link point force", "on NAME", "which link or point"},
    {clause, "ground", "link", "ground", "the base, as a parent"},
    {clause, "through", "path", "through [p0, ...]", "a curve through the points"},
    {clause, "control", "travel", "control [(t0, s0), ...]", "by control points"},
    {clause, "constant", "travel", "constant", "at even speed"},
    {clause, "relative", "travel", "relative", "distances as fractions of the length"},
    {clause, "speed", "travel", "speed (v0, v1)", "at both ends"},
    {clause, "along", "orient", "along up (x, y, z)", "along the path"},
    {clause, "up", "orient", "up (x, y, z)", "which way is up"},
    {clause, "method", "solve", "method newton | sqp92 [linear cg] | bfgs", "which solver"},
    {clause, "newton", "solve", "newton", "Newton's method on the conditions of optimality"},
    {clause, "sqp92", "solve", "sqp92 [linear cg]", "the 1992 paper's method"},
    {clause, "bfgs", "solve", "bfgs", "the 1994 paper's method"},
    {clause, "linear", "solve", "linear cg", "least-squares conjugate gradients"},
    {clause, "cg", "solve", "cg", "least-squares conjugate gradients"},
    {clause, "iterations", "solve", "iterations n", "at most so many"},
    {clause, "tolerance", "solve refine adapt", "tolerance e", "when it is good enough"},
    {clause, "starts", "solve", "starts n", "from so many shaken starts"},
    {clause, "all", "window", "all", "everything is free"},
    {clause, "of", "window refine shake filter damp", "of names", "of these degrees of freedom alone"},
    {clause, "auto", "refine", "auto tolerance e", "where the residual asks for it"},
    {clause, "times", "refine", "times n", "so often"},
    {clause, "amplitude", "shake", "amplitude a", "how much"},
    {clause, "seed", "shake", "seed n", "which perturbation"},
    {clause, "strength", "filter", "strength s", "how much"},
    {clause, "levels", "adapt", "levels n", "so many at most"},
});

}  // namespace

std::span<const Word> vocabulary() { return table; }

bool belongs_to(const Word& word, std::string_view owner) {
  std::string_view rest = word.of;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == owner) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

bool begins_statement(std::string_view text) {
  return std::ranges::any_of(table, [&](const Word& word) {
    return word.word == text && (word.kind == Kind::declaration || word.kind == Kind::action);
  });
}

}  // namespace spacetime::symbolic
