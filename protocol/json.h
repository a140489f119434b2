// JSON text to a tree of values, strictly: nothing that a peer sends is silently dropped, repaired or allowed to take
// memory without bound.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "common/diagnostic.h"
#include "protocol/path.h"

namespace spacetime {

// Members keep the order of the text: it is the order of a motion's constants and objective terms.
using Json = nlohmann::ordered_json;

// A malformed document.  `path` is the JSON pointer (RFC 6901) of the value at fault, empty for the document itself;
// what() is the whole sentence: "problem document: /dofs/2/basis/knots/7: expected a number, found \"abc\"".
class DocumentError : public InputError {
 public:
  DocumentError(std::string_view document, std::string path, std::string_view message);
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The value that the whole text describes.  Throws DocumentError, `document` naming what was to be read, where the text
// is no JSON (with the byte), is cut short or goes on after its value, repeats a member of an object, holds a number
// beyond the range of double, or exceeds limits::document_bytes, document_values or document_depth.  Works without
// recursion; the depth is checked while parsing, before anything is built.
Json parse(std::string_view text, std::string_view document);

}  // namespace spacetime
