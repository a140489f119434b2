// Update as a pure function, on events made by hand: no daemon, no file, no clock.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gui/update.h"

namespace spacetime::gui {

// A session whose daemons answer when the test says so.
struct Table {
  State state;
  std::vector<Request> requests;  // not answered yet
  std::vector<Effect> others;

  void feed(const Event& event) {
    for (Effect& effect : update(state, event)) {
      if (auto* request = std::get_if<Request>(&effect)) {
        requests.push_back(*request);
      } else {
        others.push_back(effect);
      }
    }
  }
  Request take(const std::string& method) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (requests[i].method != method) continue;
      Request request = requests[i];
      requests.erase(requests.begin() + static_cast<std::ptrdiff_t>(i));
      return request;
    }
    ADD_FAILURE() << "nobody asked for " << method;
    return {};
  }
  int count(const std::string& method) const {
    return static_cast<int>(std::ranges::count(requests, method, &Request::method));
  }

  // Compiles a text of one line a statement, each line that begins with a capital letter a declaration.
  void compile() {
    const Request request = take("scene/compile");
    auto scene = std::make_shared<Scene>();
    auto problem = std::make_shared<Problem>();
    scene->text = request.text;
    std::size_t begin = 0;
    for (int line = 1; begin < request.text.size(); ++line) {
      const std::size_t end = std::min(request.text.find('\n', begin), request.text.size());
      Statement statement;
      statement.text = request.text.substr(begin, end - begin);
      statement.word = statement.text.substr(0, statement.text.find(' '));
      statement.line = line;
      statement.begin = begin;
      statement.end = end;
      statement.action = statement.word != "time";
      if (statement.word == "solve") problem->actions.push_back({Solve{}, {line, 1}});
      if (statement.word == "iterate") problem->actions.push_back({Iterate{}, {line, 1}});
      if (statement.word == "set") problem->actions.push_back({SetConstant{"k", {1, {}, 0}}, {line, 1}});
      if (statement.word == "wrong") scene->diagnostics.push_back({{line, 1, 5}, "this is wrong", {}});
      scene->outline.push_back(std::move(statement));
      begin = end + 1;
    }
    if (scene->diagnostics.empty()) scene->problem = problem;
    feed(Compiled{request.number, scene});
  }
  void reach(int iterations) {
    const Request request = take("motion/get");
    auto motion = std::make_shared<Motion>();
    motion->iterations = iterations;
    Trajectory x;
    x.name = "x";
    x.basis.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    x.coefficients = std::vector<double>(4, iterations);
    motion->dofs = {x};
    feed(Reached{
        request.number, motion, std::make_shared<std::string>("{\"at\":" + std::to_string(iterations) + "}"), {}});
  }
  void done(const Request& request, std::vector<Logged> log, bool run = false) {
    feed(Done{request.number, std::move(log), run, Status::converged, "done"});
  }
  void acknowledge(const Request& request) { feed(Acknowledged{request.number}); }

  void open() {
    feed(OpenText{"time\n"});
    compile();
    acknowledge(take("problem/load"));
    reach(0);
  }
  void set() {
    feed(Act{"set k"});
    compile();
    const Request request = take("action/do");
    done(request, {{request.params.substr(9), ""}});
  }
  Request solve() {
    feed(Act{"solve"});
    compile();
    return take("action/do");
  }
};

}  // namespace spacetime::gui
