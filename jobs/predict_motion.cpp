#include "jobs/predict_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace ridgeline::jobs {
namespace {

using path::MoveKind;

void move_by(path::Move& move, const Eigen::Vector3d& shift) {
  move.to += shift;
  if (move.arc) move.arc->centre += shift;
}

bool is_along(const Eigen::Vector3d& way, const Eigen::Vector3d& axis) {
  constexpr double straight = 1e-7;  // mm
  return way.cross(axis).norm() < straight;
}

}  // namespace

std::vector<CutRange> cut_ranges(const path::Motion& motion) {
  std::vector<CutRange> ranges;
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    if (motion.moves[i].kind != MoveKind::Cut) continue;
    if (ranges.empty() || ranges.back().to != i) ranges.push_back({i, i});
    ranges.back().to = i + 1;
  }
  return ranges;
}

Eigen::Vector3d shift_at(const Shifts& shifts, const Eigen::Vector3d& point) {
  const std::size_t count = shifts.at.size();
  const std::size_t chords = shifts.closed ? count : count - 1;
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d shift = shifts.shift.front();
  for (std::size_t i = 0; i < chords; ++i) {
    const std::size_t next = (i + 1) % count;
    const Eigen::Vector3d way = shifts.at[next] - shifts.at[i];
    const double length = way.squaredNorm();
    const double s =
        length > 0 ? std::clamp((point - shifts.at[i]).dot(way) / length, 0.0, 1.0) : 0;
    const double distance = (shifts.at[i] + s * way - point).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    shift = shifts.shift[i] + s * (shifts.shift[next] - shifts.shift[i]);
  }
  return shift;
}

std::size_t lead_of(const path::Motion& motion, const CutRange& cut) {
  std::size_t first = cut.from;
  for (; first > 0; --first) {
    const MoveKind kind = motion.moves[first - 1].kind;
    if (kind == MoveKind::Cut || kind == MoveKind::LeadOut || kind == MoveKind::Retract) break;
  }
  return first;
}

path::Motion shifted(const path::Motion& motion, const CutRange& cut, const Shifts& shifts,
                     const Eigen::Vector3d& tool_axis) {
  path::Motion out = motion;
  const auto point_before = [&](std::size_t i) {
    return i == 0 ? motion.start : motion.moves[i - 1].to;
  };
  for (std::size_t i = cut.from; i < cut.to; ++i) {
    move_by(out.moves[i], shift_at(shifts, motion.moves[i].to));
  }
  const Eigen::Vector3d first = shift_at(shifts, point_before(cut.from));
  for (std::size_t i = lead_of(motion, cut); i < cut.from; ++i) move_by(out.moves[i], first);
  const Eigen::Vector3d last = shift_at(shifts, motion.moves[cut.to - 1].to);
  for (std::size_t i = cut.to; i < motion.moves.size(); ++i) {
    const MoveKind kind = motion.moves[i].kind;
    const bool leads = kind == MoveKind::LeadOut || kind == MoveKind::Retract;
    if (!leads && !is_along(motion.moves[i].to - point_before(i), tool_axis)) break;
    move_by(out.moves[i], last);
  }
  return out;
}

}  // namespace ridgeline::jobs
