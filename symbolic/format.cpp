#include "symbolic/format.h"

#include <algorithm>
#include <array>
#include <span>

#include "symbolic/columns.h"
#include "symbolic/lexer.h"
#include "symbolic/parser.h"
#include "symbolic/spacing.h"

namespace spacetime::symbolic {
namespace {

constexpr std::size_t step = 2;          // spaces a block is indented
constexpr std::size_t continuation = 4;  // ... and the lines that go on with a statement

// Statements whose `=` stand below one another.
constexpr std::array<std::string_view, 7> assigning{"constant", "parameter", "dof", "let",
                                                    "define",   "eliminate", "set"};

// Items of a link that stand on one line where it has several: how it moves, what it weighs, how it looks.
enum class Group { motion, mass, shape };
Group group_of(std::string_view word) {
  if (word == "mass" || word == "com" || word == "inertia" || word == "rod") return Group::mass;
  if (word == "capsule" || word == "sphere" || word == "box") return Group::shape;
  return Group::motion;
}

class Formatter {
 public:
  Formatter(const Pieces& pieces, const std::vector<Comment>& comments)
      : pieces_(pieces.pieces), kept_(pieces.kept), comments_(comments) {}

  std::vector<Line> run() {
    while (true) {
      while (i_ < pieces_.size() && is_separator(pieces_[i_])) ++i_;
      put_comments(i_, blocks_ * step);
      if (i_ == pieces_.size()) return std::move(lines_);
      if (at(i_, TokenKind::right_brace))
        close_block();
      else
        put_item();
    }
  }

 private:
  bool at(std::size_t i, TokenKind kind) const { return i < pieces_.size() && pieces_[i].token.kind == kind; }
  std::span<const Piece> range(std::size_t first, std::size_t last) const {
    return std::span(pieces_).subspan(first, last - first);
  }
  std::size_t piece_behind(const Comment& comment) const { return kept_[comment.before]; }

  Line& add_line(std::size_t indent, int source_line) {
    const bool paragraph = source_line - line_ > 1 && !lines_.empty() && !opened_;
    opened_ = false;
    lines_.push_back({indent, {}, {}, {}, paragraph});
    return lines_.back();
  }

  // The comments in front of a piece: behind what stands on their line, or on lines of their own.
  void put_comments(std::size_t piece, std::size_t indent, bool paragraphs = true) {
    for (; comment_ < comments_.size() && piece_behind(comments_[comment_]) <= piece; ++comment_) {
      const Comment& comment = comments_[comment_];
      if (!paragraphs) line_ = std::max(line_, comment.line - 1);
      const bool behind = !lines_.empty() && line_ == comment.line && lines_.back().comment.empty();
      (behind ? lines_.back() : add_line(indent, comment.line)).comment = comment.text;
      line_ = comment.line;
    }
  }

  void close_block() {
    --blocks_;
    line_ = pieces_[i_].token.span.line;  // no blank line in front of it
    add_line(blocks_ * step, line_).cells.push_back({0, 0, "}"});
    ++i_;
  }

  // A statement, or an item of a block: up to its end, or its opening brace.
  void put_item() {
    std::size_t last = i_;
    while (last < pieces_.size() && !is_separator(pieces_[last]) && !at(last, TokenKind::right_brace) &&
           !at(last, TokenKind::left_brace))
      ++last;
    if (!at(last, TokenKind::left_brace)) return put_statement(last);
    if (blocks_ > 0 && put_short_block(last)) return;
    put_statement(last + 1);
    opened_ = true;
    ++blocks_;
  }

  // "link upper { revolute shoulder; a 0.5 }", where that fits on a line and no comment stands in it.
  bool put_short_block(std::size_t brace) {
    std::size_t close = brace + 1;
    while (close < pieces_.size() && !at(close, TokenKind::right_brace)) ++close;
    if (comment_ < comments_.size() && piece_behind(comments_[comment_]) <= close) return false;
    std::string items = "{";
    for (std::size_t first = brace + 1; first < close;) {
      std::size_t last = first;
      while (last < close && !is_separator(pieces_[last])) ++last;
      if (last > first) items.append(items.size() > 1 ? "; " : " ").append(joined(range(first, last)));
      first = last + 1;
    }
    items += " }";
    const std::size_t indent = blocks_ * step;
    std::string head = joined(range(i_, brace));
    if (indent + head.size() + 1 + items.size() > line_width) return false;
    Line& line = add_line(indent, pieces_[i_].token.span.line);
    line.word = pieces_[i_].token.text;
    line.cells = {{0, 0, std::move(head)}, {0, 1, std::move(items)}};
    line_ = pieces_[close].token.span.line;
    i_ = close + 1;
    return true;
  }

  void put_statement(std::size_t last) {
    const std::size_t indent = blocks_ * step;
    const bool commented = comment_ < comments_.size() && piece_behind(comments_[comment_]) < last;
    if (!commented && joins_line(last)) {
      lines_.back().cells.back().text.append("; ").append(joined(range(i_, last)));
      line_ = pieces_[last - 1].token.span.line;
      i_ = last;
      return;
    }
    Line& line = add_line(indent, pieces_[i_].token.span.line);
    if (!commented && indent + width(range(i_, last)) <= line_width) {
      line.word = pieces_[i_].token.text;
      line.cells = cells(last);
    } else {
      wrap(last);
    }
    line_ = pieces_[last - 1].token.span.line;
    i_ = last;
  }

