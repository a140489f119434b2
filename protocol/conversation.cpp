#include "protocol/conversation.h"

#include <algorithm>
#include <limits>
#include <new>

#include "common/diagnostic.h"
#include "common/nearest.h"
#include "protocol/memory.h"

namespace spacetime::protocol {
namespace {

// Messages up to this length are parsed as they come, which takes less than a millisecond.
constexpr std::size_t short_message = std::size_t{1} << 16;

constexpr std::string_view cancel_method = "$/cancelRequest";

Error before_its_turn() { return {Code::cancelled, "cancelled before its turn came"}; }

Error error_of(const Frame& frame, const Allowance& allowance) {
  if (frame.kind == Frame::Kind::too_long) {
    return {Code::too_long, frame.text, limit_data("message", allowance.message)};
  }
  return {Code::not_json, frame.text};
}

}  // namespace

class Conversation::Work final : public Call {
 public:
  Work(Conversation& conversation, const Request& request) : conversation_(conversation) {
    const Node params(request.params, "params");
    if (const auto number = params.find("revision")) revision = number->integer();
    if (const auto name = params.find("progress")) {
      if (!name->json().is_string() && !name->json().is_number_integer()) name->expected("a string or an integer");
      token_ = name->json().dump();
    } else {
      token_ = request.id.value_or("null");
    }
  }

  bool go_on(Clock::time_point until) override { return conversation_.go_on(*this, until); }
  void progress(std::function<std::string()> value) override {
    conversation_.outlet_.offer([token = token_, revision = revision, value = std::move(value)] {
      std::string params = "{\"token\":" + token;
      if (revision) params += ",\"revision\":" + std::to_string(*revision);
      return notification("$/progress", params + ",\"value\":" + value() + "}");
    });
  }

  std::optional<int> revision;

 private:
  Conversation& conversation_;
  std::string token_;
};

Conversation::Conversation(const Service& service, const Allowance& allowance, Outlet& outlet)
    : service_(service), allowance_(allowance), outlet_(outlet), methods_(service.open(allowance)), thread_([this] {
        run();
      }) {}

Conversation::~Conversation() {
  hang_up();
  thread_.join();
}

void Conversation::receive(Frame frame) {
  if (frame.kind != Frame::Kind::message) {
    outlet_.send(answer(std::nullopt, error_of(frame, allowance_)));
    if (frame.ends) end_of_input();
    return;
  }
  const std::size_t bytes = frame.text.size();
  if (bytes > short_message) return enqueue({{}, std::move(frame.text), bytes, true, false});
  auto request = understood(frame.text);
  if (!request) return;
  if (request->method == cancel_method) return control(*request);
  enqueue({std::move(*request), {}, bytes, false, false});
}

// The request that a message is; nothing where the peer has been told that it is none.
std::optional<Request> Conversation::understood(std::string_view text) {
  std::optional<std::string> id;
  try {
    Request request = read_request(text, static_cast<std::size_t>(allowance_.depth), id);
    if (request.method.empty()) return std::nullopt;
    note(request);
    return request;
  } catch (...) {
    const Unpaid unpaid;
    outlet_.send(answer(id, present_error()));
  }
  return std::nullopt;
}

// Takes note of the revision that a request brings.
void Conversation::note(const Request& request) {
  if (!renews(request.method) || !request.params.contains("revision")) return;
  const auto& revision = request.params["revision"];
  if (!revision.is_number_integer() || revision.get<double>() > std::numeric_limits<int>::max())
    return;  // refused later
  const std::lock_guard lock(mutex_);
  newest_ = std::max(newest_.value_or(0), revision.get<int>());
}

void Conversation::enqueue(Item item) {
  {
    const std::lock_guard lock(mutex_);
    if (static_cast<double>(waiting_.size()) < allowance_.waiting) {
      waiting_bytes_ += item.bytes;
      waiting_.push_back(std::move(item));
      arrived_.notify_one();
      return;
    }
  }
  const auto request = item.unread ? understood(item.text) : std::optional(std::move(item.request));
  if (!request || !request->id) return;
  outlet_.send(answer(request->id, beyond("waiting", allowance_, allowance_.waiting + 1)));
}

void Conversation::control(const Request& request) {
  try {
    const Node params(request.params, "params");
    params.object({"id"});
    const Node id = params["id"];
    if (!id.json().is_string() && !id.json().is_number_integer()) id.expected("a string or an integer");
    cancel(id.json().dump());
    if (request.id) outlet_.send(answer(request.id, "{}"));
  } catch (const InputError&) {
    if (request.id) outlet_.send(answer(request.id, present_error()));
  }
}

void Conversation::cancel(const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    if (working_ && running_ == id) {
      cancel_ = true;
      arrived_.notify_one();
      return;
    }
    const auto is_it = [&](const Item& item) { return item.request.id == id; };
    const auto found = std::ranges::find_if(waiting_, is_it);
    if (found == waiting_.end()) {
      // It may be in a message that is not parsed yet; else it has been answered.
      if (std::ranges::any_of(waiting_, &Item::unread) && static_cast<double>(cancelled_.size()) < allowance_.waiting) {
        cancelled_.insert(id);
      }
      return;
    }
    waiting_bytes_ -= found->bytes;
    waiting_.erase(found);
  }
  outlet_.send(answer(id, before_its_turn()));
}

