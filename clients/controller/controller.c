/* What a maker of a control would build in: asks the service for a chamfer path and prints its tool
 * centres, with the C API of DDS and the types of idl/ridgeline.idl alone. No JSON, no C++, one
 * file.
 *
 *   controller [-d DOMAIN] [-t SECONDS] WORKPIECE HOLE inner|outer entry|exit TOOL WIDTH
 *
 * Prints one line "x y z" in mm for each point of the cut, in cutting order. Exit status: 0 done, 1
 * refused by the service (its reason on standard error), 2 usage, 3 no service or no answer in
 * time. DDS is configured by CYCLONEDDS_URI. */

#include <dds/dds.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ridgeline.h"

enum { DONE = 0, REFUSED = 1, USAGE = 2, NO_ANSWER = 3 };

/* The tool centres as they come in, chunk by chunk. */
typedef struct Answer {
  bool is_complete;
  bool is_refused;
  uint64_t number; /* which computation the chunks belong to */
  uint32_t chunks; /* of it, taken so far */
  double* centres; /* x, y, z, x, y, z, ... */
  uint64_t length; /* numbers in centres */
} Answer;

static void must(dds_return_t result, const char* what) {
  if (result >= 0) return;
  fprintf(stderr, "controller: %s: %s\n", what, dds_strretcode(result));
  exit(NO_ANSWER);
}

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type,
                          const char* name) {
  const dds_entity_t entity = dds_create_topic(participant, type, name, NULL, NULL);
  must(entity, name);
  return entity;
}

/* A partition of one client, "c_" and its name, or of one instance, "i_" and its name. */
static dds_qos_t* in_partition(const char* kind, const char* name) {
  char text[80];
  const char* partition = text;
  snprintf(text, sizeof text, "%s%s", kind, name);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_partition(qos, 1, &partition);
  return qos;
}

/* Replies come in a partition that only this client has. */
static dds_entity_t reply_reader(dds_entity_t participant, const char* client) {
  dds_qos_t* subscriber_qos = in_partition("c_", client);
  const dds_entity_t subscriber = dds_create_subscriber(participant, subscriber_qos, NULL);
  must(subscriber, "subscriber");
  dds_delete_qos(subscriber_qos);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  dds_qset_resource_limits(qos, 16, DDS_LENGTH_UNLIMITED,
                           16); /* the service waits when we are slow */
  const dds_entity_t reader = dds_create_reader(
      subscriber, topic(participant, &ridgeline_wire_Reply_desc, "ridgeline/reply"), qos, NULL);
  must(reader, "reply reader");
  dds_delete_qos(qos);
  return reader;
}

static dds_entity_t instance_reader(dds_entity_t participant) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t reader = dds_create_reader(
      participant, topic(participant, &ridgeline_wire_Instance_desc, "ridgeline/instance"), qos,
      NULL);
  must(reader, "instance reader");
  dds_delete_qos(qos);
  return reader;
}

/* Requests go into the partition of the instance that shall answer; they are worth nothing after
 * `timeout`. */
static dds_entity_t request_writer(dds_entity_t participant, const char* instance, double timeout) {
  dds_qos_t* publisher_qos = in_partition("i_", instance);
  const dds_entity_t publisher = dds_create_publisher(participant, publisher_qos, NULL);
  must(publisher, "publisher");
  dds_delete_qos(publisher_qos);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(2));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, -1, -1, -1);
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  dds_qset_lifespan(qos, (dds_duration_t)(timeout * 1e9));
  dds_qset_writer_data_lifecycle(qos, false);
  const dds_entity_t writer = dds_create_writer(
      publisher, topic(participant, &ridgeline_wire_Request_desc, "ridgeline/request"), qos, NULL);
  must(writer, "request writer");
  dds_delete_qos(qos);
  return writer;
}

