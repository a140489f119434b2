// Arbitrary bytes as a scene: compiling ends, without a fault, with a problem or with diagnostics; what has been
// formatted is formatted; completion bears every text.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/assert.h"
#include "common/program.h"
#include "symbolic/compile.h"
#include "symbolic/complete.h"
#include "symbolic/format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto result = spacetime::symbolic::compile(text);
  SPACETIME_ASSERT(result.problem.has_value() != !result.diagnostics.empty());
  for (const auto& diagnostic : result.diagnostics) {
    SPACETIME_ASSERT(diagnostic.span.line >= 1 && diagnostic.span.column >= 1);
    SPACETIME_ASSERT(!render(diagnostic, "scene", text).empty());
  }
  if (result.problem) {
    for (const auto& [key, program] : result.problem->programs) SPACETIME_ASSERT(!validate(program));
  }
  if (const auto formatted = spacetime::symbolic::format(text).text)
    SPACETIME_ASSERT(spacetime::symbolic::format(*formatted).text == formatted);
  spacetime::symbolic::complete(text, 1 << 20, 1 << 20);
  return 0;
}
