#include "gui/command_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/diagnostic.h"
#include "common/files.h"
#include "common/sample.h"
#include "gui/render/chart.h"
#include "gui/render/compose.h"
#include "gui/render/film.h"
#include "gui/render/offscreen.h"
#include "gui/render/pattern.h"
#include "gui/render/place_marks.h"
#include "gui/render/renderer.h"
#include "gui/render/target.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"

namespace spacetime::gui {
namespace {

constexpr int samples_a_pixel = 4;
constexpr int most_frames = 100000;  // an hour at 28 a second; more is a slip of the pen

struct Options {
  std::string motion, output, problem, size, view, camera, theme = "light";
  double rate = 30;
  int strip = 0;
  bool apart = false;
  std::optional<double> at, from, to;
  std::vector<std::string> trails, curves;
};

volatile std::sig_atomic_t interrupts = 0;
void on_interrupt(int) { interrupts = interrupts + 1; }

struct Size {
  int width = 0, height = 0;
};

Size size_of(const std::string& text, Size size) {
  if (text.empty()) return size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 || size.width < 16 ||
      size.height < 16) {
    throw InputError("'" + text + "' is no size of pictures: write it like 1280x720, each edge at least 16 pixels");
  }
  return size;
}

constexpr Size usual_size{1280, 720};
constexpr int chart_width = 1000, panel_height = 240, chart_margins = 70;  // pixels, where no size is asked for
constexpr int chart_times = 1000;                                          // more than a curve has pixels

std::optional<View> view_of(const std::string& name) {
  if (name == "front") return View::front;
  if (name == "side") return View::side;
  if (name == "top") return View::top;
  if (name == "free") return View::free;
  return std::nullopt;
}

void make_folder_of(const std::string& file) {
  const auto folder = std::filesystem::path(file).parent_path();
  if (folder.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw InputError("the folder '" + folder.string() + "' cannot be made: " + failed.message());
}

Theme theme_of(const Options& options) { return options.theme == "dark" ? Theme::dark : Theme::light; }

// Everything that pictures of one motion share.
class Studio {
 public:
  Studio(const Figures& figures, const Motion& motion, std::vector<NamedPlace> places, const Options& options)
      : size_(size_of(options.size, usual_size)),
        target_(size_.width, size_.height, samples_a_pixel),
        places_(std::move(places)),
        theme_(theme_of(options)) {
    Box room = figures.bounds(motion);
    for (const NamedPlace& place : places_) room.include(place.at);
    stand(room, options);
  }

  // Where all of a room can be seen.
  void stand(const Box& bounds, const Options& options) {
    if (!options.camera.empty()) {
      camera_ = read_camera(options.camera);
      return;
    }
    const auto view = view_of(options.view).value_or(planar(bounds) ? View::front : View::free);
    camera_ = overview(bounds, view, {size_.width, size_.height});
  }

  Size size() const { return size_; }
  Image shoot(const Picture& picture) {
    target_.bind();
    renderer_.draw(picture, camera_, size_.width, size_.height);
    Image image = target_.read();
    mark(image, places_, camera_, theme_);
    return image;
  }

 private:
  Size size_;
  Offscreen context_;
  Renderer renderer_;
  Target target_;
  std::vector<NamedPlace> places_;
  Theme theme_;
  Camera camera_;
};

// The pictures of a whole motion, to `take` one by one; false where Ctrl-C ended it early.
template <class Take>
bool play(const Figures& figures, const Motion& motion, const Options& options, const Look& look, Studio& studio,
          Take take) {
  if ((motion.end - motion.start) * options.rate > most_frames) {
    throw InputError("more than " + std::to_string(most_frames) + " pictures: choose a lower --rate");
  }
  const auto times = frame_times(motion.start, motion.end, options.rate);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (interrupts > 0) {
      std::cerr << "\nstopped after " << k << " of " << times.size() << " pictures\n";
      return false;
    }
    take(static_cast<int>(k), studio.shoot(moment(figures, motion, times[k], look)));
    std::cerr << "\rpicture " << k + 1 << " of " << times.size() << std::flush;
  }
  std::cerr << '\n';
  return true;
}

enum Exit { done = 0, interrupted = 2 };

int draw(const Options& options, const Figures& figures, const Motion& motion, const Problem* problem) {
  const Look look{theme_of(options), options.trails};
  for (const std::string& trail : look.trails) figures.way(motion, trail, std::vector{motion.start});  // is there one?
  const auto pattern = pattern_of(options.output);
  const auto extension = std::filesystem::path(options.output).extension();
  const bool film = extension == ".mp4";
  if (!film && extension != ".png") {
    throw InputError("pictures are written as .png, a film as .mp4, curves (--curves) as .png or .svg: '" +
                     options.output + "' is none of them");
  }
  if (pattern && (film || options.strip > 0 || options.at)) {
    throw InputError("'" + options.output + "' numbers many files, but one is asked for");
  }
  if (!pattern && !film && options.strip == 0 && !options.at) {
    throw InputError("'" + options.output + "' is one picture: say of which time (--at 0.5) or of how many poses " +
                     "(--strip 12), or number the pictures (-o 'frames/%04d.png')");
  }
  if (film && (options.strip > 0 || options.at)) throw InputError("one picture is no film: write it as .png");
  if (options.apart && (options.strip == 0 || !look.trails.empty()))
    throw InputError("--apart sets the poses of a --strip side by side, where trails have no place");
  if (options.at && (*options.at < motion.start || *options.at > motion.end)) {
    throw InputError("the motion has no time " + std::to_string(*options.at) + ": it lasts from " +
                     std::to_string(motion.start) + " to " + std::to_string(motion.end) + " s");
  }

  // Side by side, places would be those of one pose.
  Studio studio(figures, motion, problem && !options.apart ? places_in(*problem, motion) : std::vector<NamedPlace>(),
                options);
  make_folder_of(options.output);
  if (options.apart) {
    const Picture picture = apart(figures, motion, options.strip, look);
    studio.stand(bounds(picture), options);
    write_png(options.output, studio.shoot(picture));
    return done;
  }
  if (options.strip > 0) {
    write_png(options.output, studio.shoot(strip(figures, motion, options.strip, look)));
    return done;
  }
  if (options.at) {
    write_png(options.output, studio.shoot(moment(figures, motion, *options.at, look)));
    return done;
  }
  if (pattern) {
    const auto write = [&](int k, const Image& image) { write_png(pattern->file(k), image); };
    return play(figures, motion, options, look, studio, write) ? done : interrupted;
  }
  FilmFile out(options.output, studio.size().width, studio.size().height, options.rate);
  const bool whole = play(figures, motion, options, look, studio, [&](int, const Image& image) { out.add(image); });
  out.finish();
  return whole ? done : interrupted;
}

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= list.size();) {
    const auto end = std::min(list.find(',', at), list.size());
    words.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

int draw_curves(const Options& options, const Motion& motion, const Problem* problem) {
  if (options.at || options.strip > 0 || !options.trails.empty())
    throw InputError("curves are drawn by themselves, without --at, --strip and --trail");
  const auto extension = std::filesystem::path(options.output).extension();
  if (extension != ".png" && extension != ".svg")
    throw InputError("curves are written as .png or .svg: '" + options.output + "' is neither");
  Chart chart{even_times(motion.start, motion.end, chart_times), {}, theme_of(options)};
  for (const std::string& list : options.curves) {
    auto& panel = chart.panels.emplace_back();
    for (const std::string& name : words_of(list))
      for (Curve& curve : curves_of(motion, problem, name, chart.times)) panel.push_back(std::move(curve));
  }
  const auto panels = static_cast<int>(chart.panels.size());
  const Size size = size_of(options.size, {chart_width, panels * panel_height + chart_margins});
  const Drawing drawing = draw(chart, size.width, size.height);
  make_folder_of(options.output);
  if (extension == ".svg")
    write_text(options.output, svg(drawing));
  else
    write_png(options.output, raster(drawing));
  return done;
}

// A problem's expressions take the motion's trajectories and numbers by name.
void check_belongs(const Problem& problem, const Motion& motion) {
  const auto require = [](bool there, const std::string& name) {
    if (!there) throw InputError("the problem is not this motion's: the motion has no '" + name + "'");
  };
  const auto has = [](const auto& list, const std::string& name) {
    return std::ranges::any_of(list, [&](const auto& entry) { return entry.first == name; });
  };
  for (const Dof& dof : problem.dofs)
    require(std::ranges::find(motion.dofs, dof.name, &Trajectory::name) != motion.dofs.end(), dof.name);
  for (const Constant& constant : problem.constants) require(has(motion.constants, constant.name), constant.name);
  for (const Parameter& parameter : problem.parameters) require(has(motion.parameters, parameter.name), parameter.name);
}

// The motion as if it were the part that is asked for.
void narrow(Motion& motion, const Options& options) {
  const double from = options.from.value_or(motion.start), to = options.to.value_or(motion.end);
  if (from < motion.start || to > motion.end || !(from < to)) {
    throw InputError(fmt::format("there is no motion from {} to {} s: it lasts from {} to {} s", from, to, motion.start,
                                 motion.end));
  }
  motion.start = from;
  motion.end = to;
}

int run(const Options& options) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  Motion motion = read_motion(read_text(options.motion));
  const auto problem = options.problem.empty() ? std::nullopt : std::optional(read_problem(read_text(options.problem)));
  if (problem) check_belongs(*problem, motion);
  narrow(motion, options);
  if (!options.curves.empty()) return draw_curves(options, motion, problem ? &*problem : nullptr);
  const Figures figures = problem ? Figures(*problem) : Figures(motion);
  if (figures.empty()) {
    throw InputError("there is nothing to draw: the motion has no bodies and no degrees of freedom of its own");
  }
  return draw(options, figures, motion, problem ? &*problem : nullptr);
}

}  // namespace