void Conversation::end_of_input() {
  const std::lock_guard lock(mutex_);
  no_more_ = true;
  arrived_.notify_one();
}

void Conversation::hang_up() {
  const std::lock_guard lock(mutex_);
  no_more_ = hung_up_ = true;
  waiting_.clear();
  waiting_bytes_ = 0;
  arrived_.notify_one();
}

void Conversation::drained() {
  const std::lock_guard lock(mutex_);
  arrived_.notify_one();
}

std::size_t Conversation::waiting_bytes() const {
  const std::lock_guard lock(mutex_);
  return waiting_bytes_;
}

bool Conversation::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !waiting_.empty();
}

void Conversation::run() {
  {
    const Accounting accounting(allowance_.memory);
    serve_all();
    for (Method& method : methods_) method.perform = {};  // the session's state goes with its account
  }
  outlet_.ended();
}

void Conversation::serve_all() {
  while (!exit_) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      working_ = false;
      arrived_.wait(lock, [&] { return hung_up_ || (waiting_.empty() ? no_more_ : !outlet_.full()); });
      if (waiting_.empty()) break;
      if (!read(waiting_.begin(), lock)) continue;
      request = take(waiting_.begin());
      for (Item& item : waiting_) item.passed = false;
      working_ = true;
      running_ = request.id;
      cancel_ = false;
    }
    serve(std::move(request), nullptr);
  }
}

// Parses a request that waits, where that has not been done; false where nothing of it is left to do.
bool Conversation::read(Place place, std::unique_lock<std::mutex>& lock) {
  if (!place->unread) return true;
  const std::string text = std::move(place->text);
  lock.unlock();
  auto request = understood(text);
  lock.lock();
  if (hung_up_) return false;  // it is gone; nobody else takes away what is not parsed
  const bool cancelled = request && request->id && cancelled_.erase(*request->id) > 0;
  if (!request || cancelled) {
    const Unpaid unpaid;
    if (cancelled) outlet_.send(answer(request->id, before_its_turn()));
    take(place);
    return false;
  }
  place->request = std::move(*request);
  place->unread = false;
  return true;
}

Request Conversation::take(Place place) {
  Request request = std::move(place->request);
  waiting_bytes_ -= place->bytes;
  waiting_.erase(place);
  if (waiting_.empty()) cancelled_.clear();
  return request;
}

// Answers one request; `running` is what is worked on meanwhile, if anything.
void Conversation::serve(Request request, Work* running) {
  try {
    if (request.method == "rpc.discover") {
      Node(request.params, "params").object({});
      if (request.id) outlet_.send(answer(request.id, service_.description));
      return;
    }
    Writer result(false);
    Work work(*this, request);
    result.object([&] {
      perform(request, result, work);
      if (work.revision) result.member("revision", *work.revision);
    });
    if (running && work.revision && renews(request.method)) running->revision = work.revision;
    if (request.id) outlet_.send(answer(request.id, result.take()));
  } catch (...) {
    const Unpaid unpaid;
    if (request.id) outlet_.send(answer(request.id, present_error()));
  }
}

// The exception that is being handled, as the peer is told of it.
Error Conversation::present_error() const {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const DocumentError& error) {
    return {Code::bad_parameters, error.what(), path_data(error.path())};
  } catch (const InputError& error) {
    return {Code::refused, error.what()};
  } catch (const AccountExceeded&) {
    return beyond_memory();
  } catch (const std::bad_alloc&) {
    return {Code::out_of_memory, "this needs more memory than there is: ask for less"};
  } catch (const std::exception& error) {
    return {Code::internal, std::string("a mistake of the daemon's own, please report it: ") + error.what()};
  }
}

