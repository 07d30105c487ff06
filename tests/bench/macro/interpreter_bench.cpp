// Macro statements and plain G1 lines a second of processor time, and the same texts through
// LinuxCNC's interpreter (rs274), started beside it, processor time of both. rs274 also prints a
// line a move, into /dev/null, as its library does not run alone.

#include <benchmark/benchmark.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/macro/interpreter.hpp"

namespace {

using namespace ridgeline;

constexpr int passes = 200'000;
constexpr int statements_a_pass = 6;  // WHILE, four assignments, END
constexpr int lines = 200'000;

std::string loop(bool is_linuxcnc) {
  const std::string n = std::to_string(passes);
  if (is_linuxcnc) {
    return "#1=0\n#5=0\no1 while [#1 LT " + n +
           "]\n#2=[#1*2+3]\n#3=[#2/7-#1]\n#5=[#5+#3*0.5]\n#1=[#1+1]\no1 endwhile\nM2\n";
  }
  return "O1\n#1=0\n#5=0\nWHILE[#1 LT " + n +
         "]DO1\n#2=#1*2+3\n#3=#2/7-#1\n#5=#5+#3*0.5\n#1=#1+1\nEND1\nM30\n";
}

std::string plain_lines() {
  std::string text = "G90 G17 G21 G54\nG01 F500.\n";
  for (int i = 0; i < lines; ++i) {
    text += "X" + std::to_string(i % 977 * 0.125) + "Y" + std::to_string(i % 1013 * 0.25) + "Z-" +
            std::to_string(i % 17 * 0.5) + "\n";
  }
  return text;
}

double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Processor time of rs274 on a text [s]; 0: it is not installed or failed.
double rs274_seconds(const std::string& text) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("macro_bench-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "p.ngc") << text;
  std::ofstream(folder / "tool.tbl") << "T1 P1 D0.1 Z1\n";
  const std::string command =
      "cd " + folder.string() + " && rs274 -g -n 2 -t tool.tbl -v fresh.var p.ngc > /dev/null 2>&1";
  const double before = children_seconds();
  const int status = std::system(command.c_str());
  const double spent = children_seconds() - before;
  std::filesystem::remove_all(folder);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? spent : 0;
}

void run_beside(benchmark::State& state, const std::string& own, const std::string& other,
                double items) {
  const double theirs = rs274_seconds(other);
  macro::Options options;
  for (auto _ : state) {
    const macro::Result result = macro::run(own, options);
    if (result.alarm) state.SkipWithError("alarm");
    benchmark::DoNotOptimize(result.position);
  }
  state.counters["per_second"] = benchmark::Counter(items * static_cast<double>(state.iterations()),
                                                    benchmark::Counter::kIsRate);
  state.counters["rs274_per_second"] = theirs > 0 ? items / theirs : 0;
}

void macro_statements(benchmark::State& state) {
  run_beside(state, loop(false), loop(true), 1.0 * passes * statements_a_pass);
}
BENCHMARK(macro_statements)->Unit(benchmark::kMillisecond);

void g1_lines(benchmark::State& state) {
  const std::string text = plain_lines();
  run_beside(state, text + "M30\n", text + "M2\n", lines);
}
BENCHMARK(g1_lines)->Unit(benchmark::kMillisecond);

}  // namespace
