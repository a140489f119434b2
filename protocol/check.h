// Whether a problem or a motion means something: what its form alone does not tell.  Needs no document; a problem that
// was just compiled can be asked as well as one that was read.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime {

// Why numbers that came have another hash than they had.
inline constexpr std::string_view probably_rounded =
    "numbers have probably been rounded on the way; pass the document on as the text that it was, or write numbers so "
    "that they read back as the same doubles (17 digits)";

// The first thing that is wrong, and its JSON pointer in the document that the value makes.
struct Fault {
  std::string path;
  std::string message;
};

// Nothing where the problem can be used without further questions: the time rises; names are unique, and all that is
// named is there; programs are valid and stand under their hashes; outputs are in range; constants and functionals use
// only what is before them; quantities use constants alone, conditions no functionals, and statements that depend on no
// time no trajectories; knots rise; replacements replace what is of their kind; actions name what has taken effect by
// then and set no frozen constant; the limits of limits.h are kept.  What follows from values of constants (times
// outside the span, steps that are not positive, bounds in the wrong order) is checked as far as it is plain numbers;
// the rest is for who evaluates them, as is what only a run tells: how many coefficients there are after a refinement.
std::optional<Fault> validate(const Problem& problem);

// Nothing where the action can be performed on the problem, which is one that can be used, and all of whose statements
// count; paths are the action's own.
std::optional<Fault> validate(const Action& action, const Problem& problem);

// Nothing where the numbers of a motion's checkpoint are what they can be, whatever the problem.
std::optional<Fault> validate(const Checkpoint& checkpoint, const Motion& motion);

// Nothing where the motion's checkpoint, if it has one, is of this problem, and what it refers to is there: sizes that
// follow from values of constants are for who resumes.
std::optional<Fault> validate(const Motion& motion, const Problem& problem);

// Nothing where every trajectory has rising knots over the motion's time and as many coefficients as they ask for,
// every number is finite (but for measures of a failed motion), names are unique, samples are as long as their times,
// bodies and their programs could stand in a problem, and a checkpoint's numbers have the signs that they must have.
std::optional<Fault> validate(const Motion& motion);

// A clamped cubic basis over [start, end]; `path` is the basis's own.
std::optional<Fault> validate(const Basis& basis, double start, double end, std::string_view path);

// A name: 1 to limits::name_bytes bytes without control characters, which would disturb whoever prints it.
std::optional<Fault> validate_name(std::string_view name, std::string_view path);

}  // namespace spacetime
