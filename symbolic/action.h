// What each action becomes; nothing where something is wrong with it, which has then been reported.
#pragma once

#include <optional>
#include <string_view>

#include "symbolic/expression.h"
#include "symbolic/model.h"

namespace spacetime::symbolic {

// action.cpp
std::optional<Action> action_of(Model& model, const SolveAction& action);
std::optional<Action> action_of(Model& model, const IterateAction& action);
std::optional<Action> action_of(Model& model, const WindowAction& action);
std::optional<Action> action_of(Model& model, const RefineAction& action);
std::optional<Action> action_of(Model& model, const ShakeAction& action);
std::optional<Action> action_of(Model& model, const FilterAction& action);
std::optional<Action> action_of(Model& model, const DampAction& action);
std::optional<Action> action_of(Model& model, const AdaptAction& action);
std::optional<Action> action_of(Model& model, const LockAction& action);
std::optional<Action> action_of(Model& model, const ResetAction& action);

// edit.cpp: what changes the problem, or moves the motion by hand
std::optional<Action> action_of(Model& model, const SetAction& action);
std::optional<Action> action_of(Model& model, const WeightAction& action);
std::optional<Action> action_of(Model& model, const ToggleAction& action);
std::optional<Action> action_of(Model& model, const ReplaceAction& action);
std::optional<Action> action_of(Model& model, const ScopeAction& action);
std::optional<Action> action_of(Model& model, const BoundAction& action);
std::optional<Action> action_of(Model& model, const KeyAction& action);
std::optional<Action> action_of(Model& model, const ControlAction& action);

// A number made of constants, greater than `least`.
std::optional<Fixed> elaborate_above(Model& model, NodeId root, std::string_view what, double least = 0);

// When all bases are known: reports coefficients that no degree of freedom has.
void check_coefficients(Model& model);

}  // namespace spacetime::symbolic
