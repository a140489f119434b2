// Whole text files, or standard input and output under the name "-".
#pragma once

#include <string>
#include <string_view>

namespace spacetime {

// Throws InputError where the file cannot be read, or where it holds more than max_file_bytes.
std::string read_text(const std::string& file);

// Writes beside the file, then renames: a reader, or a failure half-way, never sees a partial document in its place. A
// file that was there keeps its permissions, a link still points to it; devices and pipes are written to.  Throws
// InputError.
void write_text(const std::string& file, std::string_view text);

// A thousand times the largest problem met so far; more is not a document of ours.
inline constexpr std::size_t max_file_bytes = std::size_t{1} << 30;

}  // namespace spacetime
