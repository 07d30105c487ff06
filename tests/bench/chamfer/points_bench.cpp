// What one point of the edge costs, beside the arithmetic that no solver can do without, and what
// whole loops cost. The ratios are of times taken in turn in one run: they hold on a busy machine.

#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "core/chamfer/loop.hpp"
#include "core/chamfer/section.hpp"
#include "core/geometry/workpiece.hpp"

namespace {

using namespace ridgeline;

constexpr int block = 1000;  ///< points between two looks at the clock

/// Inner edge of a hole 3 mm beside the axis of a tube; penetration [rad].
geometry::Edge edge(double penetration) {
  const Eigen::Vector3d A2(0, std::sin(penetration), std::cos(penetration));
  geometry::Workpiece tube;
  tube.inner_radius = 20;
  tube.outer_radius = 30;
  tube.length = 200;
  geometry::Hole hole;
  hole.profile.R2 = 5;
  hole.position = geometry::position_of(tube, A2, 3);
  hole.axis = A2;
  tube.holes = {hole};
  return edge_of(tube, hole, geometry::EdgeKind::Inner, geometry::Side::Entry);
}

/// Processor time of this thread: what others do on the machine is not in it.
double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(auto&& work) {
  const double begin = now();
  work();
  return now() - begin;
}

// One sine, one cosine and two square roots: what a point of the ridge takes at least.
double units(double start) {
  double sum = 0;
  for (int i = 0; i < block; ++i) {
    const double phi = start + i * 6.2e-3;
    const double c = std::cos(phi);
    const double s = std::sin(phi);
    sum += std::sqrt(2 + c) + std::sqrt(2 + s);
  }
  return sum;
}

template <chamfer::SectionPoint (*point_at)(const chamfer::Section&, double)>
double points(const chamfer::Section& section, double start) {
  double sum = 0;
  for (int i = 0; i < block; ++i) {
    const double u = start + static_cast<double>(i) / block;
    sum += point_at(section, u - std::floor(u)).C.z();
  }
  return sum;
}

// Points of an oblique or straight hole: counters are nanoseconds a point and ratios.
void points_of_an_edge(benchmark::State& state) {
  const geometry::Edge inner = edge(static_cast<double>(state.range(0)) * std::numbers::pi / 180);
  const chamfer::Chamfer wanted{.W = 0.5, .D = 3};
  const chamfer::Section ready = chamfer::section(inner, wanted);
  double unit = 0, section = 0, swept = 0, start = 0;
  for (auto _ : state) {
    start += 1e-4;
    unit += seconds([&] { benchmark::DoNotOptimize(units(start)); });
    section +=
        seconds([&] { benchmark::DoNotOptimize(points<chamfer::section_at>(ready, start)); });
    swept += seconds([&] { benchmark::DoNotOptimize(points<chamfer::swept_at>(ready, start)); });
  }
  const double count = static_cast<double>(state.iterations()) * block;
  state.counters["unit_ns"] = unit / count * 1e9;
  state.counters["section_ns"] = section / count * 1e9;
  state.counters["swept_ns"] = swept / count * 1e9;
  state.counters["section_per_unit"] = section / unit;
  state.counters["swept_per_section"] = swept / section;
}
BENCHMARK(points_of_an_edge)->ArgName("penetration_deg")->Arg(0)->Arg(40);

// A whole closed path: 10,000 equal steps.
void loop_of_10000_swept_points(benchmark::State& state) {
  const geometry::Edge inner = edge(0);
  const chamfer::Chamfer wanted{.W = 0.5, .D = 3};
  chamfer::Sampling sampling;
  sampling.points = 10'000;
  for (auto _ : state) {
    benchmark::DoNotOptimize(chamfer::loop(inner, wanted, sampling));
  }
}
BENCHMARK(loop_of_10000_swept_points)->Unit(benchmark::kMillisecond);

// A closed path by tolerance; the counter is points over the optimum.
void loop_by_tolerance(benchmark::State& state) {
  const geometry::Edge inner = edge(0);
  const chamfer::Chamfer wanted{.W = 0.5, .D = 3};
  const double tolerance = 1 / static_cast<double>(state.range(0));
  chamfer::Sampling sampling;
  sampling.tolerance = tolerance;
  chamfer::Loop last;
  for (auto _ : state) last = chamfer::loop(inner, wanted, sampling);
  state.counters["points"] = static_cast<double>(last.points.size());
  state.counters["points_per_optimum"] =
      static_cast<double>(last.points.size()) / last.points_optimal;
  state.counters["error_per_tolerance"] = last.chord_error / tolerance;
}
BENCHMARK(loop_by_tolerance)
    ->ArgName("per_mm")
    ->Arg(200)
    ->Arg(500)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
