#include "tests/core/nc/rs274.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline::nc {
namespace {

std::vector<double> numbers_in(std::string text) {
  for (char& c : text) {
    if (c == ',' || c == '(' || c == ')') c = ' ';
  }
  std::istringstream in(text);
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

/// Reads the canonical calls: "   22 N..... ARC_FEED(7.1235, 2.0000, ...)".
void read_canon(CanonRun& run) {
  char plane = 'Z';
  double feed = 0;
  std::istringstream lines(run.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t open = line.find('(');
    if (open == line.npos) continue;
    CanonMove move;
    const std::size_t begin = line.find_last_of(' ', open) + 1;
    move.call = line.substr(begin, open - begin);
    const std::vector<double> n = numbers_in(line.substr(open));
    if (move.call == "SELECT_PLANE") {
      plane = line.find("_XY") != line.npos ? 'Z' : line.find("_XZ") != line.npos ? 'Y' : 'X';
    } else if (move.call == "SET_FEED_RATE") {
      feed = n.at(0);
    } else if (move.call == "USE_TOOL_LENGTH_OFFSET") {
      run.length_offsets.emplace_back(n.at(0), n.at(1), n.at(2));
    } else if (move.call == "STRAIGHT_TRAVERSE" || move.call == "STRAIGHT_FEED") {
      move.to = {n.at(0), n.at(1), n.at(2)};
      move.feed = move.call == "STRAIGHT_FEED" ? feed : 0;
      run.moves.push_back(move);
    } else if (move.call == "ARC_FEED") {
      // end1, end2, centre1, centre2, turns, height; G18 lists Z first, then X.
      const int first = plane == 'Z' ? 0 : plane == 'Y' ? 2 : 1;
      const int second = (first + 1) % 3, third = (first + 2) % 3;
      move.to[first] = n.at(0);
      move.to[second] = n.at(1);
      move.to[third] = n.at(5);
      move.centre[first] = n.at(2);
      move.centre[second] = n.at(3);
      move.turns = static_cast<int>(n.at(4));
      move.plane = plane;
      move.feed = feed;
      run.moves.push_back(move);
    }
  }
}

}  // namespace

CanonRun run_rs274(const std::string& program) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("program.ngc")) << program;
  // The stand-alone driver reads the tool table in inches.
  std::ofstream table(folder.file("tool.tbl"));
  table << "T12 P12 D0.236220472440945 Z3.93700787401575\n";
  for (int tool = 1; tool <= 8; ++tool) table << "T" << tool << " P" << tool << " Z0\n";
  table.close();
  // Its processes share memory of the machine and can take it from each other: one at a time.
  const std::string lock = (std::filesystem::temp_directory_path() / "rs274.lock").string();
  const std::string command = "cd " + folder.file("") + " && flock " + lock +
                              " timeout 20 rs274 -g -n 2 -t " + folder.file("tool.tbl") + " -v " +
                              folder.file("fresh.var") + " " + folder.file("program.ngc") + " > " +
                              folder.file("canon") + " 2>&1";
  CanonRun run;
  const int status = std::system(command.c_str());
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::stringstream output;
  output << std::ifstream(folder.file("canon")).rdbuf();
  run.output = output.str();
  read_canon(run);
  return run;
}

}  // namespace ridgeline::nc
