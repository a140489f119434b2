#include "protocol/json.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/limits.h"

namespace spacetime {
namespace {

constexpr std::size_t longest_excerpt = 120;  // bytes of the parser's own words that are passed on

// Receives the parser's events and builds the tree.  nlohmann's own builder keeps the last of repeated members and
// knows neither a depth nor where it is.
class Builder {
 public:
  Builder(std::string_view document, std::size_t bytes) : document_(document), bytes_(bytes) {}

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Json::number_integer_t value) { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(value); }
  bool binary(Json::binary_t&) { refuse("binary values have no place in a document"); }

  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool key(std::string& name) {
    open_.back().key = name;
    open_.back().keyed = true;
    return true;
  }
  bool end_array() { return close(); }
  bool end_object() {
    names_.clear();
    for (const auto& member : open_.back().json->get_ref<const Json::object_t&>()) names_.push_back(member.first);
    std::sort(names_.begin(), names_.end());
    if (const auto twice = std::adjacent_find(names_.begin(), names_.end()); twice != names_.end()) {
      throw DocumentError(document_, below(path(), *twice), "the member is there twice");
    }
    return close();
  }

  bool parse_error(std::size_t byte, const std::string& token, const Json::exception& error) {
    if (error.id == 406) refuse("expected a finite number, found " + token.substr(0, longest_excerpt));
    std::string reason = error.what();
    if (const auto start = reason.find("syntax error "); start != reason.npos) reason.erase(0, start + 13);
    if (reason.size() > longest_excerpt) reason.resize(longest_excerpt);
    if (open_.empty() && !root_.is_discarded()) {
      refuse("the text goes on after its end, at byte " + std::to_string(byte) + " (" + reason + ")");
    }
    if (byte > bytes_) refuse("the text ends too early, at byte " + std::to_string(bytes_) + " (" + reason + ")");
    refuse("not JSON at byte " + std::to_string(byte) + " (" + reason + ")");
  }

  Json take() { return std::move(root_); }

 private:
  struct Open {
    Json* json;       // the object or list; its parent does not grow while it is open, so it stays where it is
    std::string key;  // object: of the member that is being read
    bool keyed = false;
  };

  [[noreturn]] void refuse(const std::string& message) const { throw DocumentError(document_, path(), message); }

  // Of the value that is being read.
  std::string path() const {
    std::string result;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const auto& level = open_[i];
      if (level.json->is_array()) {
        result = below(result, level.json->size() - (i + 1 < open_.size() ? 1 : 0));
      } else if (level.keyed) {
        result = below(result, level.key);
      }
    }
    return result;
  }

  Json& place(Json&& value) {
    if (++values_ > limits::document_values) {
      refuse("more than " + std::to_string(limits::document_values) + " values, the limit of one document");
    }
    if (open_.empty()) return root_ = std::move(value);
    auto& level = open_.back();
    if (level.json->is_array()) return level.json->get_ref<Json::array_t&>().emplace_back(std::move(value));
    auto& members = level.json->get_ref<Json::object_t&>();
    if (members.size() == members.capacity()) {
      // Left to itself the vector would copy the values, whole trees, since its constant keys may throw when copied.
      Json::object_t grown;
      grown.reserve(std::max<std::size_t>(2, 2 * members.size()));
      for (auto& [name, json] : members) grown.emplace_back(name, std::move(json));
      members = std::move(grown);
    }
    return members.emplace_back(level.key, std::move(value)).second;
  }

  bool add(Json&& value) {
    place(std::move(value));
    if (!open_.empty()) open_.back().keyed = false;
    return true;
  }

  bool open(Json&& container) {
    if (open_.size() == limits::document_depth) {
      refuse("more than " + std::to_string(limits::document_depth) + " objects and lists inside one another");
    }
    open_.push_back({&place(std::move(container)), {}, false});
    return true;
  }

  bool close() {
    open_.pop_back();
    if (!open_.empty()) open_.back().keyed = false;
    return true;
  }

  std::string_view document_;
  std::size_t bytes_;
  Json root_ = Json(Json::value_t::discarded);
  std::size_t values_ = 0;
  std::vector<Open> open_;
  std::vector<std::string_view> names_;
};

std::string sentence(std::string_view document, std::string_view path, std::string_view message) {
  std::string text(document);
  text.append(": ");
  if (!path.empty()) text.append(path).append(": ");
  return text.append(message);
}

}  // namespace

DocumentError::DocumentError(std::string_view document, std::string path, std::string_view message)
    : InputError(sentence(document, path, message)), path_(std::move(path)) {}

Json parse(std::string_view text, std::string_view document) {
  if (text.size() > limits::document_bytes) {
    throw DocumentError(document, {},
                        std::to_string(text.size()) + " bytes of text, more than the limit of " +
                            std::to_string(limits::document_bytes));
  }
  Builder builder(document, text.size());
  Json::sax_parse(text, &builder);
  return builder.take();
}

}  // namespace spacetime
