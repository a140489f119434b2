#include "gui/key_marks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/bspline.h"
#include "gui/question.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr double same = 1e-9;  // values that are meant to be one, after what rounding does to sums

bool near(double a, double b) { return std::abs(a - b) <= same * std::max({1.0, std::abs(a), std::abs(b)}); }

const Trajectory* curve_of(const Motion& motion, const std::string& dof) {
  const auto found = std::ranges::find(motion.dofs, dof, &Trajectory::name);
  return found == motion.dofs.end() ? nullptr : &*found;
}

// Whether the action leaves the sum of pulls a sum of pulls.
bool keeps_shape(const Action& action) {
  return !std::holds_alternative<Refine>(action) && !std::holds_alternative<Shake>(action) &&
         !std::holds_alternative<Smooth>(action) && !std::holds_alternative<Reset>(action) &&
         !std::holds_alternative<Window>(action) && !std::holds_alternative<Adapt>(action);
}

bool iterates(const std::string& line) { return line.starts_with("solve") || line.starts_with("iterate"); }

class Walk {
 public:
  Walk(const Problem& problem, const std::map<std::string, double>& constants)
      : problem_(problem), constants_(constants) {
    for (const Keyframe& keyframe : problem.keyframes)
      if (auto mark = mark_of(keyframe.time, keyframe.keys)) {
        mark->sketched = true;
        marks_.push_back(std::move(*mark));
      }
  }

  void entry(const Entry& entry, const std::vector<std::optional<Action>>& actions, const Motion* before) {
    const bool solved_last = iterates(trimmed(entry.text.substr(entry.text.rfind('\n') + 1)));
    if (entry.iterated && !solved_last) settle();
    std::vector<KeyMark> fresh;
    std::map<std::string, std::vector<double>> released;
    for (const std::optional<Action>& action : actions) {
      if (!action || !keeps_shape(*action)) settle();
      const auto* pull = action ? std::get_if<PullKeys>(&*action) : nullptr;
      auto mark = pull ? mark_of(pull->time, pull->keys) : std::nullopt;
      if (mark && !(before && takes_out(*mark, *before, released))) fresh.push_back(std::move(*mark));
    }
    for (KeyMark& mark : fresh) {
      // Two at once cannot be told apart in what they added.
      if (fresh.size() == 1 && before && entry.motion) add(mark, *before, *entry.motion, std::move(released));
      std::erase_if(marks_, [&](const KeyMark& one) {
        if (one.sketched) return false;
        const bool spent = one.added.empty() && one.held == mark.held;  // moved: nothing of it is left
        return spent || (near(one.time, mark.time) && same_dofs(one, mark));
      });
      marks_.push_back(std::move(mark));
    }
    if (entry.iterated && solved_last) settle();
  }

  // The sketch's last, so that the mouse meets the others first.
  std::vector<KeyMark> take() {
    std::ranges::stable_partition(marks_, [](const KeyMark& mark) { return !mark.sketched; });
    return std::move(marks_);
  }

 private:
  static bool same_dofs(const KeyMark& a, const KeyMark& b) {
    return std::ranges::equal(
        a.held, b.held, {}, [](const auto& x) { return x.first; }, [](const auto& x) { return x.first; });
  }
  std::optional<KeyMark> mark_of(const Quantity& time, const std::vector<Key>& keys) const {
    KeyMark mark;
    const auto at = value_of(time, problem_, constants_);
    if (!at) return std::nullopt;
    mark.time = *at;
    for (const Key& key : keys)
      if (const auto value = value_of(key.value, problem_, constants_)) mark.held[key.dof] = *value;
    return mark;
  }
  void settle() {
    for (KeyMark& mark : marks_) mark.added.clear();
  }
  bool takes_out(const KeyMark& by, const Motion& before, std::map<std::string, std::vector<double>>& released) {
    for (auto mark = marks_.begin(); mark != marks_.end(); ++mark) {
      if (mark->added.empty() || !near(mark->time, by.time) || !same_dofs(*mark, by)) continue;
      const auto back = without(*mark, before);
      const auto is_back = [&](const auto& one) { return near(by.held.at(one.first), one.second); };
      if (back.size() != by.held.size() || !std::ranges::all_of(back, is_back)) continue;
      released = std::move(mark->added);
      marks_.erase(mark);
      return true;
    }
    return false;
  }
  void add(KeyMark& mark, const Motion& before, const Motion& after,
           std::map<std::string, std::vector<double>> released) const {
    // One of the same time and degrees of freedom is pulled on: what both added is this one's.
    for (const KeyMark& one : marks_)
      if (!one.sketched && near(one.time, mark.time) && same_dofs(one, mark)) released = one.added;
    for (const auto& [dof, value] : mark.held) {
      const Trajectory *from = curve_of(before, dof), *to = curve_of(after, dof);
      if (!from || !to || from->coefficients.size() != to->coefficients.size()) return mark.added.clear();
      std::vector<double> sum = released.contains(dof) ? released[dof] : std::vector<double>(to->coefficients.size());
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += to->coefficients[k] - from->coefficients[k];
      mark.added[dof] = std::move(sum);
    }
  }

  const Problem& problem_;
  const std::map<std::string, double>& constants_;
  std::vector<KeyMark> marks_;
};

}  // namespace

std::vector<KeyMark> key_marks(const State& state, const ReadActions& actions,
                               const std::map<std::string, double>& constants) {
  if (!state.scene || !state.scene->problem) return {};
  Walk walk(*state.scene->problem, constants);
  for (int i = 1; i <= state.present; ++i) {
    const auto index = static_cast<std::size_t>(i);
    walk.entry(state.log[index], actions[index], state.log[index - 1].motion.get());
  }
  return walk.take();
}

std::vector<std::pair<std::string, double>> without(const KeyMark& mark, const Motion& motion) {
  std::vector<std::pair<std::string, double>> keys;
  for (const auto& [dof, added] : mark.added) {
    const Trajectory* curve = curve_of(motion, dof);
    if (!curve || curve->coefficients.size() != added.size()) return {};
    std::vector<double> rest = curve->coefficients;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= added[k];
    keys.emplace_back(dof, value(curve->basis, rest, mark.time));
  }
  return keys;
}

Steering moved(const KeyMark& mark, const Motion& motion, double time) {
  const std::vector<std::pair<std::string, double>> held(mark.held.begin(), mark.held.end());
  const Words in = key_words(time, held);
  Steering steering{in.line, {in.action}};
  steering.afresh = true;
  const auto back = without(mark, motion);
  if (back.empty()) return steering;
  const Words out = key_words(mark.time, back);
  steering.line = out.line + "; " + in.line;
  steering.actions = {out.action, in.action};
  steering.solves = false;
  return steering;
}

}  // namespace spacetime::gui
