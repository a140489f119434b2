#include "symbolic/wrap.h"

#include <algorithm>
#include <vector>

namespace spacetime::symbolic {
namespace {

constexpr std::string_view indent = "    ";

struct Break {
  std::size_t at = 0;  // the first character of the next line
  int depth = 0;       // of brackets
};

std::vector<Break> breaks(std::string_view line) {
  std::vector<Break> out;
  int depth = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string_view before = line.substr(0, i);
    const char last = i > 0 ? line[i - 1] : ' ';
    if (line[i] == '(') ++depth;
    if (line[i] == ')') --depth;
    const bool spaced = line[i] == ' ' && (last == '+' || last == '-' || last == ',' || last == '<' || last == '=' ||
                                           before.ends_with(" and") || before.ends_with(" or"));
    if (spaced) out.push_back({i + 1, depth});
    // Inside a product only where there is nothing better.
    if ((last == '*' || last == '/') && line[i] != ' ') out.push_back({i, depth + 100});
  }
  return out;
}

}  // namespace

std::string wrapped(std::string_view line, std::size_t width) {
  std::string out;
  std::size_t start = 0, room = width;
  const std::vector<Break> all = breaks(line);
  auto next = all.begin();
  while (line.size() - start > room) {
    next = std::find_if(next, all.end(), [&](const Break& b) { return b.at > start; });
    auto best = all.end();
    for (auto at = next; at != all.end(); ++at) {
      const std::size_t used = at->at - start;
      if (used > room + 1 && best != all.end()) break;
      const bool early = best == all.end() || best->at - start < room / 2;
      if (early || at->depth <= best->depth) best = at;
      if (used > room + 1) break;
    }
    if (best == all.end()) break;
    std::string_view piece = line.substr(start, best->at - start);
    if (piece.ends_with(' ')) piece.remove_suffix(1);
    out.append(piece).append("\n").append(indent);
    start = best->at;
    room = width > 2 * indent.size() ? width - indent.size() : indent.size();
  }
  return out.append(line.substr(start));
}

}  // namespace spacetime::symbolic
