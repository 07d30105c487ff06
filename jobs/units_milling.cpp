#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/angle.hpp"
#include "core/units/offset.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"
#include "jobs/units_area.hpp"
#include "jobs/units_nc.hpp"
#include "jobs/units_tilted.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using nc::LatheHole;
using nc::LatheMove;
using nc::LatheProgram;
using nc::LatheStep;
using units::Hole;
using units::MilledFace;
using units::Point;
using units::Region;
using units::Segment;
using units::Sense;
using units::ToolRow;
using units::Unit;

constexpr double along = 1 - 1e-9;    // cosine: along the axis
constexpr double breakthrough = 0.5;  // [mm]
constexpr double clear = 2;           // [mm] above the work
constexpr double row_share = 0.7;     // of the cutter's diameter from row to row
constexpr double chord = 0.005;       // [mm] of arcs that are milled in lines

LatheStep driven(const Unit& unit, const ToolRow& row, const char* kind, double diameter) {
  LatheStep step;
  step.tool = std::max(1, row.number);
  step.mode = LatheStep::Mode::Milling;
  step.comment =
      fmt::format("UNIT {} {} {}, {} D{:.6g}", unit.number, kind, row.pattern, row.tool, diameter);
  step.speed = row.cutting_speed * 60 / (std::numbers::pi * std::max(diameter, 0.1));
  step.feed = row.feed_per_revolution * step.speed;
  return step;
}

/// C in [0, 360).
double angle_of(double y, double x) {
  const double c = degrees(std::atan2(y, x));
  return c < 0 ? c + 360 : c;
}

/// A hole drilled down to `depth` along its axis.
std::optional<LatheHole> placed(const Hole& hole, const LatheFrame& frame, double depth) {
  const Vector3d p = frame.point(hole.start);
  const Vector3d d = frame.direction(hole.direction);
  LatheHole out;
  if (d.z() < -along) {
    out.x = std::hypot(p.x(), p.y());
    out.c = out.x < 1e-9 ? 0 : angle_of(p.y(), p.x());
    out.z = p.z();
    out.end = p.z() - depth;
    return out;
  }
  if (std::abs(d.z()) > units::across_axis) return std::nullopt;
  out.is_radial = true;
  out.c = angle_of(-d.y(), -d.x());
  out.x = -(p.x() * d.x() + p.y() * d.y());
  out.y = -(p.y() * d.x() - p.x() * d.y());  // along the direction a quarter turn before it
  if (std::abs(out.y) < 1e-9) out.y = 0;
  out.z = p.z();
  out.end = out.x - depth;
  return out;
}

std::optional<MillingPlane> plane_of(const MilledFace& face, const LatheFrame& frame) {
  const Vector3d n = frame.direction(face.normal);
  MillingPlane plane;
  plane.h = n;
  if (n.z() > along) {
    plane.is_radial = false;
    plane.a = Vector3d::UnitX();
    plane.b = Vector3d::UnitY();
    return plane;
  }
  if (std::abs(n.z()) > units::across_axis) return std::nullopt;
  plane.c = angle_of(n.y(), n.x());
  plane.a = Vector3d::UnitZ();
  plane.b = Vector3d(-n.y(), n.x(), 0);
  return plane;
}

/// Moves of a milling step in the machine's axes.
class Miller {
public:
  Miller(const MillingPlane& plane, double bottom, double feed, LatheStep& step)
      : plane_(plane), bottom_(bottom), feed_(feed), step_(step) {}

