// Diagnostics as a document, for programs that read what people would read as "file:line:col: error: ...":
//   {"format": "spacetime-diagnostics/1", "file": "throw.scene",
//    "diagnostics": [{"line": 3, "column": 7, "length": 5, "message": "...", "notes": [{"line": ..., ...}]}]}
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/diagnostic.h"
#include "protocol/writer.h"

namespace spacetime {

// The member "diagnostics" alone, as a message has it.
void write_diagnostics(Writer& to, std::span<const Diagnostic> diagnostics);

std::string write_diagnostics(std::span<const Diagnostic> diagnostics, std::string_view file);

}  // namespace spacetime
