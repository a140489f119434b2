#include "symbolic/columns.h"

#include <algorithm>
#include <span>

namespace spacetime::symbolic {
namespace {

// Cells that would have to stand farther apart than this are no column to the eye any more.
constexpr std::size_t widest_gap = 32;

std::size_t width(const Line& line) {
  std::size_t out = line.indent;
  for (const Cell& cell : line.cells) out += cell.gap + cell.text.size();
  return out;
}

// Where a cell of this column would begin; 0 where the line has none.
std::size_t start_of(const Line& line, int column) {
  std::size_t out = line.indent;
  for (const Cell& cell : line.cells) {
    out += cell.gap;
    if (&cell != &line.cells.front() && cell.column == column) return out;
    out += cell.text.size();
  }
  return 0;
}

void align(std::span<Line> lines, int column) {
  std::size_t target = 0;
  for (const Line& line : lines) target = std::max(target, start_of(line, column));
  const auto padding = [&](const Line& line) {
    const std::size_t start = start_of(line, column);
    return start > 0 ? target - start : 0;
  };
  for (const Line& line : lines)
    if (padding(line) > widest_gap || width(line) + padding(line) > line_width) return;
  for (Line& line : lines) {
    const std::size_t more = padding(line);
    for (Cell& cell : line.cells)
      if (&cell != &line.cells.front() && cell.column == column) cell.gap += more;
  }
}

void align_all(std::span<Line> lines) {
  int last = -1;
  for (const Line& line : lines)
    for (const Cell& cell : line.cells) last = std::max(last, cell.column);
  for (int column = 0; column <= last; ++column) align(lines, column);
}

// Runs of neighbours that belong together.
template <class Together, class Act>
void for_runs(std::vector<Line>& lines, Together together, Act act) {
  for (std::size_t first = 0, i = 1; i <= lines.size(); ++i) {
    if (i < lines.size() && !lines[i].blank_before && together(lines[i - 1], lines[i])) continue;
    act(std::span(lines).subspan(first, i - first));
    first = i;
  }
}

bool share_columns(const Line& a, const Line& b) { return !a.word.empty() && a.word == b.word && a.indent == b.indent; }

bool have_comments(const Line& a, const Line& b) {
  const auto both = [](const Line& line) { return !line.comment.empty() && !line.cells.empty(); };
  return both(a) && both(b) && a.indent == b.indent;
}

}  // namespace

std::string set_in_columns(std::vector<Line> lines) {
  for_runs(lines, share_columns, align_all);
  std::vector<std::size_t> comment_at(lines.size(), 0);
  for_runs(lines, have_comments, [&](std::span<Line> run) {
    std::size_t widest = 0, narrowest = line_width;
    for (const Line& line : run) widest = std::max(widest, width(line)), narrowest = std::min(narrowest, width(line));
    if (widest - std::min(widest, narrowest) > widest_gap) return;
    for (const Line& line : run) comment_at[static_cast<std::size_t>(&line - lines.data())] = widest + 2;
  });
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (line.blank_before) out += '\n';
    const std::size_t start = out.size();
    out.append(line.indent, ' ');
    for (const Cell& cell : line.cells) out.append(cell.gap, ' ').append(cell.text);
    if (!line.comment.empty()) {
      const std::size_t end = out.size() - start;
      if (!line.cells.empty()) out.append(std::max(end + 2, comment_at[i]) - end, ' ');
      out += line.comment;
    }
    out += '\n';
  }
  return out;
}

}  // namespace spacetime::symbolic
