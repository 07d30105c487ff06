#include "jobs/chamfer_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/geometry/solid.hpp"
#include "core/path/pieces.hpp"
#include "core/tool/surface.hpp"
#include "core/verify/band.hpp"
#include "core/verify/clearance.hpp"
#include "jobs/page.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;
using geometry::Foot;
using geometry::Piece;
using geometry::Trace;

constexpr double gap = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_samples = 6000;  // of a chart: several a pixel
constexpr std::size_t clearance_count = 120;
constexpr std::size_t most_drawn = 6000;  // points of the ridge line and the band

/// A place of the ridge line: a cutting point or half way between two.
struct Sample {
  double u = 0;
  std::optional<std::size_t> point;  ///< index of the cutting point
};

std::vector<Sample> samples_of(const chamfer::Result& result) {
  const std::size_t n = result.parameter.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return result.parameter[i]; });
  const std::size_t step = 1 + 2 * n / most_samples;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < n; i += step) {
    const double u = result.parameter[order[i]];
    const std::size_t after = i + step;
    const double next = after < n ? result.parameter[order[after]] : result.parameter[order[0]] + 1;
    samples.push_back({u, order[i]});
    samples.push_back({std::fmod((u + next) / 2, 1.0), std::nullopt});
  }
  if (samples.back().u < samples.front().u) std::ranges::sort(samples, {}, &Sample::u);
  return samples;
}

/// The path of the ball centre in the last pass over the edge, by the pieces that the page draws.
class LastPass {
public:
  LastPass(const PageMotion& motion, const Vector3d& to_centre)
      : travelled_{0}, trace_(pieces_of(motion, to_centre)) {
    Vector3d from = motion.start;
    for (const Vector3d& to : motion.to) {
      travelled_.push_back(travelled_.back() + (to - from).norm());
      from = to;
    }
  }
  bool empty() const { return trace_.empty(); }
  Foot foot(const Vector3d& P, std::size_t hint) const { return trace_.nearest(P, hint); }
  const Piece& piece(const Foot& foot) const { return trace_.pieces()[foot.piece]; }
  /// Length from the start of the motion to a place of the pass [mm].
  double travelled(const Foot& foot) const {
    const Piece& piece = trace_.pieces()[foot.piece];
    return travelled_[piece.owner] + (foot.point - piece.a).norm();
  }

private:
  static std::vector<Piece> pieces_of(const PageMotion& motion, const Vector3d& to_centre) {
    const auto is_cut = [&](std::size_t i) {
      return motion.kinds[i] == static_cast<int>(path::MoveKind::Cut);
    };
    std::size_t last = motion.to.size();
    while (last > 0 && !is_cut(last - 1)) --last;
    std::size_t first = last;
    while (first > 0 && is_cut(first - 1)) --first;
    std::vector<Piece> pieces;
    for (std::size_t i = first; i < last; ++i) {
      Piece piece;
      piece.a = (i == 0 ? motion.start : motion.to[i - 1]) + to_centre;
      piece.b = motion.to[i] + to_centre;
      piece.owner = i;
      if (piece.a != piece.b) pieces.push_back(piece);
    }
    return pieces;
  }

  std::vector<double> travelled_;
  Trace trace_;
};

/// What the charts show, a value a sample.
struct Loop {
  std::vector<double> ridge;         ///< length along the ridge line from phi = 0 [mm]
  std::vector<double> travelled;     ///< length along the motion of the page [mm]
  std::vector<double> computed;      ///< width at the cutting points: |G1 - G2| of the result [mm]
  std::vector<double> width;         ///< measured on the motion [mm]
  std::vector<double> error;         ///< ideal centre to the motion [mm]
  std::vector<double> feed;          ///< [mm/min]
  std::vector<double> neck, holder;  ///< clearances [mm]; NaN between their samples
};

/// Neck and holder against the part over single pieces of the path.
class Clearances {
public:
  Clearances(const verify::Subject& subject, const std::vector<Vector3d>& places)
      : solid_(subject.workpiece), axis_(subject.tool_axis) {
    double far = 0;
    for (const Vector3d& p : places) far = std::max(far, (p - subject.workpiece.position).norm());
    const double top = 2 * far + solid_.reach();
    neck_ = tool::neck_of(subject.tool, top);
    holder_ = tool::holder_of(subject.tool, top);
  }
  double neck(const Piece& piece) const { return of(neck_, piece); }
  double holder(const Piece& piece) const { return of(holder_, piece); }

private:
  double of(const std::vector<tool::Surface>& surfaces, const Piece& piece) const {
    if (surfaces.empty()) return gap;
    return verify::clearance(solid_, Trace({piece}), axis_, surfaces).value;
  }

