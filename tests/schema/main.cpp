// reference write|check: makes docs/schema/ridgeline.schema.json and docs/reference.md from what
// the readers ask for, or compares them with what is there. Run from the source folder.

#include <fstream>
#include <iostream>
#include <sstream>

#include "tests/schema/corpus.hpp"
#include "tests/schema/schema.hpp"

namespace {

using namespace ridgeline;

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Writes, or tells whether the file is so.
bool settle(const std::string& path, const std::string& text, bool is_check) {
  if (!is_check) {
    std::ofstream(path, std::ios::binary) << text;
    return true;
  }
  if (read(path) == text) return true;
  std::cerr << path << " is not what the readers ask for: run scripts/reference\n";
  return false;
}

int run(bool is_check) {
  jobs::Recording recording;
  schema::record(schema::samples(), recording);
  const schema::Descriptions descriptions =
      schema::Descriptions::parse(read("docs/schema/descriptions.json"));
  const std::string gaps = schema::gaps(recording, descriptions);
  std::cerr << gaps;
  if (!gaps.empty()) return 1;
  const bool is_schema_so =
      settle("docs/schema/ridgeline.schema.json",
             schema::json_schema(recording, descriptions).dump(1) + "\n", is_check);
  const bool is_page_so =
      settle("docs/reference.md", schema::reference(recording, descriptions), is_check);
  return is_schema_so && is_page_so ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc < 2 || std::string(argv[1]) != "write");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
