#include "protocol/diagnostics_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace spacetime {
namespace {

TEST(DiagnosticsDocument, SaysWhatPeopleWouldRead) {
  const Diagnostic diagnostics[] = {{{3, 7, 5}, "no \"name\" of that kind", {}},
                                    {{4, 1, 1}, "declared twice", {{{2, 1, 4}, "first here"}}}};
  EXPECT_EQ(write_diagnostics(diagnostics, "a.scene"), R"({
 "format": "spacetime-diagnostics/1",
 "file": "a.scene",
 "diagnostics": [
  {"line": 3, "column": 7, "length": 5, "message": "no \"name\" of that kind"},
  {"line": 4, "column": 1, "length": 1, "message": "declared twice", "notes": [{"line": 2, "column": 1, "length": 4, "message": "first here"}]}
 ]
}
)");
  EXPECT_TRUE(nlohmann::json::parse(write_diagnostics({}, "ä"))["diagnostics"].empty());
}

}  // namespace
}  // namespace spacetime