  geometry::Solid solid_;
  Vector3d axis_;
  std::vector<tool::Surface> neck_, holder_;
};

Trace feeds_of(const path::Motion& motion, const Vector3d& to_centre, const Progress& progress) {
  std::vector<Piece> pieces;
  for (const Piece& piece : path::pieces_of(motion, to_centre, progress))
    if (motion.moves[piece.owner].kind != path::MoveKind::Rapid) pieces.push_back(piece);
  return Trace(std::move(pieces), progress);
}

Loop loop_of(const ChamferJob& job, const chamfer::Result& result, const path::Motion& rounded,
             const verify::Subject& subject, const PageMotion& motion, const Progress& progress) {
  const Vector3d to_centre = subject.control_to_centre * subject.tool_axis;
  const double D = tool::cutting_radius(subject.tool);
  const Trace feeds = feeds_of(rounded, to_centre, progress);
  const verify::Band band(subject.edge, feeds, D, subject.width);
  const chamfer::Chamfer wanted{
      .W = subject.width, .D = D, .section_angle = job.job.section_angle, .method = job.job.method};
  const chamfer::Section section = chamfer::section(subject.edge, wanted);
  const LastPass pass(motion, to_centre);
  const Clearances clearances(subject, motion.to);
  const std::vector<Sample> samples = samples_of(result);
  const std::size_t clearance_step = 1 + samples.size() / clearance_count;

  Loop loop;
  std::size_t hint = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % 64 == 0 || i % clearance_step == 0) {
      progress.at(static_cast<double>(i) / static_cast<double>(samples.size()), "page");
    }
    const Sample& sample = samples[i];
    const chamfer::SectionPoint ideal = job.job.method == chamfer::Method::Swept
                                            ? chamfer::swept_at(section, sample.u)
                                            : chamfer::section_at(section, sample.u);
    const Vector3d C = geometry::to_outer(subject.edge.frame, ideal.C);
    const Foot foot = pass.foot(C, hint);
    hint = foot.piece;
    const Piece& piece = pass.piece(foot);
    if (i == 0)
      loop.ridge.push_back(0);
    else
      loop.ridge.push_back(
          loop.ridge.back() +
          (ideal.ridge.P - geometry::ridge_at(section.ridge, samples[i - 1].u).P).norm());
    loop.travelled.push_back(pass.travelled(foot));
    loop.computed.push_back(
        sample.point ? (result.G1[*sample.point] - result.G2[*sample.point]).norm() : gap);
    loop.width.push_back(verify::width(band.at(sample.u)));
    loop.error.push_back(foot.distance);
    loop.feed.push_back(motion.feeds[piece.owner]);
    const bool is_measured = i % clearance_step == 0;
    loop.neck.push_back(is_measured ? clearances.neck(piece) : gap);
    loop.holder.push_back(is_measured ? clearances.holder(piece) : gap);
  }
  return loop;
}

bool has_values(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
}

Json charts_of(const Loop& loop) {
  std::vector<PageChart> charts = {
      {"Chamfer width",
       "mm",
       {{"measured on the program", loop.width}, {"computed", loop.computed}}},
      {"Distance of the path from the ideal one", "mm", {{"error", loop.error}}}};
  if (has_values(loop.neck))
    charts.push_back({"Clearance of neck and shank", "mm", {{"clearance", loop.neck}}});
  if (has_values(loop.holder))
    charts.push_back({"Clearance of the holder", "mm", {{"clearance", loop.holder}}});
  charts.push_back({"Feed of the control point", "mm/min", {{"feed", loop.feed}}});
  return document_of(charts);
}

