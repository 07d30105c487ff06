#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::jobs {

struct Range;

/// One way in which a reader took a value.
struct Reading {
  enum class Type {
    Number,
    NumberOrText,
    Integer,
    Boolean,
    String,
    Name,
    Words,
    Null,
    Vector,
    Direction,
    Numbers,
    Array,
    Object
  };
  Type type = Type::Object;
  double min = 0, max = 0;  ///< of numbers; of an array: its size
  bool open_min = false, open_max = false;
  std::string unit;
  std::vector<std::string> words;
};

/// Everything that readers asked of one place of a document.
struct Record {
  struct Member {
    std::string key;
    int required = 0;                         ///< visits that could not do without
    std::optional<nlohmann::json> otherwise;  ///< its default; null: not always the same
    std::unique_ptr<Record> value;
  };
  std::vector<Reading> readings;      ///< each type once, its limits the widest that were asked
  std::vector<Member> members;        ///< of an object, in the order of asking
  std::set<std::string> definitions;  ///< whose records hold what stands here
  std::unique_ptr<Record> each;       ///< elements of an array; members of any key
  int visits = 0;                     ///< as an object: places in documents
  int finished = 0;                   ///< of these, those that refused what nobody asked for

  Member& member(std::string_view key);
};

/// What the readers of this thread ask for while it lives: the schema and the reference of the
/// documentation are made from it, so that no table stands beside the code that validates.
class Recording {
public:
  /// A place that has a definition of its own, e.g. {"/tool", "tool"}.
  using Places = std::map<std::string, std::string>;

  Recording();
  ~Recording();  ///< of the thread that made it
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// A document begins, whose definition is this.
  void begin(const std::string& definition, const Places& places);
  /// It has been read: counts what it was asked for.
  void end();

  std::map<std::string, Record> definitions;

  // Called by the readers, with the pointer of the value. nullptr: nobody records.
  static Recording* current();
  void read(const std::string& pointer, Reading reading);
  void object(const std::string& pointer);
  void finish(const std::string& pointer);
  void member(const std::string& pointer, std::string_view key, bool is_required);
  void otherwise(const std::string& pointer, std::string_view key, const nlohmann::json& value);

private:
  /// What one object of the document was asked for.
  struct Visit {
    std::set<std::string, std::less<>> required;
    bool is_finished = false;
  };
  Record& at(const std::string& pointer);
  std::map<std::string, Visit> visits_;  ///< by pointer
  std::string definition_;
  Places places_;
};

/// A reading of a number in a range.
Reading reading_of(Reading::Type type, const Range& range);

}  // namespace ridgeline::jobs
