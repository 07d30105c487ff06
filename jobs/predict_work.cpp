#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/cutting/carve.hpp"
#include "core/path/arc.hpp"
#include "jobs/definitions.hpp"
#include "jobs/limits.hpp"
#include "jobs/page.hpp"
#include "jobs/predict_case.hpp"
#include "jobs/predict_page.hpp"
#include "jobs/predict_work.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::HeightMap;
using cutting::Station;
using cutting::StationError;
using Eigen::Vector3d;

constexpr double arc_tolerance = 0.002;  // chords of an arc [mm]
constexpr double most_nodes = 16e6;      // of a stock's height map
constexpr int most_stations = 1'000'000;
constexpr double steepest = 0.99;  // sine: a plunge has no side that could be left or cut

// The stock before the path: a block with a flat top, or a height map, Z up.
HeightMap read_stock(const Value& value, double radius) {
  Object object(value);
  const double usual = std::clamp(radius / 40, 0.01, 1.0);
  if (const std::optional<Value> min = object.optional("min")) {
    const Vector3d low = min->vector3(coordinate_range);
    const Value max = object.required("max");
    const Vector3d high = max.vector3(coordinate_range);
    if (!((high - low).minCoeff() > 0)) max.refuse("greater than min in X, Y and Z");
    const double cell = object.number("cell", between(1e-3, 10, "mm"), usual);
    if (!((high.x() - low.x()) / cell * ((high.y() - low.y()) / cell) <= most_nodes)) {
      object.refuse("cell", "so large that the stock has at most 16 million cells");
    }
    object.finish();
    return cutting::block_map(low, high, cell);
  }
  HeightMap map;
  const std::vector<Value> origin = object.required("origin").array(2, 2);
  map.origin = {origin[0].number(coordinate_range), origin[1].number(coordinate_range)};
  map.cell = object.number("cell", between(1e-3, 10, "mm"));
  map.columns = object.required("columns").integer(2, 20'000);
  const Value heights = object.required("heights");
  map.heights = heights.numbers(coordinate_range);
  const auto columns = static_cast<std::size_t>(map.columns);
  if (map.heights.size() % columns != 0 || map.heights.size() < 2 * columns) {
    heights.refuse("at least two whole rows of " + std::to_string(columns) + " heights");
  }
  map.rows = static_cast<int>(map.heights.size() / columns);
  object.finish();
  return map;
}

// One place of the path and the move that it is on.
struct Place {
  Station station;
  std::size_t move = 0;
  bool cuts = false;  // at a feed, and not a plunge
  double way = 0;     // from the start of the program [mm]
  Vector3d from;      // ball centre at the place before
};

// Places along every move, at its end and at most `step` apart.
std::vector<Place> places_of(const WorkPath& work, const Vector3d& to_centre, double step,
                             double teeth_per_second) {
  std::vector<Place> out;
  Vector3d at = work.motion.start;
  double way = 0;
  for (std::size_t m = 0; m < work.motion.moves.size(); ++m) {
    const path::Move& move = work.motion.moves[m];
    const Vector3d chord = move.to - at;
    const double length = chord.norm();
    if (length < 1e-9) continue;
    const bool rapid = move.kind == path::MoveKind::Rapid;
    const double wanted = rapid ? 1 : std::ceil(length / step - 1e-9);
    if (!(static_cast<double>(out.size()) + wanted <= most_stations)) {
      refuse({.field = "/along/step",
              .value = text(step) + " mm",
              .limit = "so large that the path has at most 1000000 stations"});
    }
    const int parts = static_cast<int>(wanted);
    for (int i = 1; i <= parts; ++i) {
      Place place;
      place.from = at + chord * (static_cast<double>(i - 1) / parts) + to_centre;
      place.station.centre = at + chord * (static_cast<double>(i) / parts) + to_centre;
      place.station.direction = chord / length;
      place.station.n = Vector3d::UnitZ();
      place.station.feed = move.feed / teeth_per_second;
      place.cuts = !rapid && std::abs(place.station.direction.dot(work.tool_axis)) < steepest;
      place.move = m;
      place.way = way + length * i / parts;
      out.push_back(std::move(place));
    }
    way += length;
    at = move.to;
  }
  return out;
}

// The wanted surface's normal across the feed.
void set_normals(const WorkPath& work, std::vector<Place>& places) {
  for (Place& place : places) {
    if (!place.cuts) continue;
    const Vector3d& fd = place.station.direction;
    const Vector3d wanted = work.normal(place.station.centre);
    const Vector3d across = wanted - wanted.dot(fd) * fd;
    constexpr double none = 0.05;  // sine of the angle to the feed
    if (across.norm() < none) {
      place.cuts = false;
      continue;
    }
    place.station.n = across.normalized();
  }
}

// The stock that the tool meets: what has gone by at least `lag` of path is taken away. Nearer, the
// ball is where it cuts, in front of what it takes away there.
class Remaining {
public:
  Remaining(const HeightMap& stock, const std::vector<Place>& places, double radius)
      : map_(std::make_shared<HeightMap>(stock)), places_(places), radius_(radius) {}

  std::shared_ptr<const HeightMap> before(std::size_t i) {
    constexpr double lag = 0.25;  // of the radius
    for (; next_ < i && places_[i].way - places_[next_].way >= lag * radius_; ++next_) {
      cutting::carve(*map_, places_[next_].from, places_[next_].station.centre, radius_);
    }
    return map_;
  }

private:
  std::shared_ptr<HeightMap> map_;
  const std::vector<Place>& places_;
  double radius_;
  std::size_t next_ = 0;
};

// Is there stock at the contact? Where the ball meets only an edge, ahead of it, it makes nothing
// of the wanted surface.
bool makes_surface(const Station& station, double radius) {
  const Vector3d contact = station.centre - radius * station.n;
  return cutting::height_at(*station.stock.map, contact.x(), contact.y()) >= contact.z();
}

// One pass over the path, station after station, each on the stock that is left.
template <typename At>
std::vector<StationError> follow(const AlongJob& job, const HeightMap& stock,
                                 const std::vector<Place>& places, const Progress& progress,
                                 const At& at) {
  cutting::Follower follower(job.course, job.compliance, job.S(), job.options);
  Remaining remaining(stock, places, job.course.cutter.r);
  std::vector<StationError> out;
  std::size_t cutting = 0;
  const auto every = static_cast<std::size_t>(std::max(job.options.stability_every, 1));
  for (std::size_t i = 0; i < places.size(); ++i) {
    progress.at(static_cast<double>(i) / static_cast<double>(places.size()), "predict");
    if (!places[i].cuts) continue;
    Station station = places[i].station;
    station.stock.map = remaining.before(i);
    const bool makes = makes_surface(station, job.course.cutter.r);
    out.push_back(makes ? at(follower, station) : follower.at(station));
    if (!makes) out.back().e.reset();
    const bool is_tested = job.options.stability != cutting::StabilityTest::None && out.back().e &&
                           cutting++ % every == 0;
    if (is_tested) follower.test(station, out.back());
  }
  return out;
}

std::vector<Station> stations_of(const std::vector<Place>& places) {
  std::vector<Station> out;
  for (const Place& place : places) {
    if (place.cuts) out.push_back(place.station);
  }
  return out;
}

std::vector<std::size_t> entries_of(const std::vector<Place>& places) {
  std::vector<std::size_t> out;
  std::size_t station = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].cuts) continue;
    if (i == 0 || !places[i - 1].cuts) out.push_back(station);
    ++station;
  }
  return out;
}

