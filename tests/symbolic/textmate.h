// As much of a TextMate grammar as ours uses: `match`, `begin`/`end`, captures, includes; regular expressions that
// std::regex and the editors' engines read alike.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace spacetime::symbolic {

class TextMate {
 public:
  explicit TextMate(const nlohmann::json& grammar) : grammar_(grammar) {}

  // For every character of a text the innermost name it is given; empty where none is.
  std::vector<std::string> scopes(const std::string& text) {
    std::vector<std::string> out;
    open_ = {&grammar_};
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const auto line = scopes_of_line(text.substr(at, end - at));
      out.insert(out.end(), line.begin(), line.end());
      out.emplace_back();  // the line's end
      at = end + 1;
    }
    return out;
  }

 private:
  using Json = nlohmann::json;

  const std::regex& compiled(const std::string& text) {
    return compiled_.try_emplace(text, text, std::regex::ECMAScript | std::regex::optimize).first->second;
  }

  bool matches(const std::string& line, std::size_t at, const std::string& pattern, std::smatch& match) {
    auto flags = std::regex_constants::match_continuous;
    if (at > 0) flags |= std::regex_constants::match_prev_avail;
    return std::regex_search(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), match, compiled(pattern),
                             flags);
  }

  // The rules a list of patterns stands for, includes followed.
  const std::vector<const Json*>& rules(const Json& patterns) {
    const auto [known, fresh] = rules_.try_emplace(&patterns);
    if (!fresh) return known->second;
    std::vector<const Json*> out;
    for (const Json& pattern : patterns) {
      const Json* rule = &pattern;
      if (pattern.contains("include"))
        rule = &grammar_.at("repository").at(pattern.at("include").get<std::string>().substr(1));
      if (rule->contains("patterns") && !rule->contains("begin")) {
        const std::vector<const Json*> inner = rules(rule->at("patterns"));
        out.insert(out.end(), inner.begin(), inner.end());
      } else {
        out.push_back(rule);
      }
    }
    return rules_[&patterns] = std::move(out);
  }

  static void paint(std::vector<std::string>& out, const std::smatch& match, std::size_t at, const Json& rule,
                    const char* captures) {
    const auto put = [&](std::size_t group, const Json& name) {
      for (std::ptrdiff_t i = 0; i < match.length(group); ++i)
        out[at + static_cast<std::size_t>(match.position(group) + i)] = name;
    };
    if (rule.contains("name")) put(0, rule.at("name"));
    if (rule.contains(captures))
      for (const auto& [group, what] : rule.at(captures).items()) put(std::stoul(group), what.at("name"));
  }

  std::vector<std::string> scopes_of_line(const std::string& line) {
    std::vector<std::string> out(line.size());
    for (std::size_t at = 0; at <= line.size();) {
      std::smatch match;
      if (open_.size() > 1 && matches(line, at, open_.back()->at("end"), match)) {
        open_.pop_back();
        at += static_cast<std::size_t>(match.length());
        continue;
      }
      std::size_t taken = 0;
      for (const Json* rule : rules(open_.back()->at("patterns"))) {
        const bool opens = rule->contains("begin");
        if (!matches(line, at, rule->at(opens ? "begin" : "match"), match) || match.length() == 0) continue;
        paint(out, match, at, *rule, opens ? "beginCaptures" : "captures");
        if (opens) open_.push_back(rule);
        taken = static_cast<std::size_t>(match.length());
        break;
      }
      at += std::max<std::size_t>(taken, 1);
    }
    return out;
  }

  const Json& grammar_;
  std::map<std::string, std::regex> compiled_;
  std::map<const Json*, std::vector<const Json*>> rules_;
  std::vector<const Json*> open_;
};

}  // namespace spacetime::symbolic
