#include "protocol/rpc.h"

#include <algorithm>
#include <charconv>

#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime::protocol {
namespace {

constexpr std::size_t most_id_bytes = 256;
constexpr std::string_view message_name = "message";

std::optional<std::string> id_of(const Node& node) {
  const auto member = node.find("id");
  if (!member) return std::nullopt;
  const Json& json = member->json();
  if (!json.is_string() && !json.is_number_integer()) member->expected("a string or an integer");
  std::string text = json.dump();
  if (text.size() > most_id_bytes) member->refuse("an id of more than " + std::to_string(most_id_bytes) + " bytes");
  return text;
}

// The member "id" of a message that cannot be read as a whole, so that whoever waits for its answer gets one; nothing
// where it is no JSON, or the member is not there once.
std::optional<std::string> id_within(std::string_view text) {
  std::optional<std::string> found;
  std::size_t depth = 0, value = text.npos;  // ... where a value of the outermost object begins
  std::string_view name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char character = text[i];
    if (character == '"') {
      const std::size_t begin = i;
      for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
      if (depth == 1 && value == text.npos) name = text.substr(begin, std::min(i + 1, text.size()) - begin);
    } else if (character == ':' && depth == 1 && value == text.npos) {
      value = i + 1;
    } else if (depth == 1 && (character == ',' || character == '}')) {
      if (name == "\"id\"" && value != text.npos) {
        if (found) return std::nullopt;
        found = text.substr(value, i - value);
      }
      value = text.npos;
    }
    if (character == '{' || character == '[') ++depth;
    if ((character == '}' || character == ']') && depth > 0) --depth;
  }
  if (!found || !Json::accept(text)) return std::nullopt;
  const Json id = Json::parse(*found);
  found = id.dump();
  return (id.is_string() || id.is_number_integer()) && found->size() <= most_id_bytes ? found : std::nullopt;
}

// One copy of what may be long, with room for what frames it.
std::string joined(std::initializer_list<std::string_view> parts) {
  constexpr std::size_t framing = 64;
  std::size_t size = framing;
  for (const auto part : parts) size += part.size();
  std::string whole;
  whole.reserve(size);
  for (const auto part : parts) whole += part;
  return whole;
}

std::string opened(const std::optional<std::string>& id) {
  return "{\"jsonrpc\":\"2.0\",\"id\":" + id.value_or("null") + ",";
}

}  // namespace

std::size_t depth_of(std::string_view text, std::size_t most) {
  std::size_t depth = 0, deepest = 0;
  for (std::size_t i = 0; i < text.size() && deepest <= most; ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        break;
      case '[':
      case '{':
        deepest = std::max(deepest, ++depth);
        break;
      case ']':
      case '}':
        if (depth > 0) --depth;
        break;
      default:
        break;
    }
  }
  return deepest;
}

Request read_request(std::string_view text, std::size_t depth, std::optional<std::string>& id) {
  if (depth_of(text, depth) > depth) {
    id = id_within(text);
    throw Error(Code::too_deep,
                "more than " + std::to_string(depth) + " objects and lists inside one another: send it flatter",
                limit_data("depth", static_cast<double>(depth)));
  }
  Json tree;
  try {
    tree = parse(text, message_name);
  } catch (const DocumentError& error) {
    id = id_within(text);
    throw Error(Code::not_json, error.what());
  }
  try {
    const Node node(tree, message_name);
    if (tree.is_array()) node.refuse("send requests one by one, not as a list");
    if (node.find("result") || node.find("error")) return {};
    id = id_of(node);
    node.object({"jsonrpc", "method"}, {"id", "params"});
    if (node["jsonrpc"].string() != "2.0") node["jsonrpc"].expected("\"2.0\"");
    Request request{id, node["method"].string(), Json::object()};
    if (const auto params = node.find("params"); params && !params->is_null()) {
      if (!params->is_object()) params->expected("an object (parameters go by name)");
      request.params = std::move(tree["params"]);
    }
    return request;
  } catch (const DocumentError& error) {
    throw Error(Code::not_a_request, error.what());
  }
}

std::string answer(const std::optional<std::string>& id, std::string_view result) {
  return joined({opened(id), "\"result\":", result, "}"});
}

std::string answer(const std::optional<std::string>& id, const Error& error) {
  // A sentence may quote what is no UTF-8.
  std::string text = opened(id) + "\"error\":{\"code\":" + std::to_string(static_cast<int>(error.code())) +
                     ",\"message\":" + Json(error.what()).dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!error.data().empty()) text.append(",\"data\":").append(error.data());
  return text.append("}}");
}

std::string notification(std::string_view method, std::string_view params) {
  return joined({"{\"jsonrpc\":\"2.0\",\"method\":\"", method, "\",\"params\":", params, "}"});
}

std::string request(std::string_view id, std::string_view method, std::string_view params) {
  return joined({"{\"jsonrpc\":\"2.0\",\"id\":", id, ",\"method\":\"", method, "\",\"params\":", params, "}"});
}

std::string amount(double number) {
  char digits[512];
  return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed).ptr};
}

std::string path_data(std::string_view path) {
  Writer to(false);
  to.object([&] { to.member("path", path); });
  return to.take();
}

std::string limit_data(std::string_view name, double most) {
  Writer to(false);
  to.object([&] {
    to.member("limit", name);
    to.key("most");
    to.json(amount(most));
    to.member("option", "--limit-" + std::string(name));
  });
  return to.take();
}

}  // namespace spacetime::protocol