/// What the page shows beside the path: the stock as a box, the ball.
nlohmann::json scene_of(const HeightMap& stock, const nlohmann::json& given, const tool::Tool& tool,
                        const Vector3d& tool_axis, const Vector3d& to_centre) {
  const auto [low, high] = std::ranges::minmax(stock.heights);
  const double floor = given.contains("min") ? given["min"][2].get<double>() : low;
  const Eigen::Vector2d far =
      stock.origin + stock.cell * Eigen::Vector2d(stock.columns - 1, stock.rows - 1);
  return {
      {"box",
       {{"min", {stock.origin.x(), stock.origin.y(), floor}}, {"max", {far.x(), far.y(), high}}}},
      {"tool", page_tool(tool, tool_axis, to_centre.norm())}};
}

AlongResult run(AlongJob& job, const HeightMap& stock, const std::vector<Place>& places,
                const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<Station> stations = stations_of(places);
  choose_tests(job, stations.size());
  AlongResult out;
  out.before = follow(job, stock, places, progress.part(0, job.correct ? 0.4 : 1),
                      [](cutting::Follower& f, const Station& s) { return f.at(s); });
  if (job.correct) {
    refuse_chatter(stations, out.before, job.course.cutter.r);
    out.after = follow(
        job, stock, places, progress.part(0.4, 1),
        [&](cutting::Follower& f, const Station& s) { return f.corrected_at(s, *job.correct); });
    refuse_chatter(stations, out.after, job.course.cutter.r);
  }
  out.solve_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

// The path with its stations shifted. A move none of whose stations moved stays as it is.
path::Motion corrected_motion(const WorkPath& work, const std::vector<Place>& places,
                              const std::vector<StationError>& after, const Vector3d& to_centre) {
  path::Motion out{work.motion.start, {}};
  std::vector<Vector3d> shift(places.size(), Vector3d::Zero());
  std::size_t k = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].cuts) {
      shift[i] = -after[k].shift * places[i].station.n;
      ++k;
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const path::Move& move = work.motion.moves[places[i].move];
    const bool is_end = i + 1 == places.size() || places[i + 1].move != places[i].move;
    const bool moves = !shift[i].isZero() || (i > 0 && !shift[i - 1].isZero()) ||
                       (i + 1 < places.size() && !shift[i + 1].isZero());
    if (!is_end && !moves) continue;
    path::Move shifted_move = move;
    shifted_move.to = places[i].station.centre - to_centre + shift[i];
    out.moves.push_back(std::move(shifted_move));
  }
  return out;
}

