#include "jobs/recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "jobs/reader.hpp"

namespace ridgeline::jobs {
namespace {

thread_local Recording* recording = nullptr;

std::vector<std::string> tokens_of(const std::string& pointer) {
  std::vector<std::string> tokens;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    tokens.push_back(pointer.substr(at + 1, end - at - 1));
    at = end;
  }
  return tokens;
}

/// Where the limits differ from document to document, they hang on something else of it: none is
/// stated.
void widen(Reading& to, const Reading& by) {
  constexpr Range any;
  if (to.min != by.min || to.open_min != by.open_min) to.min = any.min, to.open_min = false;
  if (to.max != by.max || to.open_max != by.open_max) to.max = any.max, to.open_max = false;
  if (to.unit != by.unit) to.unit.clear();
  for (const std::string& word : by.words) {
    if (std::ranges::find(to.words, word) == to.words.end()) to.words.push_back(word);
  }
}

}  // namespace

Record::Member& Record::member(std::string_view key) {
  const auto found = std::ranges::find(members, key, &Member::key);
  if (found != members.end()) return *found;
  members.push_back({std::string(key), 0, {}, std::make_unique<Record>()});
  return members.back();
}

Recording::Recording() {
  recording = this;
}

Recording::~Recording() {
  recording = nullptr;
}

Recording* Recording::current() {
  return recording;
}

void Recording::begin(const std::string& definition, const Places& places) {
  definition_ = definition;
  places_ = places;
  visits_.clear();
}

void Recording::end() {
  for (const auto& [pointer, visit] : visits_) {
    Record& record = at(pointer);
    ++record.visits;
    record.finished += visit.is_finished ? 1 : 0;
    for (const std::string& key : visit.required) ++record.member(key).required;
  }
  visits_.clear();
}

Record& Recording::at(const std::string& pointer) {
  Record* record = &definitions[definition_];
  std::string place;
  for (const std::string& token : tokens_of(pointer)) {
    const auto member = std::ranges::find(record->members, token, &Record::Member::key);
    const bool is_known = member != record->members.end();
    const auto literal = places_.find(fmt::format("{}/{}", place, token));
    place += '/';
    place += is_known || literal != places_.end() ? token : "*";
    const auto other = places_.find(place);
    if (!is_known && literal == places_.end() && !record->each) {
      record->each = std::make_unique<Record>();
    }
    Record* const here = is_known ? member->value.get() : record->each.get();
    if (other != places_.end()) {
      if (here != nullptr) here->definitions.insert(other->second);
      record = &definitions[other->second];
    } else {
      record = here;
    }
  }
  return *record;
}

void Recording::read(const std::string& pointer, Reading reading) {
  Record& record = at(pointer);
  const auto same = std::ranges::find(record.readings, reading.type, &Reading::type);
  if (same == record.readings.end()) {
    record.readings.push_back(std::move(reading));
  } else {
    widen(*same, reading);
  }
}

void Recording::object(const std::string& pointer) {
  read(pointer, {Reading::Type::Object, 0, 0, false, false, {}, {}});
  visits_[pointer];
}

void Recording::finish(const std::string& pointer) {
  visits_[pointer].is_finished = true;
}

void Recording::member(const std::string& pointer, std::string_view key, bool is_required) {
  at(pointer).member(key);
  if (is_required) visits_[pointer].required.emplace(key);
}

void Recording::otherwise(const std::string& pointer, std::string_view key,
                          const nlohmann::json& value) {
  Record::Member& member = at(pointer).member(key);
  if (!member.otherwise) {
    member.otherwise = value;
  } else if (*member.otherwise != value) {
    member.otherwise = nullptr;
  }
}

Reading reading_of(Reading::Type type, const Range& range) {
  return {type, range.min, range.max, range.open_min, range.open_max, std::string(range.unit), {}};
}

}  // namespace ridgeline::jobs