/* The live instance with the least to do; false when there is none. */
static bool find_instance(dds_entity_t reader, char* name, size_t size) {
  enum { MOST = 64 };
  void* samples[MOST] = {NULL};
  dds_sample_info_t infos[MOST];
  const dds_return_t count = dds_read(reader, samples, infos, MOST, MOST);
  must(count, "instances");
  double least = 0;
  bool is_found = false;
  for (int i = 0; i < count; ++i) {
    const ridgeline_wire_Instance* instance = samples[i];
    if (!infos[i].valid_data || infos[i].instance_state != DDS_ALIVE_INSTANCE_STATE ||
        instance->state != ridgeline_wire_STATE_READY)
      continue;
    const double load = (double)(instance->running + instance->queued) /
                        (instance->workers > 0 ? instance->workers : 1);
    if (is_found && load >= least) continue;
    is_found = true;
    least = load;
    snprintf(name, size, "%s", instance->name);
  }
  if (count > 0) dds_return_loan(reader, samples, count);
  return is_found;
}

/* A request may leave when the service hears us and we hear the service. */
static bool is_matched(dds_entity_t writer, dds_entity_t reader) {
  dds_publication_matched_status_t out;
  dds_subscription_matched_status_t in;
  must(dds_get_publication_matched_status(writer, &out), "matched");
  must(dds_get_subscription_matched_status(reader, &in), "matched");
  return out.current_count > 0 && in.current_count > 0;
}

static void take_piece(Answer* answer, const ridgeline_wire_Piece* piece) {
  if (strcmp(piece->pointer, "/centres") != 0) return;
  if (answer->centres == NULL) {
    answer->length = 1;
    for (uint32_t i = 0; i < piece->shape._length; ++i) answer->length *= piece->shape._buffer[i];
    answer->centres = calloc(answer->length > 0 ? answer->length : 1, sizeof(double));
    if (answer->centres == NULL) {
      fprintf(stderr, "controller: no memory for %" PRIu64 " numbers\n", answer->length);
      exit(NO_ANSWER);
    }
  }
  if (piece->offset + piece->values._length <= answer->length)
    memcpy(answer->centres + piece->offset, piece->values._buffer,
           piece->values._length * sizeof(double));
}

static void take_chunk(Answer* answer, const ridgeline_wire_Reply* reply) {
  if (reply->status == ridgeline_wire_STATUS_ERROR) {
    fprintf(stderr, "controller: %s: %s\n", reply->error.code, reply->error.message);
    if (*reply->error.field != '\0') fprintf(stderr, "controller: field %s\n", reply->error.field);
    answer->is_complete = answer->is_refused = true;
    return;
  }
  if (answer->chunks > 0 && answer->number != reply->answer)
    return; /* the same answer, computed once more */
  answer->number = reply->answer;
  for (uint32_t i = 0; i < reply->arrays._length; ++i)
    take_piece(answer, &reply->arrays._buffer[i]);
  answer->is_complete = ++answer->chunks == reply->chunk_count;
}

static void take_replies(dds_entity_t reader, const dds_SampleIdentity* id, Answer* answer) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  const dds_return_t count = dds_take(reader, samples, infos, 16, 16);
  must(count, "replies");
  for (int i = 0; i < count && !answer->is_complete; ++i) {
    const ridgeline_wire_Reply* reply = samples[i];
    const dds_SampleIdentity* to = &reply->header.relatedRequestId;
    if (infos[i].valid_data && to->sequence_number.low == id->sequence_number.low &&
        to->sequence_number.high == id->sequence_number.high &&
        memcmp(&to->writer_guid, &id->writer_guid, sizeof id->writer_guid) == 0)
      take_chunk(answer, reply);
  }
  if (count > 0) dds_return_loan(reader, samples, count);
}

/* Waits until there is something to take, or for the time given. */
static void wait_for_data(dds_entity_t participant, dds_entity_t reader, dds_duration_t time) {
  const dds_entity_t condition = dds_create_readcondition(reader, DDS_ANY_STATE);
  const dds_entity_t waitset = dds_create_waitset(participant);
  must(dds_waitset_attach(waitset, condition, 0), "waitset");
  must(dds_waitset_wait(waitset, NULL, 0, time), "wait");
  dds_delete(waitset);
  dds_delete(condition);
}

/* Sends the request to the best instance, and to another when that one goes, until the answer is
 * whole or time is up. */
