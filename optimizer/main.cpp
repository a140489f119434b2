// spacetime-optimizer: from a problem to a motion.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "common/diagnostic.h"
#include "common/files.h"
#include "optimizer/run.h"
#include "optimizer/server.h"
#include "optimizer/summary.h"
#include "protocol/check.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "protocol/serve_command.h"

namespace {

using namespace spacetime;

enum Exit { converged = 0, bad_input = 1, stopped = 2, infeasible = 3 };

volatile sig_atomic_t interrupts = 0;

// The first Ctrl-C ends the run, with the motion reached; the second ends the program.
void on_interrupt(int) {
  interrupts = interrupts + 1;
  if (interrupts > 1) _exit(128 + SIGINT);
}

struct Arguments {
  std::string problem = "-", output = "-", start;
  double samples = 0;
  std::optional<double> tolerance;
  std::optional<int> iterations;
  int threads = 0;
  std::vector<std::string> show;
  bool record = false, checkpoint = false, anew = false, quiet = false;
};

int exit_code(Status status) {
  switch (status) {
    case Status::converged:
      return converged;
    case Status::infeasible:
      return infeasible;
    case Status::stopped:
    case Status::failed:
      break;
  }
  return stopped;
}

int solve(const Arguments& arguments) {
  const Problem problem = read_problem(read_text(arguments.problem));
  optimizer::RunOptions options;
  if (!arguments.start.empty()) {
    options.start = read_motion(read_text(arguments.start));
    if (arguments.anew) options.start->checkpoint.reset();
    if (const auto fault = validate(*options.start, problem)) {
      throw DocumentError(motion_document, fault->path, fault->message + "; or start --anew from the motion alone");
    }
  }
  options.tolerance = arguments.tolerance;
  options.iterations = arguments.iterations;
  options.threads = arguments.threads;
  options.frames_per_second = arguments.samples;
  options.record = arguments.record;
  options.checkpoint = arguments.checkpoint;
  options.interrupted = [] { return interrupts > 0; };
  std::vector<optimizer::Show> shows;
  for (const std::string& text : arguments.show) shows.push_back(optimizer::parse_show(problem, text));
  if (!arguments.quiet) {
    std::cerr << optimizer::question(problem) << optimizer::heading();
    options.progress = [](const IterationRecord& progress) { std::cerr << optimizer::line(progress); };
  }

  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);

  Motion motion = optimizer::run(problem, options);
  if (motion.checkpoint) motion.checkpoint->problem = fingerprint(problem);
  write_text(arguments.output, write(motion));
  if (!arguments.quiet) std::cerr << optimizer::summary(problem, motion, shows);
  return exit_code(motion.status);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Turns a problem into a motion: finds the trajectories that keep the constraints and are best.",
               "spacetime-optimizer"};
  app.set_version_flag("--version", "spacetime-optimizer " SPACETIME_VERSION);
  app.footer(
      "Example:\n  spacetime-symbolic compile examples/throw.scene | spacetime-optimizer solve > throw.motion.json");

  Arguments arguments;
  const auto positive = [](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return *end == '\0' && std::isfinite(value) && value > 0 ? "" : "expected a positive number, found '" + text + "'";
  };
  CLI::App* command = app.add_subcommand(
      "solve",
      "Runs the problem's actions, or solves where it has none.\n"
      "Exits 0 when converged, 2 when it stopped short of the tolerance (the motion is still written),\n"
      "3 when no feasible motion was found, 1 on bad input.");
  command->add_option("problem", arguments.problem, "The problem, a file or - for standard input")
      ->capture_default_str();
  command->add_option("-o,--output", arguments.output, "Where the motion goes, - for standard output")
      ->capture_default_str();
  command->add_option("--start", arguments.start,
                      "A motion to start from, instead of the keyframes; where it has a checkpoint, the run it was\n"
                      "taken from is resumed: with the same options the motion is the one of a run never interrupted");
  command->add_flag("--anew", arguments.anew, "Start from the motion alone, even where it has a checkpoint");
  command
      ->add_option("--samples", arguments.samples,
                   "Frames per second: also writes plotted expressions and body poses at that rate")
      ->check(positive);
  command->add_option("--tolerance", arguments.tolerance, "In place of the actions' own")->check(positive);
  command->add_option("--threads", arguments.threads, "Cores for many starts; the motion does not depend on them")
      ->check(CLI::Range(1, 256));
  command->add_option("--iterations", arguments.iterations, "At most so many a solve, in place of the actions' own")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--show", arguments.show,
                   "NAME@TIME: tell a plotted expression at a time (seconds, or a constant's name) in the summary")
      ->allow_extra_args(false);
  command->add_flag("--record", arguments.record, "Also write the record of all iterations");
  command->add_flag("--checkpoint", arguments.checkpoint,
                    "Also write a checkpoint into the motion, from which --start resumes bit for bit");
  command->add_flag("-q,--quiet", arguments.quiet, "No table of iterations and no summary on standard error");

  protocol::ServerOptions server;
  CLI::App* serving = protocol::add_serve_command(app, server);

  try {
    app.parse(argc, argv);
    if (command->parsed()) return solve(arguments);
    if (serving->parsed()) {
      protocol::serve(optimizer::service(), server);
      return 0;
    }
    std::cerr << app.help();
    return bad_input;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  } catch (const InputError& error) {
    std::cerr << "spacetime-optimizer: error: " << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    std::cerr << "spacetime-optimizer: error: the problem needs more memory than there is\n";
  }
  return bad_input;
}
