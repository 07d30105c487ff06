#include "service/library_job.hpp"

#include <fmt/chrono.h>

#include <array>
#include <chrono>

#include "jobs/reader.hpp"

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;

enum class Operation { Put, Get, List, Remove, Import, Export, History };
constexpr jobs::Choices<Operation, 7> operations{{{"put", Operation::Put},
                                                  {"get", Operation::Get},
                                                  {"list", Operation::List},
                                                  {"remove", Operation::Remove},
                                                  {"import", Operation::Import},
                                                  {"export", Operation::Export},
                                                  {"history", Operation::History}}};

/// A name, or a tool's number as a number.
std::string name_of(const jobs::Value& value) {
  if (value.json().is_number()) return std::to_string(value.integer(0, 99'999'999));
  return value.name();
}

[[noreturn]] void refuse_unknown(const std::string& kind, const std::string& name,
                                 std::optional<int> revision) {
  const std::string which = revision ? " with revision " + std::to_string(*revision) : "";
  jobs::refuse(
      {.code = ErrorCode::UnknownDefinition,
       .field = revision ? "/revision" : "/name",
       .value = revision ? std::to_string(*revision) : name,
       .limit = revision ? "a revision that \"history\" lists" : "a name that \"list\" lists",
       .message = "the library has no " + kind + " \"" + name + "\"" + which});
}

Json with_receipt(Json result, const Receipt& receipt) {
  result["kind"] = receipt.kind;
  result["name"] = receipt.name;
  result["revision"] = receipt.revision;
  result["new"] = receipt.is_new;
  return result;
}

Json get(Json result, jobs::Object& job, const Library& library) {
  const std::string kind = job.required("kind").name();
  const std::string name = name_of(job.required("name"));
  std::optional<int> revision;
  if (const auto value = job.optional("revision")) revision = value->integer(1, 2'147'483'647);
  job.finish();
  const std::optional<Change> change = library.get(kind, name, revision);
  if (!change || (change->removed && !revision)) refuse_unknown(kind, name, revision);
  result["kind"] = change->kind;
  result["name"] = change->name;
  result["revision"] = change->revision;
  result["time"] = time_text(change->time);
  result["instance"] = change->instance;
  if (change->removed) {
    result["removed"] = true;
  } else {
    result["definition"] = Json::parse(change->document);
  }
  return result;
}

std::optional<std::string> optional_kind(jobs::Object& job) {
  const auto value = job.optional("kind");
  job.finish();
  return value ? std::optional(value->name()) : std::nullopt;
}

Json list(Json result, jobs::Object& job, const Library& library) {
  result["definitions"] = Json::array();
  for (const Listed& each : library.list(optional_kind(job))) {
    Json line = {{"kind", each.kind},
                 {"name", each.name},
                 {"revision", each.revision},
                 {"time", time_text(each.time)},
                 {"instance", each.instance}};
    if (each.alias) line["number"] = std::stoi(*each.alias);
    if (each.is_damaged) line["damaged"] = true;
    result["definitions"].push_back(std::move(line));
  }
  return result;
}

Json export_all(Json result, jobs::Object& job, const Library& library) {
  result["definitions"] = Json::array();
  for (const Listed& each : library.list(optional_kind(job))) {
    if (each.is_damaged) {
      result["damaged"].push_back({{"kind", each.kind}, {"name", each.name}});
      continue;
    }
    if (const auto definition = library.find(each.kind, each.name)) {
      result["definitions"].push_back(definition->document);
    }
  }
  return result;
}

Json history(Json result, jobs::Object& job, const Library& library) {
  const std::string kind = job.required("kind").name();
  std::string name = name_of(job.required("name"));
  job.finish();
  if (const auto held = library.get(kind, name)) name = held->name;
  const std::vector<Change> changes = library.history(kind, name);
  if (changes.empty()) refuse_unknown(kind, name, {});
  result["kind"] = kind;
  result["name"] = name;
  result["revisions"] = Json::array();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Change& change = changes[i];
    Json line = {{"revision", change.revision},
                 {"time", time_text(change.time)},
                 {"instance", change.instance},
                 {"origin", change.origin}};
    if (change.removed) {
      line["removed"] = true;
    } else {
      line["definition"] = Json::parse(change.document);
    }
    const bool is_overruled = i + 1 < changes.size() && changes[i + 1].revision == change.revision;
    if (is_overruled) line["overruled"] = true;  // by the same revision, made elsewhere
    result["revisions"].push_back(std::move(line));
  }
  return result;
}

Json put(Json result, jobs::Object& job, Library& library, std::string_view request) {
  const jobs::Value definition = job.required("definition");
  job.finish();
  try {
    return with_receipt(std::move(result), library.put(definition.json(), request));
  } catch (const Error& error) {
    ErrorDetails details = error.details();
    if (error.code() != ErrorCode::Storage) details.field = definition.pointer() + details.field;
    throw Error(error.code(), error.what(), details);
  }
}

Json import_all(Json result, jobs::Object& job, Library& library, std::string_view request) {
  const jobs::Value definitions = job.required("definitions");
  job.finish();
  const std::vector<jobs::Value> values = definitions.array();
  const auto& documents = definitions.json().get_ref<const Json::array_t&>();
  int count = 0;
  result["definitions"] = Json::array();
  for (const Receipt& receipt : library.put_all(documents, request)) {
    result["definitions"].push_back(with_receipt(Json::object(), receipt));
    count += receipt.is_new ? 1 : 0;
  }
  result["new"] = count;
  return result;
}

Json remove(Json result, jobs::Object& job, Library& library, std::string_view request) {
  const std::string kind = job.required("kind").name();
  const std::string name = name_of(job.required("name"));
  job.finish();
  return with_receipt(std::move(result), library.remove(kind, name, request));
}

Json run(const Json& document, Library& library, std::string_view request) {
  jobs::Object job{jobs::Value(document)};
  const std::string kind = job.required("job").string();
  if (kind != "library") job.refuse("job", "library");
  const jobs::Value operation = job.required("operation");
  Json result = {{"job", "library"}, {"status", "ok"}, {"operation", operation.json()}};
  if (!library.damage().empty()) result["damage"] = library.damage();
  switch (operation.choice(operations)) {
    case Operation::Put: return put(std::move(result), job, library, request);
    case Operation::Get: return get(std::move(result), job, library);
    case Operation::List: return list(std::move(result), job, library);
    case Operation::Remove: return remove(std::move(result), job, library, request);
    case Operation::Import: return import_all(std::move(result), job, library, request);
    case Operation::Export: return export_all(std::move(result), job, library);
    case Operation::History: return history(std::move(result), job, library);
  }
  throw Error(ErrorCode::Internal, "an operation without a function");
}

}  // namespace

jobs::Answer answer_library(const Json& document, Library& library,
                            std::string_view request) noexcept {
  try {
    return {run(document, library, request), {}, {}};
  } catch (const Error& error) {
    return jobs::refusal(error);
  } catch (const std::exception& error) {
    return jobs::refusal(Error(ErrorCode::Internal, error.what()));
  }
}

std::string time_text(std::int64_t nanoseconds) {
  const std::int64_t milliseconds = nanoseconds / 1'000'000;
  const std::time_t seconds = milliseconds / 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(seconds), milliseconds % 1000);
}

}  // namespace ridgeline::service
