// Walks a parsed document and refuses whatever is not exactly as expected, naming the path, what was expected and what
// was found.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json.h"

namespace spacetime {

// One value of a document, with its path.  All functions throw DocumentError.  Refers to the parsed tree and to the
// document's name, which must outlive it.
class Node {
 public:
  Node(const Json& json, std::string_view document, std::string path = {})
      : json_(&json), document_(document), path_(std::move(path)) {}

  [[noreturn]] void expected(std::string_view what) const;  // "expected <what>, found <the value>"
  [[noreturn]] void refuse(std::string_view message) const;

  const Json& json() const { return *json_; }
  bool is_number() const { return json_->is_number(); }
  bool is_object() const { return json_->is_object(); }
  bool is_null() const { return json_->is_null(); }

  double number() const;
  // JSON knows one kind of number: 2.0 is the integer 2, as in JSON Schema.
  int integer(int least = 0, int most = std::numeric_limits<int>::max()) const;
  bool boolean() const;
  const std::string& string() const;
  // The index of the string among `names`.
  int choice(std::span<const std::string_view> names) const;

  // An object with all of the required members, any of the optional ones and no others.
  void object(std::initializer_list<std::string_view> required,
              std::initializer_list<std::string_view> optional = {}) const {
    object({required.begin(), required.size()}, {optional.begin(), optional.size()});
  }
  void object(std::span<const std::string_view> required, std::span<const std::string_view> optional) const;
  Node operator[](std::string_view member) const;  // must be there
  std::optional<Node> find(std::string_view member) const;

  // The length of a list; it is refused where longer than `most`.
  std::size_t list(std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  Node operator[](std::size_t index) const { return {(*json_)[index], document_, below(path_, index)}; }

  // read(element) of each element of a list.
  template <class Read>
  auto each(Read read) const {
    std::vector<decltype(read(*this))> result(list());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = read((*this)[i]);
    return result;
  }

  // use(name, value) for each member of an object of any names, in the text's order.
  template <class Use>
  void members(Use use) const {
    if (!json_->is_object()) expected("an object");
    for (const auto& [name, value] : json_->get_ref<const Json::object_t&>()) {
      use(name, Node(value, document_, below(path_, name)));
    }
  }

  // Long lists: these make no node for each element.
  std::vector<double> numbers() const;
  std::vector<std::int32_t> integers() const;                // from 0
  std::vector<std::array<std::int32_t, 3>> triples() const;  // lists of three integers from 0
  // Strings that convert(text) turns into optional values; `what` they should be.
  template <class Convert>
  auto strings(Convert convert, std::string_view what) const {
    std::vector<typename decltype(convert(std::string_view()))::value_type> result(list());
    for (std::size_t i = 0; i < result.size(); ++i) {
      const auto& element = (*json_)[i];
      const auto value = element.is_string() ? convert(element.template get_ref<const std::string&>()) : std::nullopt;
      if (!value) (*this)[i].expected(what);
      result[i] = *value;
    }
    return result;
  }

 private:
  const Json* json_;
  std::string_view document_;
  std::string path_;
};

}  // namespace spacetime
