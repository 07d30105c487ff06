// What planning and an edit cost once a part is read, and what reading costs beside Open CASCADE's
// own load of the same file. Processor time: what others do on the machine is not in it.

#include <benchmark/benchmark.h>

#include <STEPControl_Reader.hxx>
#include <ctime>
#include <sstream>

#include "core/units/edit.hpp"
#include "core/units/plan.hpp"
#include "part/product.hpp"
#include "part/step.hpp"
#include "tests/part/parts.hpp"

namespace {

using namespace ridgeline;

const std::string& name_of(const benchmark::State& state) {
  return part::turned_parts[static_cast<std::size_t>(state.range(0))];
}

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void plan(benchmark::State& state) {
  const std::string text = part::part_text(RIDGELINE_TESTS, name_of(state));
  const units::PlanJob job{part::read_product(text).product, {}, {}, {}};
  for (auto _ : state) benchmark::DoNotOptimize(units::plan(job));
  state.SetLabel(name_of(state));
}

/// The first bar's end moved back and forth.
void edit(benchmark::State& state) {
  const std::string text = part::part_text(RIDGELINE_TESTS, name_of(state));
  const units::Program program = units::plan({part::read_product(text).product, {}, {}, {}});
  units::Unit unit = program.units.at(1);
  unit.shape.back().end.z += 3;
  const std::vector<units::Edit> edits{units::ChangeUnit{2, unit}};
  for (auto _ : state) benchmark::DoNotOptimize(units::edit(program, edits));
  state.SetLabel(name_of(state));
}

void load(const std::string& text) {
  std::istringstream stream(text);
  STEPControl_Reader reader;
  reader.ReadStream("part", stream);
  reader.TransferRoots();
  benchmark::DoNotOptimize(reader.OneShape());
}

void read(benchmark::State& state) {
  const std::string text = part::part_text(RIDGELINE_TESTS, name_of(state));
  part::prepare();
  double loading = 0;
  double reading = 0;
  for (auto _ : state) {
    const double begin = now();
    load(text);
    const double middle = now();
    benchmark::DoNotOptimize(part::read_product(text));
    loading += middle - begin;
    reading += now() - middle;
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["load_ms"] = 1e3 * loading / n;
  state.counters["read_ms"] = 1e3 * reading / n;
  state.counters["ratio"] = reading / loading;
  state.SetLabel(name_of(state));
}

BENCHMARK(plan)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK(edit)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK(read)->DenseRange(0, 3)->Unit(benchmark::kMillisecond)->MinTime(2);

}  // namespace
