// Lines of the scene language for what views do, with the JSON actions they compile to, and the language of actions
// that iterate.  Numbers are written so that they read back bit for bit.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/action.h"

namespace spacetime::gui {

// A line, and the same as action/do takes it; empty where only the compiler can tell (expressions, statements).
struct Words {
  std::string line;
  std::string action;
};

// The fewest digits that read back as the same bits.  The number must be finite.
std::string number_text(double number);

Words set_words(const std::string& constant, double value);
Words weight_words(const std::string& name, double weight);  // infinite: hard
Words enable_words(const std::string& name);
Words disable_words(const std::string& name);
Words delete_words(const std::string& name);
Words bound_words(const std::string& dof, double lower, double upper);
Words window_words(double from, double to, const DofNames& dofs = {});
Words window_all_words();
Words refine_words(double from, double to, const DofNames& dofs = {}, int times = 1);
Words refine_auto_words(double tolerance);
Words shake_words(double amplitude, int seed, const DofNames& dofs = {});
Words filter_words(double strength, const DofNames& dofs = {});
Words damp_words(double limit, const DofNames& dofs = {});
Words control_words(const std::string& dof, int index, double value);
Words key_words(double time, const std::vector<std::pair<std::string, double>>& keys);
Words reset_words();
Words solve_words(const Solve& solve = {});
Words iterate_words(int iterations);

// What only the compiler can turn into an action: a statement's new text behind `NAME:`, a scope as it is written.
std::string replace_line(const std::string& name, const std::string& statement);
std::string scope_line(const std::string& name, const std::string& scope);

// JSON of an action, without its place.
std::string json_of(const Action& action);
// The line of an action that iterates, or nothing for an edit.  Throws InputError for what is no action.
std::string iterating_line(const std::string& action_json);
// What an action that iterates still has to do after so many iterations; nothing where its number is reached.
std::string rest_line(const std::string& action_json, int iterations);
// How many iterations a run's log tells of: of actions that name their number.
int iterations_in(const std::string& action_json);
// Of many starts: what it has reached is worth nothing before its end.
bool is_of_many_starts(const std::string& action_json);
// Whether two JSON texts ask for the same; places do not count.
bool same_action(const std::string& a, const std::string& b);

// The line with its numbers to four significant digits: to be looked at, not to be read again.
std::string brief(std::string_view line);

// Lines as one, as the language takes them: with `; ` between.
std::string in_one_line(std::string_view text);

// Without spaces and line ends at its ends.
std::string trimmed(std::string_view text);

}  // namespace spacetime::gui
