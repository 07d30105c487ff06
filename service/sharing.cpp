#include "service/sharing.hpp"

#include <chrono>

#include "jobs/definitions.hpp"
#include "jobs/parse.hpp"
#include "service/log.hpp"
#include "service/wire.hpp"

namespace ridgeline::service {
namespace {

using namespace std::chrono_literals;

constexpr auto acknowledge_limit = 1s;
constexpr auto look_interval = 250ms;  // for changes by other processes of the same file
constexpr int batch = 256;

Change change_of(const ridgeline_wire_Definition& sample) {
  return {.kind = sample.kind,
          .name = sample.name,
          .revision = sample.revision,
          .time = sample.time,
          .origin = sample.origin,
          .instance = sample.made_at,
          .request = sample.asked_by,
          .removed = sample.removed,
          .document = sample.document};
}

/// Throws Error when a change is not what it says to be.
void check(const Change& change) {
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::BadInput, std::string(what) + " in a change of " + change.kind + " \"" +
                                         change.name + "\" from another instance");
  };
  if (change.kind.empty() || change.name.empty() || change.revision < 1 || change.origin.empty()) {
    refuse("no kind, name, revision or origin");
  }
  if (change.removed) {
    if (!change.document.empty()) refuse("a removal with a document");
    return;
  }
  const jobs::DefinitionKey key = jobs::key_of(jobs::parse(change.document));
  if (key.kind != change.kind || key.name != change.name) refuse("another kind or name");
}

void write(const dds::Entity& writer, const Change& change) {
  ridgeline_wire_Definition sample{};
  wire::copy(change.kind, sample.kind);
  wire::copy(change.name, sample.name);
  sample.revision = change.revision;
  wire::copy(change.origin, sample.origin);
  sample.time = change.time;
  wire::copy(change.instance, sample.made_at);
  wire::copy(change.request, sample.asked_by);
  sample.removed = change.removed;
  sample.document = wire::borrowed(change.document);
  dds::check(dds_write(writer.get(), &sample), "dds_write");
}

dds::Entity reader_of(const dds::Entity& participant, const dds::Entity& topic) {
  const dds::Qos qos = dds::qos(dds::Topic::Definition);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return {dds_create_reader(participant.get(), topic.get(), qos.get(), nullptr),
          "dds_create_reader"};
}

}  // namespace

Sharing::Sharing(const dds::Entity& participant, Library& library)
    : library_(library),
      topic_(dds::create_topic(participant, dds::Topic::Definition)),
      writer_(dds_create_writer(participant.get(), topic_.get(),
                                dds::qos(dds::Topic::Definition).get(), nullptr),
              "dds_create_writer"),
      reader_(reader_of(participant, topic_)),
      stop_(dds_create_guardcondition(participant.get()), "dds_create_guardcondition"),
      data_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE), "dds_create_readcondition"),
      waitset_(dds_create_waitset(participant.get()), "dds_create_waitset") {
  dds::check(dds_waitset_attach(waitset_.get(), stop_.get(), 0), "dds_waitset_attach");
  dds::check(dds_waitset_attach(waitset_.get(), data_.get(), 0), "dds_waitset_attach");
  thread_ = std::thread([this] { run(); });
}

Sharing::~Sharing() {
  dds_set_guardcondition(stop_.get(), true);
  thread_.join();
}

void Sharing::publish_new() {
  const std::scoped_lock lock(publishing_);
  for (;;) {
    std::int64_t after = published_;
    const std::vector<Change> changes = library_.changes(after, batch);
    if (after == published_) break;
    Summary added;
    for (const Change& change : changes) {
      write(writer_, change);
      ++added.changes;
      added.digest ^= digest(change);
    }
    published_ = after;
    const int conflicts = library_.conflicts();
    const std::scoped_lock summary_lock(summary_mutex_);
    summary_.changes += added.changes;
    summary_.digest ^= added.digest;
    summary_.conflicts = static_cast<std::uint64_t>(conflicts);
  }
}

void Sharing::publish() {
  publish_new();
  if (dds_wait_for_acks(writer_.get(), dds::duration(acknowledge_limit)) != DDS_RETCODE_OK) {
    log::event(log::Level::Warning, "library_not_acknowledged",
               {{"message", "an instance was slow to take a change; it gets it when it can"}});
  }
}

/// Did any sample come?
bool Sharing::take() {
  const dds::Taken<ridgeline_wire_Definition, batch> samples(reader_);
  samples.for_each([this](const ridgeline_wire_Definition& sample, const dds_sample_info_t& info) {
    if (!info.valid_data) return;
    try {
      Change change = change_of(sample);
      check(change);
      taken_.push_back(std::move(change));
    } catch (const Error& error) {
      log::event(log::Level::Error, "library_refused", {{"message", error.what()}});
    }
  });
  return !samples.empty();
}

void Sharing::merge() {
  if (taken_.empty()) return;
  const int conflicts = library_.conflicts();
  const int added = library_.merge(taken_);
  taken_.clear();
  if (added > 0) log::event(log::Level::Info, "library_merged", {{"changes", added}});
  if (library_.conflicts() > conflicts) {
    log::event(log::Level::Warning, "library_conflict",
               {{"message",
                 "two instances made the same revision of a definition: the later one "
                 "holds, \"history\" shows both"},
                {"conflicts", library_.conflicts()}});
  }
}

void Sharing::run() {
  for (bool has_failed = false;;) {
    try {
      dds::check(dds_waitset_wait(waitset_.get(), nullptr, 0, dds::duration(look_interval)),
                 "dds_waitset_wait");
      bool is_stopped = false;
      dds::check(dds_read_guardcondition(stop_.get(), &is_stopped), "dds_read_guardcondition");
      if (is_stopped) return;
      while (take()) {
      }
      merge();
      publish_new();
      has_failed = false;
    } catch (const std::exception& error) {  // a full disk: what was taken is kept and tried again
      if (!has_failed) log::event(log::Level::Error, "library", {{"message", error.what()}});
      has_failed = true;
      std::this_thread::sleep_for(look_interval);
    }
  }
}

Sharing::Summary Sharing::summary() const {
  const std::scoped_lock lock(summary_mutex_);
  return summary_;
}

}  // namespace ridgeline::service