Error Conversation::beyond_memory() const {
  return {
      Code::out_of_memory,
      "this session would hold more memory than it may: ask for less, or start the daemon with a higher --limit-memory",
      limit_data("memory", allowance_.memory)};
}

void Conversation::perform(Request& request, Writer& result, Work& work) {
  if (request.method == "exit") {
    exit_ = true;
    return;
  }
  if (request.method == "initialize") return greet(Node(request.params, "params"), result);
  if (stage_ == Stage::fresh) throw Error(Code::not_initialised, "send \"initialize\" first");
  if (stage_ == Stage::ending) throw Error(Code::ending, "after \"shutdown\" there is only \"exit\"");
  if (request.method == "shutdown") {
    Node(request.params, "params").object({});
    stage_ = Stage::ending;
    return;
  }
  const Method* method = method_named(request.method);
  if (!method) {
    std::vector<std::string> names{"initialize", "shutdown", "exit", "$/cancelRequest", "rpc.discover"};
    for (const Method& one : methods_) names.emplace_back(one.name);
    throw Error(Code::unknown_method, "there is no method \"" + request.method + "\"" +
                                          suggestion(request.method, names, "see rpc.discover", '"'));
  }
  {
    const std::lock_guard lock(mutex_);
    if (work.revision && newest_ && *work.revision < *newest_) {
      throw Error(Code::stale, "revision " + std::to_string(*work.revision) + " has given way to revision " +
                                   std::to_string(*newest_));
    }
  }
  method->perform(Node(request.params, "params"), result, work);
}

void Conversation::greet(const Node& params, Writer& result) {
  if (stage_ != Stage::fresh) throw Error(Code::refused, "\"initialize\" comes once, at the beginning");
  params.object({"protocol"}, {"client"});
  if (params["protocol"].integer() != protocol_version) {
    throw Error(Code::unknown_version, "this daemon speaks version 1 of the protocol", "{\"protocols\":[1]}");
  }
  if (const auto client = params.find("client")) {
    client->object({"name"}, {"version"});
    client->operator[]("name").string();
  }
  stage_ = Stage::open;
  result.member("protocol", protocol_version);
  result.key("daemon");
  result.object([&] {
    result.member("name", service_.name);
    result.member("version", service_.version);
  });
  result.key("methods");
  result.list([&] {
    for (const Method& method : methods_) result.string(method.name);
  });
  result.key("limits");
  result.object([&] {
    for (const Bound& bound : bounds) {
      result.key(bound.name);
      result.json(amount(allowance_.*bound.value));
    }
  });
}

const Method* Conversation::method_named(std::string_view name) const {
  const auto found = std::ranges::find(methods_, name, &Method::name);
  return found == methods_.end() ? nullptr : &*found;
}

bool Conversation::renews(std::string_view name) const {
  const Method* method = method_named(name);
  return method && method->renews;
}

Turn Conversation::turn_of(const Request& request) const {
  if (request.method == "shutdown") return Turn::ends;
  if (request.method == "rpc.discover" || request.method == "initialize") return Turn::between;
  const Method* method = method_named(request.method);
  if (!method) return request.method == "exit" ? Turn::waits : Turn::between;
  return method->turn ? method->turn(request.params) : Turn::waits;
}

// What can be done between two steps is done in its order, past runs that wait: an edit is not held up by what is to
// come after the run that it is meant for.  Nothing passes what ends the run, or the connection.
bool Conversation::go_on(Work& work, Call::Clock::time_point until) {
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      if (cancel_ || hung_up_) return false;
      if (outlet_.full()) return true;
      const auto place = std::ranges::find(waiting_, false, &Item::passed);
      if (place == waiting_.end()) {
        if (Call::Clock::now() >= until) return true;
        arrived_.wait_until(lock, until);
        continue;
      }
      if (!read(place, lock)) continue;
      const Turn turn = turn_of(place->request);
      if (turn == Turn::ends) return false;
      if (place->request.method == "exit") return !cancel_;
      if (turn == Turn::waits) {
        place->passed = true;
        continue;
      }
      request = take(place);
    }
    serve(std::move(request), &work);
  }
}

}  // namespace spacetime::protocol
