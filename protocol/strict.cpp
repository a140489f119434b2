#include "protocol/strict.h"

#include <algorithm>
#include <cmath>

namespace spacetime {
namespace {

constexpr std::size_t longest_found = 60;  // bytes of a found string that are shown

// What a value is, in a few words.
std::string describe(const Json& json) {
  if (json.is_array()) return "a list of " + std::to_string(json.size());
  if (json.is_object()) return "an object";
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    const auto start = text.substr(0, longest_found);
    return Json(start).dump(-1, ' ', false, Json::error_handler_t::replace) + (text.size() > start.size() ? "..." : "");
  }
  return json.dump();
}

// The integer that a JSON number is, if it is one from `least` to `most`.
std::optional<int> whole(const Json& json, int least, int most) {
  if (!json.is_number()) return std::nullopt;
  const double value = json.get<double>();  // rounding large integers cannot bring them into the range of int
  if (!(value >= least && value <= most) || value != std::floor(value)) return std::nullopt;
  return static_cast<int>(value);
}

std::string list_of(std::span<const std::string_view> names) {
  std::string result;
  for (const auto name : names) {
    result.append(result.empty() ? "" : name == names.back() ? " or " : ", ").append("\"").append(name).append("\"");
  }
  return result;
}

const Json* member_of(const Json& json, std::string_view name) {
  const auto& members = json.get_ref<const Json::object_t&>();
  const auto found = std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.first == name; });
  return found == members.end() ? nullptr : &found->second;
}

}  // namespace

void Node::expected(std::string_view what) const {
  refuse("expected " + std::string(what) + ", found " + describe(*json_));
}

void Node::refuse(std::string_view message) const { throw DocumentError(document_, path_, message); }

double Node::number() const {
  if (!json_->is_number()) expected("a number");
  return json_->get<double>();
}

int Node::integer(int least, int most) const {
  const auto value = whole(*json_, least, most);
  if (value) return *value;
  if (most == std::numeric_limits<int>::max()) expected("an integer of at least " + std::to_string(least));
  expected("an integer from " + std::to_string(least) + " to " + std::to_string(most));
}

bool Node::boolean() const {
  if (!json_->is_boolean()) expected("true or false");
  return json_->get<bool>();
}

const std::string& Node::string() const {
  if (!json_->is_string()) expected("a string");
  return json_->get_ref<const std::string&>();
}

int Node::choice(std::span<const std::string_view> names) const {
  const auto found =
      json_->is_string() ? std::find(names.begin(), names.end(), json_->get_ref<const std::string&>()) : names.end();
  if (found == names.end()) expected(list_of(names));
  return static_cast<int>(found - names.begin());
}

void Node::object(std::span<const std::string_view> required, std::span<const std::string_view> optional) const {
  if (!json_->is_object()) expected("an object");
  std::size_t present = 0;
  for (const auto& [name, value] : json_->get_ref<const Json::object_t&>()) {
    if (std::find(required.begin(), required.end(), name) != required.end()) {
      ++present;
    } else if (std::find(optional.begin(), optional.end(), name) == optional.end()) {
      std::vector<std::string_view> known(required.begin(), required.end());
      known.insert(known.end(), optional.begin(), optional.end());
      Node(value, document_, below(path_, name)).refuse("unknown member; known here: " + list_of(known));
    }
  }
  if (present == required.size()) return;
  for (const auto name : required) {
    if (!member_of(*json_, name)) refuse("the member \"" + std::string(name) + "\" is missing");
  }
}

Node Node::operator[](std::string_view member) const {
  if (auto found = find(member)) return *found;
  refuse("the member \"" + std::string(member) + "\" is missing");
}

std::optional<Node> Node::find(std::string_view member) const {
  if (!json_->is_object()) expected("an object");
  const auto* const found = member_of(*json_, member);
  if (!found) return std::nullopt;
  return Node(*found, document_, below(path_, member));
}

std::size_t Node::list(std::size_t most) const {
  if (!json_->is_array()) expected("a list");
  if (json_->size() > most) {
    refuse("a list of " + std::to_string(json_->size()) + ", more than the limit of " + std::to_string(most));
  }
  return json_->size();
}

std::vector<double> Node::numbers() const {
  std::vector<double> result(list());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& element = (*json_)[i];
    if (!element.is_number()) (*this)[i].expected("a number");
    result[i] = element.get<double>();
  }
  return result;
}

std::vector<std::int32_t> Node::integers() const {
  std::vector<std::int32_t> result(list());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto value = whole((*json_)[i], 0, std::numeric_limits<std::int32_t>::max());
    result[i] = value ? *value : (*this)[i].integer();
  }
  return result;
}

std::vector<std::array<std::int32_t, 3>> Node::triples() const {
  std::vector<std::array<std::int32_t, 3>> result(list());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& element = (*json_)[i];
    if (!element.is_array() || element.size() != 3) (*this)[i].expected("a list of 3 integers");
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = whole(element[k], 0, std::numeric_limits<std::int32_t>::max());
      result[i][k] = value ? *value : (*this)[i][k].integer();
    }
  }
  return result;
}

}  // namespace spacetime
