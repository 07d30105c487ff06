#include "tests/schema/corpus.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "jobs/answer.hpp"
#include "jobs/definitions.hpp"
#include "service/library.hpp"

namespace ridgeline::schema {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The command line sends a file's text in the place of its path.
void send_content(Json& document, const fs::path& folder, const char* key) {
  if (!document.contains(key) || !document[key].is_string()) return;
  const fs::path file = folder / document[key].get<std::string>();
  if (!fs::is_regular_file(file)) return;
  document[std::string(key) + "_step"] = read(file);
  document.erase(key);
}

void add(const fs::path& path, std::vector<Sample>& samples) {
  Json document = Json::parse(read(path));
  if (document.is_object() && document.contains("definitions")) document = document["definitions"];
  if (document.is_array()) {
    for (const Json& each : document)
      samples.push_back({path.string(), each.at("kind").get<std::string>(), each});
  } else if (document.contains("job")) {
    send_content(document, path.parent_path(), "product");
    send_content(document, path.parent_path(), "stock");
    samples.push_back({path.string(), document["job"].get<std::string>(), document});
  }
}

/// Where a document is of the kind of another.
jobs::Recording::Places places_of(const Sample& sample) {
  const std::string& d = sample.definition;
  const auto edge = [](const std::string& at) {
    return jobs::Recording::Places{{at + "/workpiece", "workpiece"},
                                   {at + "/hole", "hole"},
                                   {at + "/tool", "tool"},
                                   {at + "/tool/dynamics", "dynamics"},
                                   {at + "/workpiece/holes/*", "hole"}};
  };
  jobs::Recording::Places places = edge("");
  if (d == "tool") places = {{"/dynamics", "dynamics"}};
  if (d == "units" || d == "part") places = {{"/product", "product"}};
  if (d == "workpiece") places = {{"/holes/*", "hole"}};
  if (d == "cycle") places = {{"/params", "cycle_parameters"}, {"/program", "cycle_program"}};
  if (d == "verify") {
    places = {{"/against", "chamfer"}};
    places.merge(edge("/against"));
  }
  if (d == "predict") {
    places = {{"/tool", "tool"},
              {"/tool/dynamics", "dynamics"},
              {"/dynamics", "dynamics"},
              {"/material", "material"},
              {"/options", "iteration"},
              {"/case", "case"},
              {"/along/params", "cycle_parameters"},
              {"/along/program", "cycle_program"}};
    for (const std::string before : {"/warm_from", "/warm_from/warm_from"}) {
      places[before] = "warm_start";
      places[before + "/case"] = "case";
      places[before + "/options"] = "iteration";
    }
    if (sample.document.contains("along")) {
      const std::string kind = sample.document["along"].at("job");
      places["/along"] = kind == "chamfer" ? kind : "along_" + kind;
      if (kind == "program") places.erase("/along/program");
      places.merge(edge("/along"));
    }
  }
  return places;
}

}  // namespace

std::vector<Sample> samples() {
  // Long computations, of which tests/schema/jobs has short ones.
  const std::set<fs::path> left_out = {"clients/examples/predict/program.json",
                                       "clients/examples/predict/cycle.json"};
  std::vector<fs::path> files;
  for (const char* folder : {"clients/examples", "tests/schema/jobs"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".json" && !left_out.contains(entry.path()))
        files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Sample> samples;
  for (const fs::path& file : files) add(file, samples);
  return samples;
}

void record(const std::vector<Sample>& samples, jobs::Recording& recording) {
  service::Library library(":memory:", "schema");
  std::vector<Json> definitions;
  for (const Sample& sample : samples)
    if (sample.document.contains("kind")) definitions.push_back(sample.document);
  library.put_all(definitions, "schema");
  // What reads all of a document before it computes need not compute.
  std::stop_source stop;
  stop.request_stop();
  const Progress none{{}, stop.get_token()};
  for (const Sample& sample : samples) {
    const bool is_read_first = sample.definition == "chamfer" || sample.document.contains("case");
    recording.begin(sample.definition, places_of(sample));
    jobs::Answer answer;
    if (sample.document.contains("kind"))
      jobs::validate_definition(sample.document);
    else
      answer =
          jobs::answer(sample.document.dump(), "json", library, is_read_first ? none : Progress{});
    const bool is_refused = !answer.document.is_null() && jobs::is_error(answer);
    if (is_refused && answer.document["error"]["code"] != "cancelled")
      throw std::runtime_error(sample.name + ": " + answer.document.dump());
    recording.end();
  }
}

}  // namespace ridgeline::schema