  // Whether an item of a link can stand behind the one before it.
  bool joins_line(std::size_t last) const {
    constexpr std::size_t inside_link = 2;
    if (blocks_ != inside_link || opened_ || pieces_[i_].token.span.line - line_ > 1) return false;
    const Line& line = lines_.back();
    if (line.word.empty() || !line.comment.empty() || group_of(line.word) != group_of(pieces_[i_].token.text))
      return false;
    return line.indent + line.cells.back().text.size() + 2 + width(range(i_, last)) <= line_width;
  }

  // A statement on one line, cut where it can be set in columns: before its `=` or behind its label (column 0), and
  // before its clauses.
  std::vector<Cell> cells(std::size_t last) const {
    const std::string_view word = pieces_[i_].token.text;
    const bool assigns = std::find(assigning.begin(), assigning.end(), word) != assigning.end();
    std::vector<Cell> out;
    std::size_t first = i_;
    int next = 0, clauses = 0;
    const auto cut = [&](std::size_t before, int column) {
      out.push_back({next, first > i_ ? gap(pieces_[first - 1], pieces_[first]) : 0, joined(range(first, before))});
      first = before, next = column;
    };
    bool split = false;
    for (std::size_t i = i_ + 1; i < last; ++i) {
      const bool label = !assigns && at(i - 1, TokenKind::colon), equal = assigns && at(i, TokenKind::equal);
      if (!split && pieces_[i].depth == 0 && (label || equal))
        cut(i, 0), split = true;
      else if (pieces_[i].role == Role::clause)
        cut(i, ++clauses);
    }
    cut(last, 0);
    return out;
  }

  // A statement that is too long for a line, or has comments inside.
  void wrap(std::size_t last) {
    lines_.back().cells.push_back({});
    std::size_t first = i_;
    while (first < last) {
      const bool more = comment_ < comments_.size() && piece_behind(comments_[comment_]) < last;
      const std::size_t stop = more ? piece_behind(comments_[comment_]) : last;
      lay(first, stop);
      if (more) {
        line_ = pieces_[stop - 1].token.span.line;
        put_comments(stop, blocks_ * step + continuation, false);
        line_ = pieces_[stop].token.span.line;
        go_on();
      }
      first = stop;
    }
  }

  void go_on() { add_line(blocks_ * step + continuation, line_).cells.push_back({}); }

  // Puts pieces on the line, breaking it as often as must be, at the loosest bonds first.  As deep as brackets nest.
  void lay(std::size_t first, std::size_t last) {
    if (fits(first, last)) return put(first, last);
    std::optional<int> loosest;
    for (std::size_t i = first; i + 1 < last; ++i)
      if (const auto here = bond(pieces_[i]); here && (!loosest || *here < *loosest)) loosest = here;
    if (!loosest) return put(first, last);
    for (std::size_t begin = first; begin < last;) {
      std::size_t end = begin;
      while (end + 1 < last && bond(pieces_[end]) != loosest) ++end;
      ++end;
      const bool fits_alone = blocks_ * step + continuation + width(range(begin, end)) <= line_width;
      if (begin > first && fits_alone && !fits(begin, end)) go_on();
      lay(begin, end);
      begin = end;
    }
  }

  bool fits(std::size_t first, std::size_t last) const {
    const Line& line = lines_.back();
    const std::string& text = line.cells.back().text;
    const std::size_t before = text.empty() ? 0 : gap(pieces_[first - 1], pieces_[first]);
    return line.indent + text.size() + before + width(range(first, last)) <= line_width;
  }

  void put(std::size_t first, std::size_t last) {
    const bool can_break = first > i_ && bond(pieces_[first - 1]).has_value();
    if (!lines_.back().cells.back().text.empty() && can_break && !fits(first, last)) go_on();
    std::string& text = lines_.back().cells.back().text;
    text.append(text.empty() ? 0 : gap(pieces_[first - 1], pieces_[first]), ' ').append(joined(range(first, last)));
  }

  const std::vector<Piece>& pieces_;
  const std::vector<std::size_t>& kept_;
  const std::vector<Comment>& comments_;
  std::vector<Line> lines_;
  std::size_t i_ = 0, comment_ = 0, blocks_ = 0;
  int line_ = 0;         // of the text, where what has been put last ended
  bool opened_ = false;  // which was a brace
};

}  // namespace

Formatted format(std::string_view text) {
  Formatted out;
  const Scene scene = parse(text, out.diagnostics);
  if (!out.diagnostics.empty()) return out;
  const Lexed lexed = lex(text, out.diagnostics);
  const Pieces pieces = pieces_of(lexed.tokens, scene);
  out.text = set_in_columns(Formatter(pieces, lexed.comments).run());
  return out;
}

}  // namespace spacetime::symbolic
