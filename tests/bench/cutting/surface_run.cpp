#include "tests/bench/cutting/surface_run.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cutting/chip_force.hpp"
#include "core/cutting/height_map.hpp"
#include "core/cutting/oscillator.hpp"
#include "core/cutting/rows.hpp"

namespace ridgeline::cutting {
namespace {

using Eigen::Vector3d;

// Coordinates on the plane: along the feed, across it, along n.
struct Plane {
  Vector3d u, v, n;
  Vector3d of(const Vector3d& P) const { return {P.dot(u), P.dot(v), P.dot(n)}; }
};

HeightMap fresh_surface(const Cut& cut, const Plane& plane, double travel, double cell) {
  const auto& face = std::get<HalfSpace>(cut.stock.faces.front());
  const double half = 1.3 * std::sqrt(2 * cut.cutter.r * (face.h + cut.cutter.r)) + 0.1;
  HeightMap map;
  map.cell = cell;
  map.origin = {-half, -half};
  map.columns = static_cast<int>((2 * half + travel) / cell) + 2;
  map.rows = static_cast<int>(2 * half / cell) + 2;
  for (int row = 0; row < map.rows; ++row) {
    const double across = map.origin.y() + row * cell;
    double height = face.h;
    for (const Round& groove : cut.stock.grooves) {
      const Vector3d axis = plane.of(groove.centre);
      const double room = groove.R * groove.R - (across - axis.y()) * (across - axis.y());
      if (room > 0) height = std::min(height, axis.z() - std::sqrt(room));
    }
    map.heights.insert(map.heights.end(), static_cast<std::size_t>(map.columns), height);
  }
  return map;
}

class Run {
public:
  Run(const Cut& cut, const Compliance& compliance, double S, int revolutions, double cell)
      : cut_(cut),
        table_(chip_table(cut, {0.1})),
        x_(modes_of(compliance.x), 1 / (S * cut.samples)),
        y_(modes_of(compliance.y), 1 / (S * cut.samples)) {
    plane_.u = feed_direction(cut);
    plane_.n = cut.n;
    plane_.v = cut.n.cross(plane_.u);
    per_step_ = cut.feed * teeth(cut.cutter) / cut.samples;
    surface_ = fresh_surface(cut, plane_, per_step_ * cut.samples * revolutions, cell);
  }

  void step(int n) {
    const int i = n % cut_.samples;
    const Vector3d way = plane_.u * (per_step_ * n);
    const Vector3d F = force(i, way, ahead(F_));
    x_.step(F_.x(), F.x());
    y_.step(F_.y(), F.y());
    F_ = F;
    const Vector3d U(x_.displacement(), y_.displacement(), 0);
    take_off(i, way + U);
    if (least_) e_ = std::min(e_.value_or(1e9), *least_ + U.dot(cut_.n));
  }
  std::optional<double> e() const { return e_; }
  void forget_error() { e_.reset(); }

private:
  Vector3d ahead(const Vector3d& F) const {
    return {x_.ahead(F_.x(), F.x()), y_.ahead(F_.y(), F.y()), 0};
  }

  // Thickness from the height of the surface over the element, taken along N.
  Vector3d force(int i, const Vector3d& way, const Vector3d& U) {
    Vector3d F = Vector3d::Zero();
    cutting_.clear();
    least_.reset();
    for (int k = 0; k < teeth(cut_.cutter); ++k) {
      const Row row = row_at(table_, i, k);
      for (std::size_t index = row.from; index < row.to; ++index) {
        const Chip& chip = row.tooth->chips[index];
        const Vector3d p = plane_.of(way + U + chip.r * chip.N);
        const double over = height_at(surface_, p.x(), p.y()) - p.z();
        const double t = over * std::abs(chip.N.dot(plane_.n));
        if (!(t > least_chip)) continue;
        F += chip.Fe + t * chip.Fc;
        cutting_.push_back(p);
        least_ = std::min(least_.value_or(chip.depth), chip.depth);
      }
    }
    return F;
  }

  // The patch of the ball that each cutting element sweeps in one step.
  void take_off(int, const Vector3d& centre) {
    const Vector3d c = plane_.of(centre);
    const double r = cut_.cutter.r;
    const double patch =
        std::max(2 * std::numbers::pi / cut_.samples, cut_.cutter.q_end / cut_.cutter.elements) * r;
    const int reach = static_cast<int>(std::ceil(0.6 * patch / surface_.cell));
    for (const Vector3d& p : cutting_) {
      const int column = static_cast<int>((p.x() - surface_.origin.x()) / surface_.cell + 0.5);
      const int row = static_cast<int>((p.y() - surface_.origin.y()) / surface_.cell + 0.5);
      for (int j = std::max(0, row - reach); j <= std::min(surface_.rows - 1, row + reach); ++j) {
        for (int k = std::max(0, column - reach);
             k <= std::min(surface_.columns - 1, column + reach); ++k) {
          const double a = surface_.origin.x() + k * surface_.cell - c.x();
          const double b = surface_.origin.y() + j * surface_.cell - c.y();
          const double room = r * r - a * a - b * b;
          double& height = surface_.heights[static_cast<std::size_t>(j) *
                                                static_cast<std::size_t>(surface_.columns) +
                                            static_cast<std::size_t>(k)];
          if (room > 0) height = std::min(height, c.z() - std::sqrt(room));
        }
      }
    }
  }

  const Cut& cut_;
  ChipTable table_;
  Oscillator x_, y_;
  Plane plane_;
  HeightMap surface_;
  double per_step_ = 0;
  Vector3d F_ = Vector3d::Zero();
  std::vector<Vector3d> cutting_;
  std::optional<double> least_, e_;
};

}  // namespace

SurfaceRun surface_run(const Cut& cut, const Compliance& compliance, double S, int revolutions,
                       double cell) {
  Run run(cut, compliance, S, revolutions, cell);
  for (int n = 0; n < revolutions * cut.samples; ++n) {
    if (n == (revolutions - 1) * cut.samples) run.forget_error();
    run.step(n);
  }
  return {run.e(), revolutions};
}

}  // namespace ridgeline::cutting