  void rapid(const Point& p, double height) { add(LatheMove::Kind::Rapid, p, height, 0); }
  void line(const Point& p, double height, double feed) {
    add(LatheMove::Kind::Line, p, height, feed);
  }
  void along(const Segment& row, double height) {
    int n = 1;
    if (row.arc) {
      const double turn = units::length(row) / row.arc->radius;
      const double most =
          2 * std::acos(std::max(0.0, 1 - chord / std::max(row.arc->radius, chord)));
      n = std::max(2, static_cast<int>(std::ceil(turn / most)));
    }
    for (int i = 1; i <= n; ++i) {
      line(i == n ? row.end : units::point_at(row, static_cast<double>(i) / n), height, feed_);
    }
  }

private:
  void add(LatheMove::Kind kind, const Point& p, double height, double feed) {
    LatheMove move;
    move.kind = kind;
    move.feed = feed;
    const double b = p.r - plane_.shift - plane_.origin[1];
    if (plane_.is_radial) {
      move.z = p.z;
      move.x = bottom_ + height;
    } else {
      move.x = p.z - plane_.origin[0];
      move.z = bottom_ + height;
    }
    move.y = b;
    step_.moves.push_back(move);
  }
  const MillingPlane& plane_;
  double bottom_, feed_;
  LatheStep& step_;
};

std::vector<double> rows_of(const units::Box& b, double spacing) {
  const double span = b.r1 - b.r0;
  const int n = std::max(1, static_cast<int>(std::ceil(span / spacing - 1e-9)));
  if (span < 0.05) return {(b.r0 + b.r1) / 2};
  std::vector<double> rows;
  for (int i = 0; i <= n; ++i) rows.push_back(b.r0 + 1e-3 + (span - 2e-3) * i / n);
  return rows;
}

void mill_level(Miller& miller, const Region& centres, double height, double top, double D,
                double feed) {
  bool is_back = false;
  for (const double r : rows_of(units::box(centres), row_share * D)) {
    const units::Box b = units::box(centres);
    const Region strip =
        units::intersection_of(centres, units::rectangle(r - 5e-4, r + 5e-4, b.z0 - 1, b.z1 + 1));
    for (const Region& piece : units::pieces(strip)) {
      const units::Box e = units::box(piece);
      const double from = is_back ? e.z1 : e.z0;
      const double to = is_back ? e.z0 : e.z1;
      miller.rapid({r, from}, top);
      miller.line({r, from}, height, feed / 3);
      miller.line({r, to}, height, feed);
      miller.rapid({r, to}, top);
    }
    is_back = !is_back;
  }
  for (const units::Contour& loop : units::contours(centres)) {
    miller.rapid(loop.front().start, top);
    miller.line(loop.front().start, height, feed / 3);
    for (const Segment& row : loop) miller.along(row, height);
    miller.rapid(loop.front().start, top);
  }
}

/// The plane, or a note that says why the unit has no path.
std::optional<TiltedPlane> in_tilted_plane(const Unit& unit, Tilt tilt, nc::LatheControl control,
                                           std::vector<std::string>& notes) {
  std::string why = std::move(tilt.why);
  if (tilt.plane && control == nc::LatheControl::LinuxCnc) {
    why = "it needs a tilted work plane, which LinuxCNC does not have";
  }
  if (why.empty()) return tilt.plane;
  notes.push_back(fmt::format("unit {}: {}; no path", unit.number, why));
  return std::nullopt;
}

}  // namespace

