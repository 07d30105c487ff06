#include "core/chamfer/loop.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/base/text.hpp"
#include "core/path/closed_curve.hpp"
#include "core/path/equal_error.hpp"

namespace ridgeline::chamfer {
namespace {

// The pieces stand for the curve to this share of the tolerance; the bound of a chord has it added.
constexpr double model_share = 1e-3;
constexpr double least_tolerance = 1e-8;  // [mm]; below, solver noise would be sampled
constexpr double same_parameter = 1e-12;

double wrapped(double u) {
  const double w = u - std::floor(u);
  return w < 1 ? w : 0;
}

void require(const Sampling& sampling) {
  if (!(sampling.tolerance >= least_tolerance && std::isfinite(sampling.tolerance))) {
    const bool is_small = sampling.tolerance > 0 && sampling.tolerance < least_tolerance;
    throw Error(is_small ? ErrorCode::ToleranceTooSmall : ErrorCode::BadInput,
                "tolerance " + text(sampling.tolerance, "mm") + ", at least " +
                    text(least_tolerance, "mm") + " is needed",
                {.field = "/tolerance",
                 .value = text(sampling.tolerance),
                 .limit = text(least_tolerance, "mm")});
  }
  if (sampling.points && !(*sampling.points >= 3 && *sampling.points <= sampling.limit)) {
    throw Error(ErrorCode::BadInput,
                "points " + std::to_string(*sampling.points) + ", 3 to " +
                    std::to_string(sampling.limit) + " are possible",
                {.field = "/points",
                 .value = std::to_string(*sampling.points),
                 .limit = "3 to " + std::to_string(sampling.limit)});
  }
  if (!std::isfinite(sampling.start_u)) {
    throw Error(ErrorCode::BadInput, "start of the loop is not a number",
                {.field = "/start_angle"});
  }
}

// Start, corners of the borders, start + 1: where the path may bend.
std::vector<double> breaks(const Section& section, double start) {
  std::vector<double> out{start};
  for (const double joint : section.corners) {
    const double u = joint < start ? joint + 1 : joint;
    if (u - start > same_parameter && start + 1 - u > same_parameter) out.push_back(u);
  }
  out.push_back(start + 1);
  std::ranges::sort(out);
  return out;
}

std::vector<double> equal_parameters(double start, int count) {
  std::vector<double> u;
  u.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) u.push_back(start + static_cast<double>(i) / count);
  return u;
}

}  // namespace

Loop loop(const geometry::Edge& edge, const Chamfer& chamfer, const Sampling& sampling,
          const Progress& progress) {
  require(sampling);
  const Section ready = section(edge, chamfer);
  const auto at = [&](double u) {
    return chamfer.method == Method::Swept ? swept_at(ready, wrapped(u))
                                           : section_at(ready, wrapped(u));
  };
  const double start = wrapped(sampling.start_u);
  const std::vector<double> ends = breaks(ready, start);
  const path::ClosedCurve curve = [&] {
    try {
      return path::model([&](double u) { return at(u).C; }, ends, model_share * sampling.tolerance,
                         progress.part(0, 0.1));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::NotConverged) throw;
      throw Error(
          ErrorCode::SweptNotReached,
          std::string("the ball does not fit into the bend of the chamfer: ") + error.what(),
          {.field = "/tool", .value = text(chamfer.D, "mm"), .limit = "a smaller tool"});
    }
  }();

  const Progress chords_part = progress.part(0.1, 0.4);
  Loop loop;
  std::vector<double> u;
  if (sampling.points) {
    u = equal_parameters(start, *sampling.points);
    loop.chord_error = path::chord_error(curve, u, chords_part.part(0, 0.9));
    const double integral = path::curvature_table(curve, chords_part.part(0.9, 1)).integral.back();
    loop.points_optimal =
        std::max(3, static_cast<int>(std::ceil(integral / std::sqrt(8 * sampling.tolerance))));
  } else {
    path::Chords chords =
        path::equal_error_chords(curve, ends, sampling.tolerance, sampling.limit, chords_part);
    u = std::move(chords.u);
    loop.points_optimal = chords.optimal;
    loop.chord_error = chords.chord_error;
  }
  if (sampling.reversed) std::reverse(u.begin() + 1, u.end());

  loop.parameter.reserve(u.size());
  loop.points.reserve(u.size());
  const Progress points_part = progress.part(0.4, 1);
  for (const double parameter : u) {
    points_part.step(loop.points.size(), u.size(), "points");
    loop.parameter.push_back(wrapped(parameter));
    loop.points.push_back(at(parameter));
  }
  return loop;
}

}  // namespace ridgeline::chamfer