void validate_feeds(const std::vector<Place>& places, double radius) {
  for (const Place& place : places) {
    if (place.cuts && !(place.station.feed >= 1e-6 && place.station.feed <= radius / 2)) {
      refuse({.field = "/along",
              .value = text(place.station.feed) + " mm a tooth",
              .limit = "1e-6 mm to half the radius a tooth at this spindle speed"});
    }
  }
}

void refuse_unless_cutting(const std::vector<Station>& stations) {
  if (stations.empty()) {
    refuse({.field = "/along",
            .value = "no move that cuts across the tool axis",
            .limit = "a path with at least one cutting move that is no plunge"});
  }
}

}  // namespace

ResolvedTool resolve_path_tool(Object& job, const Definitions& definitions) {
  return resolve_tool(job.required("tool"), definitions);
}

Answer predict_work(Object& job, Object& along, WorkPath work, const ResolvedTool& tool,
                    const Request& request) {
  enum class Control { Tip, Centre };
  constexpr Choices<Control, 2> controls{{{"tip", Control::Tip}, {"centre", Control::Centre}}};
  const double radius = tool::cutting_radius(tool.tool);
  const Value given = along.required("stock");
  const HeightMap stock = read_stock(given, radius);
  const double step =
      along.number("step", between(0.01, 100, "mm"), std::clamp(radius / 4, 0.05, 2.0));
  const Control control = along.choice("control_point", controls, Control::Tip);
  along.finish();
  AlongSource source{.tool = tool.tool,
                     .dynamics = tool.dynamics,
                     .material = {},
                     .material_at = {},
                     .rpm = work.rpm};
  AlongJob read = read_along(job, source, request.definitions);
  job.finish();
  if (read.correct && read.correct->by_borders) {
    refuse({.field = "/correct/aim", .value = "width", .limit = "\"surface\" but for a chamfer"});
  }

  read.course.tool_axis = work.tool_axis;
  work.motion = path::linearised(work.motion, arc_tolerance, request.progress.part(0, 0));
  const Vector3d to_centre =
      control == Control::Tip ? Vector3d(radius * work.tool_axis) : Vector3d(Vector3d::Zero());
  const double teeth_per_second = read.S() * cutting::teeth(read.course.cutter);
  std::vector<Place> places = places_of(work, to_centre, step, teeth_per_second);
  set_normals(work, places);
  validate_feeds(places, radius);
  PredictedPath path;
  path.kind = work.kind;
  path.stations = stations_of(places);
  path.entries = entries_of(places);
  refuse_unless_cutting(path.stations);
  for (const Station& station : path.stations) {
    path.position.emplace_back(station.centre - to_centre);
  }
  path.result = run(read, stock, places, request.progress);

  Answer answer = path_answer(read, path);
  if (request.format == "csv") answer.text = path_csv(path);
  if (request.format == "svg") answer.text = path_drawing(read, path);
  if (request.format == "html") {
    answer.text = path_page(read, path, answer.document,
                            scene_of(stock, given.json(), tool.tool, work.tool_axis, to_centre));
  }
  if (request.format == "nc") {
    nc::Program program = work.program;
    program.motion = corrected_motion(work, places, path.result.after, to_centre);
    program.tool_axis = work.tool_axis;
    program.comments.emplace_back("CORRECTED FOR TOOL DEFLECTION");
    answer.text = nc::write(program, request.progress.part(1, 1));
  }
  return answer;
}

}  // namespace ridgeline::jobs
