// What a station of a long path costs by the iteration, by the rigid method and by the time domain,
// and how far the iteration is from the time domain over the spindle speed.
//
// RIDGELINE_LONG_PATH=306929 adds one run of that many stations with two threads.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>

#include "core/cutting/along.hpp"
#include "tests/bench/cutting/surface_run.hpp"

namespace {

using namespace ridgeline;
using namespace ridgeline::cutting;
using Eigen::Vector3d;

constexpr double radian = std::numbers::pi / 180;

// The base case of the figures: ball r = 6, two flutes, helix 30, plane tilted, feed horizontal.
Course base_course(int samples) {
  Course course;
  course.cutter.r = 6;
  course.cutter.pitch = equal_pitch(2);
  course.cutter.helix = 30 * radian;
  course.cutter.elements = 256;
  course.coefficients = {796.1, 27.7, 168.8, 30.8, 0, 0};
  course.samples = samples;
  return course;
}

Compliance base_compliance() {
  const Modes mode{{1100, 0.03, 2000}};
  return {mode, mode, Eigen::Matrix2d::Identity()};
}

// A station on a slope of this tilt, `pass` grooves beside it; down-milling where the sense is 1.
Station slope_station(double tilt, double feed, int pass, double sense) {
  constexpr double depth = 0.23, pick = 0.49, r = 6;
  Station station;
  station.centre = Vector3d::Zero();
  station.direction = Vector3d(0, sense, 0);
  station.n = Vector3d(-std::sin(tilt), 0, std::cos(tilt));
  station.feed = feed;
  station.stock.faces = {HalfSpace{station.n, depth - r}};
  const Vector3d down(-std::cos(tilt), 0, -std::sin(tilt));
  for (int i = 1; i <= pass; ++i)
    station.stock.grooves.push_back({pick * i * down, station.direction, r});
  return station;
}

// A mould surface: passes of 40 stations there and back, down- and up-milling in turn; its tilt
// goes from 10 to 80 degrees by up to 1.4 degrees a station.
std::vector<Station> mould(int count) {
  std::vector<Station> out;
  for (int i = 0; i < count; ++i) {
    const double wave = 0.5 + 0.5 * std::sin(0.04 * i) * std::cos(7e-4 * i);
    const double sense = (i / 40) % 2 == 0 ? 1 : -1;
    out.push_back(slope_station((10 + 70 * wave) * radian, 0.2, 1, sense));
  }
  return out;
}

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(auto&& work) {
  const double begin = processor_seconds();
  work();
  return processor_seconds() - begin;
}

double mean_loops(const std::vector<StationError>& rows) {
  double sum = 0;
  for (const StationError& row : rows) sum += row.loops;
  return sum / static_cast<double>(rows.size());
}

// Whole path, iteration with warm starts against the rigid method, taken in turn.
void iteration_against_rigid(benchmark::State& state) {
  const double S = static_cast<double>(state.range(0)) / 60;
  const int count = static_cast<int>(state.range(1));
  const Course course = base_course(1024);
  const std::vector<Station> stations = mould(count);
  AlongOptions warm, rigid;
  rigid.method = Method::Rigid;
  if (state.range(2) > 0) warm.iterate.kappa = static_cast<double>(state.range(2));
  warm.part = rigid.part = count;
  warm.iterate.mixing = state.range(3) > 0 ? Mixing::Secants : Mixing::Averages;
  double iteration_time = 0, rigid_time = 0;
  std::vector<StationError> rows;
  for (auto _ : state) {
    iteration_time += seconds([&] { rows = along(course, stations, base_compliance(), S, warm); });
    rigid_time += seconds([&] { along(course, stations, base_compliance(), S, rigid); });
  }
  const double times = static_cast<double>(state.iterations()) * count;
  int fell_back = 0;
  for (const StationError& row : rows) fell_back += row.fell_back ? 1 : 0;
  state.counters["iteration_ms"] = 1e3 * iteration_time / times;
  state.counters["rigid_ms"] = 1e3 * rigid_time / times;
  state.counters["ratio"] = iteration_time / rigid_time;
  state.counters["loops"] = mean_loops(rows);
  state.counters["fell_back"] = fell_back;
}
BENCHMARK(iteration_against_rigid)
    ->ArgNames({"rpm", "stations", "kappa", "secants"})
    ->Args({8000, 2000, 0, 1})
    ->Args({8000, 2000, 2, 1})
    ->Args({3000, 2000, 0, 1})
    ->Args({3000, 2000, 0, 0})
    ->Args({1500, 2000, 0, 1})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// Every 40th station by the time domain that keeps the surface as the history of the deflection.
void time_domain_station(benchmark::State& state) {
  const double S = static_cast<double>(state.range(0)) / 60;
  const Course course = base_course(1024);
  const std::vector<Station> stations = mould(2000);
  double revolutions = 0, runs = 0, time = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < stations.size(); i += 40) {
      const Cut cut = cut_at(course, stations[i]);
      TimeDomain run;
      time += seconds([&] { run = time_domain(cut, base_compliance(), S, {}); });
      revolutions += run.revolutions;
      ++runs;
    }
  }
  state.counters["revolutions"] = revolutions / runs;
  state.counters["station_ms"] = 1e3 * time / runs;
}
BENCHMARK(time_domain_station)
    ->ArgNames({"rpm"})
    ->Arg(8000)
    ->Arg(3000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Every 400th station by a time domain that keeps the surface as a height map, 10 revolutions.
void surface_station(benchmark::State& state) {
  const double S = static_cast<double>(state.range(0)) / 60;
  constexpr int revolutions = 10;
  constexpr double cell = 0.01;  // mm
  const Course course = base_course(1024);
  const std::vector<Station> stations = mould(2000);
  double runs = 0, away = 0, time = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < stations.size(); i += 400) {
      const Cut cut = cut_at(course, stations[i]);
      SurfaceRun run;
      time += seconds([&] { run = surface_run(cut, base_compliance(), S, revolutions, cell); });
      const TimeDomain history = time_domain(cut, base_compliance(), S, {});
      if (run.e && history.e) away = std::max(away, std::abs(*run.e - *history.e));
      ++runs;
    }
  }
  state.counters["station_ms"] = 1e3 * time / runs;
  state.counters["away_from_history_um"] = 1e3 * away;
}
BENCHMARK(surface_station)
    ->ArgNames({"rpm"})
    ->Arg(8000)
    ->Arg(3000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Third pass on the 45 degree slope, 1000 to 16000 rev/min, against the time domain with three
// earlier teeth; speeds that chatter are left out and counted.
void error_against_time_domain(benchmark::State& state) {
  const double feed = static_cast<double>(state.range(0)) / 10;
  const Course course = base_course(1024);
  Course real = course;
  real.earlier_teeth = 3;
  const Station station = slope_station(45 * radian, feed, 2, 1);
  const Compliance compliance = base_compliance();
  IterateOptions loose, tight;
  tight.alpha = 1e-4;
  double sum_rigid = 0, sum_loose = 0, sum_tight = 0;
  int used = 0, chatter = 0;
  for (auto _ : state) {
    for (int rpm = 1000; rpm <= 16000; rpm += 100) {
      const double S = rpm / 60.0;
      const TimeDomain run =
          time_domain(cut_at(real, station), compliance, S, {.max_revolutions = 120});
      if (stability_of(run) != Stability::Stable) {
        ++chatter;
        continue;
      }
      const Cut cut = cut_at(course, station);
      const auto squared = [&](const std::optional<double>& e) {
        return 1e6 * (*e - *run.e) * (*e - *run.e);
      };
      sum_rigid += squared(cutting::rigid(cut, compliance, S, Span::Pitch).e);
      sum_loose += squared(iterate(cut, compliance, S, loose).e);
      sum_tight += squared(iterate(cut, compliance, S, tight).e);
      ++used;
    }
  }
  state.counters["rigid_rms_um"] = std::sqrt(sum_rigid / used);
  state.counters["alpha_0.01_rms_um"] = std::sqrt(sum_loose / used);
  state.counters["alpha_1e-4_rms_um"] = std::sqrt(sum_tight / used);
  state.counters["speeds"] = used;
  state.counters["chatter"] = chatter;
}
BENCHMARK(error_against_time_domain)
    ->ArgNames({"tenths_of_mm_a_tooth"})
    ->Arg(2)
    ->Arg(1)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

void long_path(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const Course course = base_course(1024);
  const std::vector<Station> stations = mould(count);
  AlongOptions options;
  options.threads = 2;
  options.iterate.kappa = 2;
  options.iterate.mixing = Mixing::Secants;
  std::vector<StationError> rows;
  double processor = 0;
  for (auto _ : state) {
    processor +=
        seconds([&] { rows = along(course, stations, base_compliance(), 8000 / 60.0, options); });
  }
  int fell_back = 0;
  for (const StationError& row : rows) fell_back += row.fell_back ? 1 : 0;
  state.counters["processor_s"] = processor;
  state.counters["loops"] = mean_loops(rows);
  state.counters["fell_back"] = fell_back;
}

const bool is_long_path_added = [] {
  const char* count = std::getenv("RIDGELINE_LONG_PATH");
  if (count == nullptr) return false;
  benchmark::RegisterBenchmark("long_path", long_path)
      ->Arg(std::atol(count))
      ->Iterations(1)
      ->UseRealTime()
      ->Unit(benchmark::kSecond);
  return true;
}();

}  // namespace