Json report_rows(const Json& document) {
  Json list = {{{"name", "asked width"}, {"value", document.at("width")}, {"unit", "mm"}},
               {{"name", "tolerance"}, {"value", document.at("tolerance")}, {"unit", "mm"}}};
  const Json measured =
      page_rows(document.at("report"), {{"points", "cutting points", ""},
                                        {"points_optimal", "least number of points", ""},
                                        {"chord_error", "certified error of the path", "mm"},
                                        {"width_min", "least width, measured", "mm"},
                                        {"width_max", "greatest width, measured", "mm"},
                                        {"overcut", "deepest cut beside the chamfer", "mm"},
                                        {"neck_clearance", "clearance of neck and shank", "mm"},
                                        {"holder_clearance", "clearance of the holder", "mm"},
                                        {"rapid_clearance", "clearance of rapids", "mm"},
                                        {"closing_error", "closing error", "mm"},
                                        {"path_length", "length of the path", "mm"},
                                        {"cutting_time", "cutting time", "s"}});
  list.insert(list.end(), measured.begin(), measured.end());
  return list;
}

template <typename T>
std::vector<T> thinned(const std::vector<T>& all) {
  const std::size_t step = 1 + all.size() / most_drawn;
  std::vector<T> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

Json ends_of(const chamfer::Result& result) {
  const std::vector<Vector3d> G1 = thinned(result.G1);
  const std::vector<Vector3d> G2 = thinned(result.G2);
  std::vector<Vector3d> ends;
  for (std::size_t i = 0; i < G1.size(); ++i) ends.insert(ends.end(), {G1[i], G2[i]});
  return page_points(ends);
}

/// Where to look: the edge, from the open side of the cut through the hole.
void add_view(const ChamferJob& job, const chamfer::Result& result, const geometry::Edge& edge,
              Json& data) {
  Vector3d low = result.targets.front();
  Vector3d high = low;
  for (const Vector3d& P : result.targets) {
    low = low.cwiseMin(P);
    high = high.cwiseMax(P);
  }
  const Vector3d centre = (low + high) / 2;
  const auto& axes = edge.frame.axes;
  const double side = job.job.side == geometry::Side::Entry ? 1 : -1;
  const Vector3d up = side * axes.col(2);
  const double height = job.job.edge == geometry::EdgeKind::Inner ? 0.45 : 1.2;
  const Vector3d from = -axes.col(1) + 0.35 * axes.col(0) + height * up;
  data["focus"] = {{"centre", {centre.x(), centre.y(), centre.z()}}, {"size", (high - low).norm()}};
  data["view"] = {from.x(), from.y(), from.z()};
  data["up"] = {up.x(), up.y(), up.z()};
  data["cutaway"] = job.job.edge == geometry::EdgeKind::Inner;
}

}  // namespace

Json chamfer_scene(const ChamferJob& job, const chamfer::Result& result,
                   const verify::Subject& subject) {
  // The hole of the job first: the cut-away view goes through it.
  geometry::Workpiece part = job.job.workpiece;
  std::ranges::stable_partition(
      part.holes, [&](const geometry::Hole& hole) { return hole.name == job.job.hole; });
  Json data = {{"part", page_part(part)},
               {"ridge", page_points(thinned(result.targets))},
               {"ends", ends_of(result)},
               {"tool", page_tool(job.job.tool, result.tool_axis, subject.control_to_centre)}};
  add_view(job, result, subject.edge, data);
  return data;
}

std::string chamfer_page(const ChamferJob& job, const chamfer::Result& result,
                         const path::Motion& rounded, const verify::Subject& subject,
                         const Json& document, const Progress& progress) {
  const chamfer::Job& j = job.job;
  const PageMotion motion = page_motion(rounded, progress.part(0, 0.2));
  const Loop loop = loop_of(job, result, rounded, subject, motion, progress.part(0.2, 1));
  const std::string workpiece = j.workpiece.name.empty() ? "the workpiece" : j.workpiece.name;
  Json data = {
      {"job", "chamfer"},
      {"title", fmt::format("Chamfer of hole {} in {}", j.hole, workpiece)},
      {"subtitle", fmt::format("{} edge, {} side, width {:.6g} mm, tolerance {:.6g} mm, {} method",
                               name(j.edge), name(j.side), j.width, j.tolerance, name(j.method))},
      {"motion", document_of(motion)},
      {"along",
       page_axis("along the ridge line from \xCF\x86 = 0 [mm]", loop.ridge, loop.travelled)},
      {"charts", charts_of(loop)},
      {"report", report_rows(document)},
      {"warnings", document.at("warnings")}};
  data.update(chamfer_scene(job, result, subject));
  return page(data);
}

}  // namespace ridgeline::jobs
