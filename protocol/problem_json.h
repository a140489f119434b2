// The problem's document.  Its layout is explained in README.md, its schema is schemas/problem.schema.json.
#pragma once

#include <string>
#include <string_view>

#include "common/problem.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

inline constexpr std::string_view problem_format = "spacetime-problem/1";
inline constexpr std::string_view problem_document = "problem document";  // in sentences

// The document as text: one statement, one column of a program a line.  Throws InputError for what no document can
// hold (a number that is not finite, text that is not UTF-8).
std::string write(const Problem& problem);
void write(Writer& to, const Problem& problem);

// The problem that a document describes, checked (check.h): what it returns can be used without further questions.
// Throws DocumentError.
Problem read_problem(std::string_view json);

// The form alone, unchecked.  What the schema refuses, this refuses.
Problem problem_from(const Node& node);

// The 128-bit FNV-1a hash, as 32 hexadecimal digits, of the document that the problem makes: programs, values, places.
std::string fingerprint(const Problem& problem);

}  // namespace spacetime