void add_hole_steps(const Unit& unit, const LatheFrame& frame, const Region& material,
                    nc::LatheControl control, LatheProgram& program,
                    std::vector<std::string>& notes) {
  const Hole& hole = *unit.hole;
  if (unit.tools.empty()) {
    notes.push_back(fmt::format("unit {} has no tool: no path", unit.number));
    return;
  }
  const double point = hole.bottom == units::HoleBottom::Flat
                           ? 0
                           : hole.diameter / 2 / std::tan(hole.point_angle / 2);
  const double over = hole.bottom == units::HoleBottom::Through ? breakthrough : 0;
  const bool is_oblique = !placed(hole, frame, 0);
  std::optional<TiltedPlane> tilted;
  if (is_oblique) {
    Tilt tilt = tilted_plane(frame.point(hole.start), -frame.direction(hole.direction), program);
    tilted = in_tilted_plane(unit, std::move(tilt), control, notes);
    if (!tilted) return;
  }
  const auto add = [&](const ToolRow& row, double depth, double diameter) {
    LatheStep step = driven(unit, row, "HOLE", diameter);
    LatheHole at;
    if (tilted) {
      step.plane = tilted->plane;
      at.z = tilted->point(frame.point(hole.start)).z();
      at.end = at.z - depth;
      at.clear = clear + clear_height(material, hole.start, -hole.direction, diameter);
    } else {
      at = *placed(hole, frame, depth);
    }
    at.peck = std::max(diameter, 0.1);
    step.holes.push_back(at);
    program.steps.push_back(std::move(step));
  };
  add(unit.tools.front(), hole.depth + point + over, hole.diameter);
  double depth = 0;
  double narrowest = HUGE_VAL;  // of the steps before
  std::size_t next = 1;
  for (const units::HoleStep& step : hole.steps) {
    depth += step.length;
    const double before = std::exchange(narrowest, std::min(narrowest, step.end_diameter));
    if (step.diameter <= hole.diameter + 1e-6) continue;
    if (step.diameter > before + 1e-6) {
      notes.push_back(fmt::format("unit {}: its diameter {:.6g} lies behind {:.6g}; no path for it",
                                  unit.number, step.diameter, before));
      ++next;
      continue;
    }
    if (next >= unit.tools.size()) {
      notes.push_back(
          fmt::format("unit {}: no tool for its diameter {:.6g}", unit.number, step.diameter));
      break;
    }
    add(unit.tools[next++], depth, step.diameter);
  }
}

void add_mill_steps(const units::Product& product, const Unit& unit, const LatheFrame& frame,
                    nc::LatheControl control, LatheProgram& program,
                    std::vector<std::string>& notes) {
  const MilledFace& face = *unit.face;
  const auto give_up = [&](const std::string& why) {
    notes.push_back(fmt::format("unit {}: {}; no path", unit.number, why));
  };
  std::optional<MillingPlane> plane = plane_of(face, frame);
  if (face.outline.empty()) return give_up("its outline is not known");
  std::optional<TiltedPlane> tilted;
  if (!plane) {
    tilted = in_tilted_plane(
        unit, tilted_plane(frame.point(face.point), frame.direction(face.normal), program), control,
        notes);
    if (!tilted) return;
    plane = MillingPlane{false, 0, tilted->x, tilted->y, tilted->z, 0};
  }
  if (unit.tools.empty()) return give_up("it has no tool");
  const ToolRow& row = unit.tools.front();
  const double D = row.nominal_diameter;
  if (!(D > 0)) return give_up("its cutter has no diameter");
  if (!(row.depth_of_cut >= 0.01)) return give_up("its depth of cut is below 0.01 mm");
  const Region area = milled_area(product, face, frame, *plane, D / 2);
  Region centres = units::shrunk(area, D / 2);
  if (units::is_empty(centres)) centres = units::shrunk(area, 0.995 * D / 2);
  if (units::is_empty(centres)) {
    return give_up(fmt::format("a cutter of diameter {:.6g} does not enter it", D));
  }
  LatheStep step = driven(unit, row, "FACE MILL", D);
  step.c = plane->is_radial ? plane->c : 0;
  double bottom = frame.point(face.point).dot(plane->h);
  double level = plane->is_radial ? program.safe_x : program.safe_z;
  if (tilted) {
    step.plane = tilted->plane;
    step.c.reset();
    plane->origin = {tilted->origin.dot(plane->a), tilted->origin.dot(plane->b)};
    bottom = tilted->point(frame.point(face.point)).z();
    level = tilted->plane.level;
  }
  Miller miller(*plane, bottom, step.feed, step);
  const Point first = units::contours(centres).front().front().start;
  miller.rapid(first, level - bottom);
  const int levels = std::max(1, static_cast<int>(std::ceil(face.depth / row.depth_of_cut - 1e-9)));
  for (int i = levels - 1; i >= 0; --i) {
    mill_level(miller, centres, face.depth * i / levels, face.depth + clear, D, step.feed);
  }
  program.steps.push_back(std::move(step));
}

}  // namespace ridgeline::jobs