static bool ask(dds_entity_t participant, ridgeline_wire_Request* request, double timeout,
                Answer* answer) {
  const dds_time_t end = dds_time() + (dds_time_t)(timeout * 1e9);
  const dds_entity_t instances = instance_reader(participant);
  const dds_entity_t replies = reply_reader(participant, request->client);
  char instance[65] = "", best[65] = "";
  dds_entity_t writer = 0;
  bool is_sent = false;
  while (!answer->is_complete && dds_time() < end) {
    const bool is_there = find_instance(instances, best, sizeof best);
    if (is_there && (writer == 0 || (!is_sent && strcmp(best, instance) != 0))) {
      if (writer > 0) dds_delete(dds_get_parent(writer));
      snprintf(instance, sizeof instance, "%s", best);
      writer = request_writer(participant, instance, timeout);
    }
    if (writer > 0 && !is_sent && is_matched(writer, replies)) {
      must(dds_write(writer, request), "request");
      is_sent = true;
    }
    if (is_sent &&
        !is_matched(writer, replies)) { /* the instance is lost: ask again, with the same id */
      answer->chunks = 0;               /* what came of its answer is no part of another's */
      dds_delete(dds_get_parent(writer));
      writer = 0;
      is_sent = false;
    }
    wait_for_data(participant, replies, is_sent ? DDS_MSECS(100) : DDS_MSECS(2));
    take_replies(replies, &request->header.requestId, answer);
  }
  return answer->is_complete;
}

static bool parse(int argc, char** argv, dds_domainid_t* domain, double* timeout,
                  ridgeline_wire_ChamferJob* job) {
  int at = 1;
  for (; at + 1 < argc && argv[at][0] == '-'; at += 2) {
    if (strcmp(argv[at], "-d") == 0)
      *domain = (dds_domainid_t)strtoul(argv[at + 1], NULL, 10);
    else if (strcmp(argv[at], "-t") == 0)
      *timeout = strtod(argv[at + 1], NULL);
    else
      return false;
  }
  if (argc - at != 6 || !(*timeout > 0)) return false;
  job->workpiece = argv[at];
  job->hole = argv[at + 1];
  job->edge =
      strcmp(argv[at + 2], "outer") == 0 ? ridgeline_wire_EDGE_OUTER : ridgeline_wire_EDGE_INNER;
  job->side =
      strcmp(argv[at + 3], "exit") == 0 ? ridgeline_wire_SIDE_EXIT : ridgeline_wire_SIDE_ENTRY;
  job->tool = argv[at + 4];
  char* end = NULL;
  job->width = strtod(argv[at + 5], &end);
  return *end == '\0';
}

int main(int argc, char** argv) {
  dds_domainid_t domain = 0;
  double timeout = 10;
  char none[] = "";
  ridgeline_wire_Request request;
  memset(&request, 0, sizeof request); /* whatever is not set below has the default of the job */
  ridgeline_wire_ChamferJob* job = &request.call._u.chamfer;
  request.call._d = ridgeline_wire_OPERATION_CHAMFER;
  job->tool_axis = job->dialect = job->work_offset = none;
  if (!parse(argc, argv, &domain, &timeout, job)) {
    fprintf(stderr,
            "usage: controller [-d DOMAIN] [-t SECONDS] WORKPIECE HOLE inner|outer entry|exit TOOL "
            "WIDTH\n");
    return USAGE;
  }
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  must(participant, "participant");
  dds_guid_t guid;
  must(dds_get_guid(participant, &guid), "guid");
  memcpy(&request.header.requestId.writer_guid, guid.v, sizeof guid.v);
  request.header.requestId.sequence_number.low = 1;
  for (int i = 0; i < 12; ++i) snprintf(request.client + 2 * i, 3, "%02x", guid.v[i]);
  strcpy(request.format, "json");
  request.timeout = timeout;

  Answer answer;
  memset(&answer, 0, sizeof answer);
  const bool is_answered = ask(participant, &request, timeout, &answer);
  for (uint64_t i = 0; i + 2 < answer.length && is_answered; i += 3)
    printf("%.17g %.17g %.17g\n", answer.centres[i], answer.centres[i + 1], answer.centres[i + 2]);
  free(answer.centres);
  dds_delete(
      participant); /* or the service waits for our acknowledgements until its lease on us ends */
  if (!is_answered) {
    fprintf(stderr, "controller: no answer within %g s\n", timeout);
    return NO_ANSWER;
  }
  return answer.is_refused ? REFUSED : DONE;
}