Command add_render(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render",
                                         "Draws a motion into files, without a window: numbered pictures, a film, "
                                         "one picture, or curves.\nCtrl-C stops it; what is finished stays.");
  command->add_option("MOTION", options->motion, "The motion, a file or - for standard input")->required();
  command
      ->add_option("-o,--output", options->output,
                   "frames/%04d.png: numbered pictures; film.mp4: a film (by ffmpeg); one .png with "
                   "--at or --strip; .png or .svg with --curves")
      ->required();
  command->add_option("--rate", options->rate, "Pictures a second")
      ->check([](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return *end == '\0' && value > 0 && value <= 1000 ? ""
                                                          : "expected a number from 0 to 1000, found '" + text + "'";
      })
      ->capture_default_str();
  command->add_option("--from", options->from, "Only from this time on (s)");
  command->add_option("--to", options->to, "Only up to this time (s)");
  command->add_option("--size", options->size, "Of a picture, in pixels: 1280x720 unless said");
  command->add_option("--view", options->view, "From where; by default front where all moves in a plane, else free")
      ->check(CLI::IsMember({"front", "side", "top", "free"}));
  command
      ->add_option(
          "--camera", options->camera,
          "From exactly there: X,Y,Z,YAW,PITCH,DISTANCE in metres and degrees, of the point that is looked at, "
          "the angles about it and how far the eye is from it; and ,orthographic")
      ->excludes("--view");
  command->add_option("--theme", options->theme, "Light or dark")
      ->check(CLI::IsMember({"light", "dark"}))
      ->capture_default_str();
  command->add_option("--at", options->at, "One picture, at this time (s)");
  command->add_option("--strip", options->strip, "One picture of so many poses, paler the earlier they are")
      ->check(CLI::Range(2, 200));
  command->add_flag("--apart", options->apart, "With --strip: the poses side by side instead of over one another");
  command
      ->add_option("--trail", options->trails,
                   "Also draw the way of a body, a creature's last body, or a named point; may be repeated")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--curves", options->curves,
          "Curves against time, in one panel: degrees of freedom, creatures, either's derivatives (arm.elbow', "
          "arm''), named expressions; commas between; may be repeated for more panels")
      ->allow_extra_args(false);
  command->add_option("--problem", options->problem,
                      "The motion's problem, a file or -: then every named expression can be drawn as a curve, and "
                      "constants that are places (BasketX and BasketY) are marked in pictures");
  return {command, [options] { return run(*options); }};
}

}  // namespace spacetime::gui
