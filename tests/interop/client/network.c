// SPDX-License-Identifier: Apache-2.0
#include "network.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

// GenerateKeyhash: without it nobody else understands that a sample is disposed of.
static const char configuration[] =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address='127.0.0.1'"
    "/></Interfaces><AllowMulticast>false</AllowMulticast></"
    "General><Discovery><ParticipantIndex>auto"
    "</ParticipantIndex><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex><Peers>"
    "<Peer address='127.0.0.1'/></Peers></Discovery><Internal><GenerateKeyhash>true"
    "</GenerateKeyhash></Internal></Domain></CycloneDDS>";

static const int64_t second = 1000000000;

int64_t now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * second + time.tv_nsec;
}

static dds_entity_t made(dds_entity_t entity, const char* what) {
    if (entity >= 0) return entity;
    fprintf(stderr, "no %s: %s\n", what, dds_strretcode(entity));
    exit(4);
}

// A row of the table of topics in docs/protocol.md.
typedef struct {
    const char* name;
    const dds_topic_descriptor_t* type;
    bool reliable, lateJoiners;
    int32_t depth;
} TopicRow;

static const TopicRow presenceTopic = {"cortex/presence", &cortex_Presence_desc, true, true, 1};
static const TopicRow modelTopic = {"cortex/1/model", &cortex_Model_desc, true, true, 1};
static const TopicRow interestTopic = {"cortex/1/interest", &cortex_Interest_desc, true, true, 1};
static const TopicRow viewTopic = {"cortex/1/view/30", &cortex_Block_desc, false, false, 1};
static const TopicRow summaryTopic = {"cortex/1/view/summary", &cortex_Summary_desc, false, false,
                                      1};
static const TopicRow commandTopic = {"cortex/1/command", &cortex_Command_desc, true, false, 64};
// Each sender of commands has one of its own: its id follows.
static const TopicRow answerTopic = {"cortex/1/answer/", &cortex_Answer_desc, true, false, 64};

static const TopicRow pastTopic = {"cortex/1/past", &cortex_Past_desc, true, false, 64};

static dds_qos_t* qosOf(const TopicRow* row) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(
        qos, row->reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, second);
    dds_qset_durability(
        qos, row->lateJoiners ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, row->depth);
    return qos;
}

static dds_entity_t endpoint(const Tool* tool, const TopicRow* row, bool writes) {
    dds_qos_t* qos = qosOf(row);
    const dds_entity_t topic =
        made(dds_create_topic(tool->participant, row->type, row->name, qos, NULL), row->name);
    const dds_entity_t entity = writes ? dds_create_writer(tool->participant, topic, qos, NULL)
                                       : dds_create_reader(tool->participant, topic, qos, NULL);
    dds_delete_qos(qos);
    return made(entity, row->name);
}

void join(Tool* tool, dds_domainid_t domain) {
    memset(tool, 0, sizeof *tool);
    snprintf(tool->name, sizeof tool->name, "cyclone-client-%d", (int)getpid());
    struct timespec time;
    clock_gettime(CLOCK_REALTIME, &time);
    tool->epoch = time.tv_sec * 1000000 + time.tv_nsec / 1000;
    made(dds_create_domain(domain, configuration), "domain");
    tool->participant = made(dds_create_participant(domain, NULL, NULL), "participant");
    tool->presences = endpoint(tool, &presenceTopic, true);
    tool->presenceReader = endpoint(tool, &presenceTopic, false);
    tool->interests = endpoint(tool, &interestTopic, true);
    tool->modelReader = endpoint(tool, &modelTopic, false);
    tool->blocks = endpoint(tool, &viewTopic, false);
    tool->summaries = endpoint(tool, &summaryTopic, false);
    tool->commands = endpoint(tool, &commandTopic, true);
    tool->pasts = endpoint(tool, &pastTopic, false);
    char name[64];
    snprintf(name, sizeof name, "%s%.1s", answerTopic.name,
             hex(idOf(tool->name, NULL, NULL).octets));
    TopicRow answers = answerTopic;
    answers.name = name;
    tool->answers = endpoint(tool, &answers, false);
}

static void tell(const Tool* tool, char* state) {
    char host[64] = "";
    gethostname(host, sizeof host - 1);
    uint16_t major = 1;
    char asks[160];
    if (tool->asks != NULL) snprintf(asks, sizeof asks, "1 %s", tool->asks);
    const cortex_Extra all[] = {{.name = "person", .value = (char*)tool->person},
                                {.name = "asks", .value = tool->asks != NULL ? asks : NULL},
                                {.name = "past", .value = (char*)tool->past}};
    cortex_Extra extras[3];
    uint32_t said = 0;
    for (int i = 0; i < 3; ++i) {
        if (all[i].value != NULL) extras[said++] = all[i];
    }
    cortex_Presence presence = {.name = (char*)tool->name,
                                .host = host,
                                .epoch = tool->epoch,
                                .role = "tool",
                                .state = state,
                                .majors = {._length = 1, ._buffer = &major},
                                .interval = 100000000,
                                .security = "",
                                .extras = {._length = said, ._buffer = extras}};
    memcpy(presence.agent, idOf(tool->name, NULL, NULL).octets, 16);
    dds_write(tool->presences, &presence);
}

