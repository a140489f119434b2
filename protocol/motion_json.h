// The motion's document.  Its layout is explained in README.md, its schema is schemas/motion.schema.json.
#pragma once

#include <string>
#include <string_view>

#include "common/motion.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

// What is written.  Version 1 is read, too: its checkpoints have no fingerprint, so that nobody can tell whether their
// numbers have been rounded.
inline constexpr std::string_view motion_format = "spacetime-motion/2", first_motion_format = "spacetime-motion/1";
inline constexpr std::string_view motion_document = "motion document";  // in sentences

// The document as text: one degree of freedom a line.  Measures of a failed motion that are not finite become null.
// Throws InputError for what no document can hold (any other number that is not finite, text that is not UTF-8).
std::string write(const Motion& motion);
void write(Writer& to, const Motion& motion);

// One of its iterations, for a motion that `failed` or may yet.
void write(Writer& to, const IterationRecord& record, bool failed);
IterationRecord record_from(const Node& node);

// The motion that a document describes, checked (check.h).  Throws DocumentError.
Motion read_motion(std::string_view json);

// The form alone, unchecked.  What the schema refuses, this refuses.
Motion motion_from(const Node& node);

}  // namespace spacetime
