// One peer's conversation with a daemon: requests in, answers out, in the session's own thread; what controls requests
// (cancel, hanging up) is done at once by whoever brings it.
#pragma once

#include <condition_variable>
#include <list>
#include <mutex>
#include <set>
#include <thread>

#include "protocol/framing.h"
#include "protocol/service.h"

namespace spacetime::protocol {

// Where messages go.  Called from any thread; none of these waits for the peer.
class Outlet {
 public:
  virtual ~Outlet() = default;
  virtual void send(std::string message) = 0;  // never dropped
  // A message that may be dropped when a newer one is offered before it could be sent.  One that has been offered
  // before a message is sent goes out before it.
  virtual void offer(std::function<std::string()> message) = 0;
  virtual bool full() const = 0;  // so much has not been taken by the peer that nothing more should be made for it
  virtual void ended() = 0;       // nothing more will be sent
};

class Conversation {
 public:
  Conversation(const Service& service, const Allowance& allowance, Outlet& outlet);
  ~Conversation();  // hangs up, and waits for the step that is being done
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  // Each returns at once.
  void receive(Frame frame);  // one message of the peer's, or why it is none
  void end_of_input();        // nothing more will be asked; what has been asked is still answered
  void hang_up();             // all work ends; what is done by then is answered
  void drained();             // the outlet is not full any more

  std::size_t waiting_bytes() const;  // of requests that are not served yet
  bool busy() const;                  // something is worked on, or waits

 private:
  // A request in its place.  Long messages are parsed by the session's thread, so that they hold up nobody else.
  struct Item {
    Request request;
    std::string text;  // where it is not parsed yet
    std::size_t bytes = 0;
    bool unread = false;  // not parsed yet, or just now
    bool passed = false;  // found to wait for the end of what is worked on
  };
  using Place = std::list<Item>::iterator;  // stays good while others come and go
  class Work;                               // a Call

  void enqueue(Item item);
  void control(const Request& request);
  void cancel(const std::string& id);
  std::optional<Request> understood(std::string_view text);
  void note(const Request& request);
  const Method* method_named(std::string_view name) const;
  bool renews(std::string_view name) const;
  Error present_error() const;
  Error beyond_memory() const;

  // The session's thread.
  void run();
  void serve_all();
  bool read(Place place, std::unique_lock<std::mutex>& lock);
  Request take(Place place);
  void serve(Request request, Work* running);
  void perform(Request& request, Writer& result, Work& work);
  void greet(const Node& params, Writer& result);
  Turn turn_of(const Request& request) const;
  bool go_on(Work& work, Call::Clock::time_point until);

  const Service& service_;
  const Allowance& allowance_;
  Outlet& outlet_;
  std::vector<Method> methods_;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable arrived_;
  std::list<Item> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::set<std::string> cancelled_;        // ids that may be in messages that are not parsed yet
  std::optional<std::string> running_;     // id of what is worked on
  bool working_ = false, cancel_ = false;  // ... and whether it was cancelled
  bool no_more_ = false, hung_up_ = false;
  std::optional<int> newest_;  // revision

  // The session's thread alone.
  enum class Stage { fresh, open, ending } stage_ = Stage::fresh;
  bool exit_ = false;
  std::thread thread_;
};

}  // namespace spacetime::protocol