void leave(Tool* tool) {
    tell(tool, "stopping");
    dds_delete(tool->participant);
}

static Agent* agentNamed(Tool* tool, const char* name) {
    for (int i = 0; i < tool->agentCount; ++i) {
        if (strcmp(tool->agents[i].name, name) == 0) return &tool->agents[i];
    }
    if (tool->agentCount == mostAgents || strlen(name) >= sizeof tool->agents->name) return NULL;
    Agent* agent = &tool->agents[tool->agentCount++];
    strcpy(agent->name, name);
    return agent;
}

static Person* personIn(Tool* tool, const char* name) {
    for (int i = 0; i < tool->peopleCount; ++i) {
        if (strcmp(tool->people[i].tool, name) == 0) return &tool->people[i];
    }
    if (tool->peopleCount == mostPeople || strcmp(name, tool->name) == 0) return NULL;
    Person* person = &tool->people[tool->peopleCount++];
    snprintf(person->tool, sizeof person->tool, "%s", name);
    return person;
}

static void takeTool(Tool* tool, const cortex_Presence* presence) {
    const char *who = NULL, *asks = "";
    bool refused = false;
    char refusal[80];
    snprintf(refusal, sizeof refusal, "1 %s", tool->name);
    for (uint32_t i = 0; i < presence->extras._length; ++i) {
        const cortex_Extra* extra = &presence->extras._buffer[i];
        if (strcmp(extra->name, "person") == 0) who = extra->value;
        if (strcmp(extra->name, "asks") == 0) asks = extra->value;
        refused =
            refused || (strcmp(extra->name, "refuses") == 0 && strcmp(extra->value, refusal) == 0);
    }
    Person* person = who == NULL ? NULL : personIn(tool, presence->name);
    if (person == NULL) return;
    snprintf(person->person, sizeof person->person, "%s", who);
    snprintf(person->asks, sizeof person->asks, "%s", asks);
    person->refused = refused;
}

static void take(Tool* tool, const cortex_Presence* presence) {
    if (strcmp(presence->role, "tool") == 0) takeTool(tool, presence);
    Agent* agent = strcmp(presence->role, "agent") == 0 ? agentNamed(tool, presence->name) : NULL;
    if (agent == NULL || presence->epoch < agent->epoch) return;  // an earlier start of that name
    agent->epoch = presence->epoch;
    agent->cycle = presence->cycle;
    agent->period = presence->period;
    agent->types = presence->types;
    agent->simplexes = presence->simplexes;
    memcpy(agent->typesHash, presence->typesHash, 16);
    memcpy(agent->structureHash, presence->structureHash, 16);
    agent->heard = strcmp(presence->state, "running") == 0 ? now() : 0;
}

void step(Tool* tool) {
    if (now() >= tool->presenceDue) {
        tell(tool, "running");
        tool->presenceDue = now() + second / 10;
    }
    void* samples[mostAgents] = {NULL};
    dds_sample_info_t infos[mostAgents];
    const int count = dds_take(tool->presenceReader, samples, infos, mostAgents, mostAgents);
    for (int i = 0; i < count; ++i) {
        if (infos[i].valid_data) take(tool, samples[i]);
    }
    if (count > 0) dds_return_loan(tool->presenceReader, samples, count);
    dds_sleepfor(DDS_MSECS(10));
}

Models modelsOf(const Tool* tool) {
    enum { most = 4096 };
    Models models = {calloc(most, sizeof(void*)), 0};
    dds_sample_info_t* infos = calloc(most, sizeof *infos);
    models.count =
        dds_read_mask(tool->modelReader, models.samples, infos, most, most,
                      DDS_ALIVE_INSTANCE_STATE | DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE);
    free(infos);
    return models;
}

void letGo(const Tool* tool, Models* models) {
    if (models->count > 0) dds_return_loan(tool->modelReader, models->samples, models->count);
    free(models->samples);
}

void view(Tool* tool, const char* prefix) {
    char* path = (char*)prefix;
    cortex_View wanted = {.rate = 30, .prefixes = {._length = 1, ._buffer = &path}};
    cortex_Interest interest = {.name = (char*)tool->name,
                                .epoch = tool->epoch,
                                .views = {._length = 1, ._buffer = &wanted}};
    memcpy(interest.agent, idOf(tool->name, NULL, NULL).octets, 16);
    dds_write(tool->interests, &interest);
}

void viewSummary(Tool* tool) {
    cortex_Extra wanted = {.name = "summary", .value = "1"};
    cortex_Interest interest = {.name = (char*)tool->name,
                                .epoch = tool->epoch,
                                .extras = {._length = 1, ._buffer = &wanted}};
    memcpy(interest.agent, idOf(tool->name, NULL, NULL).octets, 16);
    dds_write(tool->interests, &interest);
}
