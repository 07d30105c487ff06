#include "core/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/geometry/solid.hpp"
#include "core/geometry/trace.hpp"
#include "core/path/arc.hpp"
#include "core/path/pieces.hpp"
#include "core/verify/band.hpp"
#include "core/verify/clearance.hpp"
#include "core/verify/overcut.hpp"

namespace ridgeline::verify {
namespace {

using geometry::Piece;
using geometry::Solid;
using geometry::Trace;
using path::Motion;
using path::Move;
using path::MoveKind;

constexpr int fewest_sections = 720;
constexpr int most_sections = 16384;
constexpr std::size_t sections_per_move = 8;  ///< the width ripples with every chord

bool is_finite(const Move& move) {
  return move.to.allFinite() && std::isfinite(move.feed) &&
         (!move.arc || (move.arc->centre.allFinite() && move.arc->axes.allFinite()));
}

void check(const Subject& subject, const Motion& motion) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::BadInput, message); };
  if (!(tool::cutting_radius(subject.tool) > 0)) refuse("the cutting radius must be above 0 mm");
  if (!(subject.width > 0)) refuse("the width to measure against must be above 0 mm");
  if (!motion.start.allFinite()) refuse("the start of the motion is not finite");
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    const Move& move = motion.moves[i];
    if (!is_finite(move)) refuse("move " + std::to_string(i) + " is not finite");
    if (move.kind != MoveKind::Rapid && !(move.feed > 0)) {
      refuse("move " + std::to_string(i) + " has feed " + std::to_string(move.feed) +
             " mm/s; a feed move needs more than 0");
    }
  }
}

template <typename Wanted>
Trace trace_of(const std::vector<Piece>& pieces, const Motion& motion, const Wanted& wanted) {
  std::vector<Piece> chosen;
  for (const Piece& piece : pieces) {
    if (wanted(motion.moves[piece.owner].kind)) chosen.push_back(piece);
  }
  return Trace(std::move(chosen));
}

double cutting_time(const Motion& motion) {
  double time = 0;
  Eigen::Vector3d from = motion.start;
  for (const Move& move : motion.moves) {
    if (move.kind != MoveKind::Rapid) time += path::length(from, move) / move.feed;
    from = move.to;
  }
  return time;
}

double path_length(const Motion& motion) {
  double length = 0;
  Eigen::Vector3d from = motion.start;
  for (const Move& move : motion.moves) {
    length += path::length(from, move);
    from = move.to;
  }
  return length;
}

/// Start of one loop of cut moves to the last half of it.
double closing_error(const std::vector<Piece>& loop) {
  std::vector<double> travelled = {0};
  for (const Piece& piece : loop) {
    travelled.push_back(travelled.back() + (piece.b - piece.a).norm());
  }
  double error = (loop.back().b - loop.front().a).norm();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (travelled[i] < travelled.back() / 2) continue;
    error = std::min(error, geometry::nearest(loop[i], loop.front().a).distance);
  }
  return error;
}

double worst_closing_error(const std::vector<Piece>& pieces, const Motion& motion) {
  double worst = 0;
  std::vector<Piece> loop;
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    if (i < pieces.size() && motion.moves[pieces[i].owner].kind == MoveKind::Cut) {
      loop.push_back(pieces[i]);
    } else if (!loop.empty()) {
      worst = std::max(worst, closing_error(loop));
      loop.clear();
    }
  }
  return worst;
}

void measure_widths(const Band& band, const std::vector<BandSection>& all, Report& report) {
  if (std::none_of(all.begin(), all.end(), [](const BandSection& s) { return s.cut; })) {
    throw Error(ErrorCode::BadInput, "the motion never cuts the edge that it is measured against");
  }
  const WidthRange range = width_range(band, all);
  report.width_min = range.min;
  report.width_max = range.max;
  report.width_min_at = range.min_at;
  report.width_max_at = range.max_at;
}

void measure_overcut(const Subject& subject, const Solid& solid, const Trace& feeds,
                     const Trace& rapids, const Band& band, const std::vector<BandSection>& all,
                     Report& report) {
  const double D = tool::cutting_radius(subject.tool);
  const Overcut found = overcut(subject.edge, solid, feeds, band, all, D);
  if (found.depth > 0) {
    report.overcut = found.depth;
    report.overcut_at = Place{feeds.pieces()[found.piece].owner, found.centre};
  }
  if (rapids.empty()) return;
  const Clearance ball = clearance(solid, rapids, subject.tool_axis, {tool::ball_of(subject.tool)});
  if (-ball.value > report.overcut) {
    report.overcut = -ball.value;
    report.overcut_at = Place{rapids.pieces()[ball.piece].owner, ball.point};
  }
}

void measure_clearances(const Subject& subject, const Solid& solid, const Trace& all,
                        const Trace& rapids, Report& report) {
  // Higher than this above the ball centre nothing of the tool can reach the workpiece.
  double far = 0;
  for (const Piece& piece : all.pieces()) {
    far = std::max({far, (piece.a - subject.workpiece.position).norm(),
                    (piece.b - subject.workpiece.position).norm()});
  }
  const double top = 2 * far + solid.reach();
  const std::vector<tool::Surface> neck = tool::neck_of(subject.tool, top);
  const std::vector<tool::Surface> holder = tool::holder_of(subject.tool, top);
  const auto place = [](const Trace& trace, const Clearance& c) {
    return Place{trace.pieces()[c.piece].owner, c.point};
  };
  if (!neck.empty()) {
    const Clearance c = clearance(solid, all, subject.tool_axis, neck);
    report.neck_clearance = c.value;
    report.neck_at = place(all, c);
  }
  if (!holder.empty()) {
    const Clearance c = clearance(solid, all, subject.tool_axis, holder);
    report.holder_clearance = c.value;
    report.holder_at = place(all, c);
  }
  if (!rapids.empty()) {
    std::vector<tool::Surface> whole = {tool::ball_of(subject.tool)};
    whole.insert(whole.end(), neck.begin(), neck.end());
    whole.insert(whole.end(), holder.begin(), holder.end());
    const Clearance c = clearance(solid, rapids, subject.tool_axis, whole);
    report.rapid_clearance = c.value;
    report.rapid_at = place(rapids, c);
  }
}

}  // namespace

Report measure(const Subject& subject, const Motion& motion) {
  check(subject, motion);
  const double D = tool::cutting_radius(subject.tool);
  const std::vector<Piece> pieces =
      path::pieces_of(motion, subject.control_to_centre * subject.tool_axis);
  const Trace all(pieces);
  const Trace feeds =
      trace_of(pieces, motion, [](MoveKind kind) { return kind != MoveKind::Rapid; });
  const Trace rapids =
      trace_of(pieces, motion, [](MoveKind kind) { return kind == MoveKind::Rapid; });
  if (feeds.empty()) {
    throw Error(ErrorCode::BadInput, "the motion has no feed move: it cuts nothing");
  }

  Report report;
  const Band band(subject.edge, feeds, D, subject.width);
  const auto wanted = static_cast<int>(
      std::min<std::size_t>(most_sections, sections_per_move * feeds.pieces().size()));
  const std::vector<BandSection> around = sections(band, std::max(fewest_sections, wanted));
  measure_widths(band, around, report);
  const Solid solid(subject.workpiece);
  measure_overcut(subject, solid, feeds, rapids, band, around, report);
  measure_clearances(subject, solid, all, rapids, report);
  report.closing_error = worst_closing_error(pieces, motion);
  report.path_length = path_length(motion);
  report.cutting_time = cutting_time(motion);
  return report;
}

}  // namespace ridgeline::verify
