// The longest time that a large job of each kind computes without looking whether it is cancelled:
// what a cancel can take. `cancel_gaps [TEXT]` runs the cases whose name holds TEXT.

#include <chrono>
#include <iostream>
#include <map>
#include <mutex>
#include <string>

#include "jobs/answer.hpp"
#include "tests/bench/jobs/large_jobs.hpp"

namespace {

using namespace ridgeline;
using Clock = std::chrono::steady_clock;

/// Times between looks, the longest by what the look before said.
struct Gaps {
  std::mutex mutex;
  Clock::time_point last = Clock::now();
  std::string stage = "start";
  double longest = 0;
  std::string at;
  std::size_t looks = 0;

  void look(std::string_view next) {
    const std::scoped_lock lock(mutex);
    const auto now = Clock::now();
    const double gap = std::chrono::duration<double>(now - last).count();
    if (gap > longest) {
      longest = gap;
      at = stage + " - " + std::string(next);
    }
    last = now;
    stage = next;
    ++looks;
  }
};

}  // namespace

int main(int count, char** arguments) {
  const std::string wanted = count > 1 ? arguments[1] : "";
  std::cout << "| job | format | answer in s | looks | longest between two, ms | where |\n"
               "|---|---|---|---|---|---|\n";
  double worst = 0;
  for (const bench::LargeJob& job : bench::large_jobs()) {
    if ((job.name + " " + job.format).find(wanted) == std::string::npos) continue;
    Gaps gaps;
    const Progress progress{.report = [&gaps](double, std::string_view stage) { gaps.look(stage); },
                            .stop = {}};
    const std::string text = job.document.dump();
    const Clock::time_point begin = gaps.last = Clock::now();
    const jobs::Answer answer = jobs::answer(text, job.format, jobs::NoDefinitions(), progress);
    const double taken = std::chrono::duration<double>(Clock::now() - begin).count();
    gaps.look("end");
    if (jobs::is_error(answer)) {
      std::cerr << job.name << ": " << answer.document.dump() << '\n';
      return 1;
    }
    worst = std::max(worst, gaps.longest);
    std::cout << "| " << job.name << " | " << job.format << " | " << taken << " | " << gaps.looks
              << " | " << 1e3 * gaps.longest << " | " << gaps.at << " |" << std::endl;
  }
  std::cout << "\nlongest of all: " << 1e3 * worst << " ms\n";
}
