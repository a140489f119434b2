#include "symbolic/visible.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "symbolic/parser.h"

namespace spacetime::symbolic {
namespace {

using Kind = Completion::Kind;

class Collector {
 public:
  explicit Collector(std::string_view text) {
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      lines_.push_back(text.substr(at, end - at));
      at = end + 1;
    }
  }

  std::vector<Visible> run(const Scene& scene) {
    for (const Statement& statement : scene.statements)
      std::visit([&](const auto& what) { take(what, statement.span); }, statement.what);
    return std::move(out_);
  }

 private:
  // The rest of the line from its statement on, without a comment, columns, and spaces at its end.
  std::string declaration(const Span& span) const {
    std::string_view line = lines_.at(static_cast<std::size_t>(span.line) - 1);
    line.remove_prefix(std::min(line.size(), static_cast<std::size_t>(span.column) - 1));
    line = line.substr(0, line.find_first_of("#;{\r"));
    std::string out(line.substr(0, line.find_last_not_of(" \t") + 1));
    const auto both_spaces = [](char a, char b) { return a == ' ' && b == ' '; };
    out.erase(std::unique(out.begin(), out.end(), both_spaces), out.end());
    return out;
  }

  void add(Kind kind, const std::string& name, const Span& span) {
    if (!name.empty()) out_.push_back({name, kind, declaration(span)});
  }

  void take(const ConstantDeclaration& d, const Span& span) { add(Kind::constant, d.name.text, span); }
  void take(const ParameterDeclaration& d, const Span& span) { add(Kind::parameter, d.name.text, span); }
  void take(const DofDeclaration& d, const Span& span) { add(Kind::dof, d.name.text, span); }
  void take(const LetDeclaration& d, const Span& span) { add(Kind::let, d.name.text, span); }
  void take(const DefineDeclaration& d, const Span& span) { add(Kind::function, d.name.text, span); }
  void take(const ScriptDeclaration& d, const Span& span) { add(Kind::script, d.name.text, span); }
  void take(const ConstrainDeclaration& d, const Span& span) {
    if (d.name) add(Kind::constraint, d.name->text, span);
  }
  void take(const MinimizeDeclaration& d, const Span& span) {
    if (d.name) add(Kind::term, d.name->text, span);
  }
  void take(const ToggleAction& d, const Span&) {
    if (d.kind != ToggleAction::Kind::remove) return;
    std::erase_if(out_, [&](const Visible& one) {
      return one.name == d.name.text && (one.kind == Kind::constraint || one.kind == Kind::term);
    });
  }
  // A statement with mistakes still says what it would declare.
  void take(const Damaged& d, const Span& span) {
    static constexpr std::array<std::pair<std::string_view, Kind>, 5> kinds{{{"constant", Kind::constant},
                                                                             {"parameter", Kind::parameter},
                                                                             {"dof", Kind::dof},
                                                                             {"define", Kind::function},
                                                                             {"creature", Kind::creature}}};
    const std::string line = declaration(span);
    if (d.statement) add(line.starts_with("minimize") ? Kind::term : Kind::constraint, d.statement->text, span);
    if (!d.name) return;
    const auto found = std::ranges::find_if(kinds, [&](const auto& row) { return line.starts_with(row.first); });
    add(found == kinds.end() ? Kind::let : found->second, d.name->text, span);
  }
  void take(const CreatureDeclaration& d, const Span& span) {
    add(Kind::creature, d.name.text, span);
    for (const auto& item : d.items) {
      if (const auto* link = std::get_if<LinkDeclaration>(&item)) {
        add(Kind::link, d.name.text + "." + link->name.text, link->name.span);
        for (const LinkItem& part : link->items)
          if (!part.dof.text.empty()) add(Kind::dof, d.name.text + "." + part.dof.text, part.span);
      } else if (const auto* point = std::get_if<PointDeclaration>(&item)) {
        add(Kind::point, d.name.text + "." + point->name.text, point->name.span);
      }
    }
  }
  template <class Other>
  void take(const Other&, const Span&) {}

  std::vector<std::string_view> lines_;
  std::vector<Visible> out_;
};

}  // namespace

std::vector<Visible> visible_names(std::string_view text) {
  std::vector<Diagnostic> ignored;
  return Collector(text).run(parse(text, ignored));
}

}  // namespace spacetime::symbolic
