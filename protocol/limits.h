// How much a document may ask for.  What a peer sends must never take memory or time without bound: sizes that the
// text itself carries are bounded by its length, so the limits that matter most are those of numbers that claim more
// than they carry (a count, a step).  Raising one is safe as far as memory allows; lowering one refuses honest scenes.
#pragma once

#include <cstddef>

#include "common/limits.h"

namespace spacetime::limits {

// Bytes of text in one document.  The throw's problem has some 10^5; an animation of several minutes with samples of
// every pose at 60 frames a second some 10^7.
inline constexpr std::size_t document_bytes = std::size_t{64} << 20;

// JSON values (numbers, strings, lists, objects) in one document.  A value takes 16 to 150 bytes once parsed, so this
// bounds what a document of permitted length can cost to half a gigabyte.
inline constexpr std::size_t document_values = 4'000'000;

// Objects and lists inside one another.  The deepest document has six; messages put one or two around it.
inline constexpr std::size_t document_depth = 32;

// Bytes of a name.  Names go into sentences, lists and plots; the longest sensible one is a few words.
inline constexpr std::size_t name_bytes = 256;

// Operations in all programs of a problem.  The throw has some thousands, an arm of twelve links with second
// derivatives some ten thousands.
inline constexpr std::size_t operations = 500'000;

// Knot spans of one trajectory: wavelets of level 17, or nine minutes in steps of 4 ms.
inline constexpr std::size_t spans = std::size_t{1} << 17;

// How often one `refine` may halve a knot span; after so many halves a double has no middle left.
inline constexpr int halvings = 52;

// What a document says was counted: iterations, shakes.  All of them go on being counted, in an int; nobody has so
// many.
inline constexpr int count = 1'000'000'000;

// Starts of one `solve`: each keeps a motion and what is known at its end until all have ended.
inline constexpr int starts = 10'000;

}  // namespace spacetime::limits
