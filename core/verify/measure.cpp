#include "core/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <span>
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

void check(const Subject& subject, const Motion& motion, const Progress& progress) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::BadInput, message); };
  if (!(tool::cutting_radius(subject.tool) > 0)) refuse("the cutting radius must be above 0 mm");
  if (!(subject.width > 0)) refuse("the width to measure against must be above 0 mm");
  if (!motion.start.allFinite()) refuse("the start of the motion is not finite");
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "moves");
    const Move& move = motion.moves[i];
    if (!is_finite(move)) refuse("move " + std::to_string(i) + " is not finite");
    if (move.kind != MoveKind::Rapid && !(move.feed > 0)) {
      refuse("move " + std::to_string(i) + " has feed " + std::to_string(move.feed) +
             " mm/s; a feed move needs more than 0");
    }
  }
}

template <typename Wanted>
Trace trace_of(const std::vector<Piece>& pieces, const Motion& motion, const Wanted& wanted,
               const Progress& progress) {
  const Progress choice = progress.part(0, 0.5);
  std::vector<Piece> chosen;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    choice.step(i, pieces.size(), "moves");
    const Piece& piece = pieces[i];
    if (!wanted(motion.moves[piece.owner].kind)) continue;
    if (chosen.empty()) chosen.reserve(pieces.size() - i);
    chosen.push_back(piece);
  }
  return Trace(std::move(chosen), progress.part(0.5, 1));
}

void measure_way(const Motion& motion, const Progress& progress, Report& report) {
  Eigen::Vector3d from = motion.start;
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "length");
    const Move& move = motion.moves[i];
    const double length = path::length(from, move);
    report.path_length += length;
    if (move.kind != MoveKind::Rapid) report.cutting_time += length / move.feed;
    from = move.to;
  }
}

/// Start of one loop of cut moves to the last half of it.
double closing_error(std::span<const Piece> loop, const Progress& progress) {
  const Progress lengths = progress.part(0, 0.5), distances = progress.part(0.5, 1);
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    lengths.step(i, loop.size(), "closing");
    length += (loop[i].b - loop[i].a).norm();
  }
  double error = (loop.back().b - loop.front().a).norm();
  double travelled = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    distances.step(i, loop.size(), "closing");
    if (travelled >= length / 2) {
      error = std::min(error, geometry::nearest(loop[i], loop.front().a).distance);
    }
    travelled += (loop[i].b - loop[i].a).norm();
  }
  return error;
}

double worst_closing_error(const std::vector<Piece>& pieces, const Motion& motion,
                           const Progress& progress) {
  double worst = 0;
  std::size_t first = 0;  // of the loop of cut moves
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    progress.step(i, pieces.size() + 1, "closing");
    if (i < pieces.size() && motion.moves[pieces[i].owner].kind == MoveKind::Cut) continue;
    if (i > first) {
      const std::span loop(pieces.data() + first, i - first);
      worst = std::max(worst, closing_error(loop, Progress{.report = {}, .stop = progress.stop}));
    }
    first = i + 1;
  }
  return worst;
}

void measure_widths(const Band& band, const std::vector<BandSection>& all, const Progress& progress,
                    Report& report) {
  if (std::none_of(all.begin(), all.end(), [](const BandSection& s) { return s.cut; })) {
    throw Error(ErrorCode::BadInput, "the motion never cuts the edge that it is measured against");
  }
  const WidthRange range = width_range(band, all, progress);
  report.width_min = range.min;
  report.width_max = range.max;
  report.width_min_at = range.min_at;
  report.width_max_at = range.max_at;
}

void measure_overcut(const Subject& subject, const Solid& solid, const Trace& feeds,
                     const Trace& rapids, const Band& band, const std::vector<BandSection>& all,
                     const Progress& progress, Report& report) {
  const double D = tool::cutting_radius(subject.tool);
  const Overcut found = overcut(subject.edge, solid, feeds, band, all, D, progress.part(0, 0.8));
  if (found.depth > 0) {
    report.overcut = found.depth;
    report.overcut_at = Place{feeds.pieces()[found.piece].owner, found.centre};
  }
  if (rapids.empty()) return;
  const Clearance ball = clearance(solid, rapids, subject.tool_axis, {tool::ball_of(subject.tool)},
                                   progress.part(0.8, 1));
  if (-ball.value > report.overcut) {
    report.overcut = -ball.value;
    report.overcut_at = Place{rapids.pieces()[ball.piece].owner, ball.point};
  }
}

void measure_clearances(const Subject& subject, const Solid& solid, const Trace& all,
                        const Trace& rapids, const Progress& progress, Report& report) {
  // Higher than this above the ball centre nothing of the tool can reach the workpiece.
  double far = 0;
  for (std::size_t i = 0; i < all.pieces().size(); ++i) {
    if (i % 1024 == 0) progress.at(0, "clearance");
    const Piece& piece = all.pieces()[i];
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
    const Clearance c = clearance(solid, all, subject.tool_axis, neck, progress.part(0, 0.4));
    report.neck_clearance = c.value;
    report.neck_at = place(all, c);
  }
  if (!holder.empty()) {
    const Clearance c = clearance(solid, all, subject.tool_axis, holder, progress.part(0.4, 0.7));
    report.holder_clearance = c.value;
    report.holder_at = place(all, c);
  }
  if (!rapids.empty()) {
    std::vector<tool::Surface> whole = {tool::ball_of(subject.tool)};
    whole.insert(whole.end(), neck.begin(), neck.end());
    whole.insert(whole.end(), holder.begin(), holder.end());
    const Clearance c = clearance(solid, rapids, subject.tool_axis, whole, progress.part(0.7, 1));
    report.rapid_clearance = c.value;
    report.rapid_at = place(rapids, c);
  }
}

}  // namespace

Report measure(const Subject& subject, const Motion& motion, const Progress& progress) {
  check(subject, motion, progress.part(0, 0.05));
  const double D = tool::cutting_radius(subject.tool);
  const Trace all(path::pieces_of(motion, subject.control_to_centre * subject.tool_axis,
                                  progress.part(0.05, 0.1)),
                  progress.part(0.1, 0.15));
  const Trace feeds = trace_of(
      all.pieces(), motion, [](MoveKind kind) { return kind != MoveKind::Rapid; },
      progress.part(0.15, 0.25));
  const Trace rapids = trace_of(
      all.pieces(), motion, [](MoveKind kind) { return kind == MoveKind::Rapid; },
      progress.part(0.25, 0.3));
  if (feeds.empty()) {
    throw Error(ErrorCode::BadInput, "the motion has no feed move: it cuts nothing");
  }

  Report report;
  const Band band(subject.edge, feeds, D, subject.width);
  const auto wanted = static_cast<int>(
      std::min<std::size_t>(most_sections, sections_per_move * feeds.pieces().size()));
  const std::vector<BandSection> around =
      sections(band, std::max(fewest_sections, wanted), progress.part(0.3, 0.45));
  measure_widths(band, around, progress.part(0.45, 0.5), report);
  const Solid solid(subject.workpiece);
  measure_overcut(subject, solid, feeds, rapids, band, around, progress.part(0.5, 0.75), report);
  measure_clearances(subject, solid, all, rapids, progress.part(0.75, 0.9), report);
  report.closing_error = worst_closing_error(all.pieces(), motion, progress.part(0.9, 0.95));
  measure_way(motion, progress.part(0.95, 1), report);
  return report;
}

}  // namespace ridgeline::verify
