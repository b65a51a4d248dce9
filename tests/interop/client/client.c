// SPDX-License-Identifier: Apache-2.0
// Lists simplexes, prints live values and calls commands of CorteX agents. See usage().
#include "network.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t second = 1000000000;

static int usage(void) {
    fprintf(
        stderr,
        "client DOMAIN list                         path, type, role and agent of each simplex\n"
        "client DOMAIN values PREFIX [BLOCKS]       values at and below PREFIX\n"
        "client DOMAIN summary PREFIX               quality and state at and below PREFIX\n"
        "client DOMAIN call PATH COMMAND [NAME=V,V…]…\n"
        "client DOMAIN ask NAME PREFIX              for control, in the name of a person: who is\n"
        "                                           there, until somebody refuses it\n"
        "client DOMAIN past PREFIX                  what the agent of PREFIX has kept\n");
    return 2;
}

// Whether somebody is heard, and everything of everybody who is, is here.
static bool everythingIsHere(const Tool* tool, const Models* models) {
    bool any = false;
    for (int i = 0; i < tool->agentCount; ++i) {
        const Agent* agent = &tool->agents[i];
        if (now() - agent->heard > second) continue;
        if (!complete(agent, models)) return false;
        any = true;
    }
    return any;
}

static Models waitForModels(Tool* tool) {
    const int64_t end = now() + 20 * second;
    for (;;) {
        step(tool);
        Models models = modelsOf(tool);
        if (everythingIsHere(tool, &models)) return models;
        letGo(tool, &models);
        if (now() < end) continue;
        fprintf(stderr, "nobody is heard, or not everything of them\n");
        exit(3);
    }
}

static int list(const Tool* tool, const Models* models) {
    for (int i = 0; i < tool->agentCount; ++i) {
        uint32_t count = 0;
        const cortex_SimplexModel** simplexes = simplexesOf(models, &tool->agents[i], &count);
        for (uint32_t k = 0; k < count; ++k) {
            printf("%s %s %s %s\n", simplexes[k]->path, simplexes[k]->type, simplexes[k]->role,
                   tool->agents[i].name);
        }
        free(simplexes);
    }
    return 0;
}

static Agent* ownerOf(Tool* tool, const Models* models, const char* prefix) {
    for (int i = 0; i < tool->agentCount; ++i) {
        uint32_t count = 0;
        const cortex_SimplexModel** simplexes = simplexesOf(models, &tool->agents[i], &count);
        bool found = false;
        for (uint32_t k = 0; k < count; ++k) found = found || isBelow(simplexes[k]->path, prefix);
        free(simplexes);
        if (found) return &tool->agents[i];
    }
    fprintf(stderr, "nobody has anything at or below %s\n", prefix);
    exit(3);
}

// --- values --------------------------------------------------------------------------------------

static bool isOf(const cortex_Block* block, const Agent* agent) {
    return memcmp(block->agent, idOf(agent->name, NULL, NULL).octets, 16) == 0 &&
           block->epoch == agent->epoch &&
           memcmp(block->structureHash, agent->structureHash, 16) == 0;
}

// Prints what is at and below the prefix; false: nothing of it is in this block.
static bool print(const cortex_Block* block, const Models* models, const Agent* agent,
                  const char* prefix) {
    bool any = false;
    for (uint32_t i = 0; i < block->simplexes._length; ++i) {
        const cortex_SimplexData* data = &block->simplexes._buffer[i];
        const cortex_SimplexModel* simplex = simplexOf(models, agent, data->index);
        if (simplex == NULL || !isBelow(simplex->path, prefix)) continue;
        if (!any) printf("cycle %" PRId64 "\n", block->cycle);
        any = true;
        if (printValues(typeOf(models, agent, simplex->type), simplex, data)) continue;
        fprintf(stderr, "the values of %s are not those of its type\n", simplex->path);
        exit(1);
    }
    return any;
}

static int values(Tool* tool, const Models* models, const char* prefix, int blocks) {
    const Agent* agent = ownerOf(tool, models, prefix);
    view(tool, prefix);
    for (const int64_t end = now() + 20 * second; blocks > 0 && now() < end;) {
        step(tool);
        void* samples[16] = {NULL};
        dds_sample_info_t infos[16];
        const int count = dds_take(tool->blocks, samples, infos, 16, 16);
        for (int i = 0; i < count && blocks > 0; ++i) {
            if (!infos[i].valid_data || !isOf(samples[i], agent)) continue;
            if (print(samples[i], models, agent, prefix)) --blocks;
        }
        if (count > 0) dds_return_loan(tool->blocks, samples, count);
    }
    return blocks == 0 ? 0 : 3;
}

// --- summary -------------------------------------------------------------------------------------

static bool isSummaryOf(const cortex_Summary* summary, const Agent* agent) {
    return memcmp(summary->agent, idOf(agent->name, NULL, NULL).octets, 16) == 0 &&
           summary->epoch == agent->epoch &&
           memcmp(summary->structureHash, agent->structureHash, 16) == 0 &&
           summary->marks._length == agent->simplexes;
}

static int printMarks(const cortex_Summary* summary, const Models* models, const Agent* agent,
                      const char* prefix) {
    static const char* const qualities[] = {"good", "stale", "bad", "lost"};
    static const char* const states[] = {"-",      "Standby",      "StartingUp",
                                         "Active", "ShuttingDown", "Fault"};
    for (uint32_t i = 0; i < summary->marks._length; ++i) {
        const cortex_SimplexModel* simplex = simplexOf(models, agent, i);
        const uint8_t mark = summary->marks._buffer[i];
        const unsigned state = mark >> 2 & 7;
        if (simplex == NULL || state > 5) return 1;
        if (!isBelow(simplex->path, prefix)) continue;
        printf("%s %s %s%s\n", simplex->path, qualities[mark & 3], states[state],
               (mark & 0x20) != 0 ? " outside" : "");
    }
    return 0;
}

static int summary(Tool* tool, const Models* models, const char* prefix) {
    const Agent* agent = ownerOf(tool, models, prefix);
    viewSummary(tool);
    int result = 3;
    for (const int64_t end = now() + 20 * second; result == 3 && now() < end;) {
        step(tool);
        void* samples[16] = {NULL};
        dds_sample_info_t infos[16];
        const int count = dds_take(tool->summaries, samples, infos, 16, 16);
        for (int i = 0; i < count && result == 3; ++i) {
            if (!infos[i].valid_data || !isSummaryOf(samples[i], agent)) continue;
            result = printMarks(samples[i], models, agent, prefix);
        }
        if (count > 0) dds_return_loan(tool->summaries, samples, count);
    }
    return result;
}

// --- commands ------------------------------------------------------------------------------------

static const char* kindAmong(const cortex_Parameter* parameters, uint32_t count, const char* name) {
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(parameters[i].name, name) != 0) continue;
        for (uint32_t k = 0; k < parameters[i].attributes._length; ++k) {
            const cortex_Attribute* attribute = &parameters[i].attributes._buffer[k];
            if (strcmp(attribute->name, "kind") == 0) return attribute->value;
        }
    }
    return NULL;
}

// Of a parameter: as the command says, and for `set`, which every type has, as the item says.
static const char* kindOf(const cortex_TypeModel* type, const char* command, const char* name) {
    for (uint32_t i = 0; i < type->commands._length; ++i) {
        const cortex_CommandType* each = &type->commands._buffer[i];
        if (strcmp(each->name, command) != 0) continue;
        return kindAmong(each->request._buffer, each->request._length, name);
    }
    if (strcmp(command, "set") != 0) return NULL;
    for (uint32_t i = 0; i < type->data._length; ++i) {
        if (strcmp(type->data._buffer[i].name, name) == 0) return type->data._buffer[i].kind;
    }
    return NULL;
}

static cortex_NamedValue argument(const cortex_TypeModel* type, const char* command, char* text) {
    char* equals = strchr(text, '=');
    if (equals == NULL) exit(usage());
    *equals = '\0';
    const char* kind = kindOf(type, command, text);
    cortex_NamedValue value = {.name = text, .kind = (char*)(kind != NULL ? kind : "float")};
    const size_t most = strlen(equals + 1) + 1;  // no more elements than characters
    value.ints._buffer = calloc(most, sizeof(int64_t));
    value.floats._buffer = calloc(most, sizeof(double));
    value.bools._buffer = calloc(most, sizeof(bool));
    value.strings._buffer = calloc(most, sizeof(char*));
    for (char* each = strtok(equals + 1, ","); each != NULL; each = strtok(NULL, ",")) {
        if (strcmp(value.kind, "int") == 0) {
            value.ints._buffer[value.ints._length++] = strtoll(each, NULL, 10);
        } else if (strcmp(value.kind, "bool") == 0) {
            value.bools._buffer[value.bools._length++] = strcmp(each, "true") == 0;
        } else if (strcmp(value.kind, "string") == 0) {
            value.strings._buffer[value.strings._length++] = each;
        } else {
            value.floats._buffer[value.floats._length++] = strtod(each, NULL);
        }
    }
    return value;
}

static cortex_Command commandTo(Tool* tool, const Agent* agent, char* path, char* name) {
    cortex_Command command = {.sender = tool->name,
                              .host = "",
                              .senderEpoch = tool->epoch,
                              .target = (char*)agent->name,
                              .targetEpoch = agent->epoch,
                              .sequenceNumber = 1,
                              .answeredBelow = 1,
                              .path = path,
                              .commandName = name};
    memcpy(command.link, idOf(tool->name, agent->name, NULL).octets, 16);
    const int64_t period = agent->period > 0 ? agent->period : 1;
    command.notAfter = agent->cycle + 10 * second / period + 1;  // 10 s of its time
    return command;
}

// The end of the command, printed: 0 Done, 1 anything else, -1 not yet. `running`: it said so.
static int answer(const Tool* tool, const cortex_Command* command, bool* running) {
    void* samples[16] = {NULL};
    dds_sample_info_t infos[16];
    int result = -1;
    const int count = dds_take(tool->answers, samples, infos, 16, 16);
    for (int i = 0; i < count; ++i) {
        const cortex_Answer* each = samples[i];
        if (!infos[i].valid_data || memcmp(each->link, command->link, 16) != 0 ||
            each->senderEpoch != tool->epoch || each->epoch != command->targetEpoch ||
            each->sequenceNumber != command->sequenceNumber || result >= 0) {
            continue;
        }
        *running = strcmp(each->outcome, "Running") == 0;
        if (*running) continue;
        printf("%s %s %s\n", each->outcome, each->reason, each->why);
        for (uint32_t k = 0; k < each->response._length; ++k) {
            printNamed(command->path, &each->response._buffer[k]);
        }
        result = strcmp(each->outcome, "Done") == 0 ? 0 : 1;
    }
    if (count > 0) dds_return_loan(tool->answers, samples, count);
    return result;
}

static int call(Tool* tool, const Models* models, int count, char** words) {
    const Agent* agent = ownerOf(tool, models, words[0]);
    const cortex_SimplexModel* simplex = simplexAt(models, agent, words[0]);
    if (simplex == NULL) return 3;
    cortex_Command command = commandTo(tool, agent, words[0], words[1]);
    cortex_NamedValue arguments[32];
    command.arguments._buffer = arguments;
    for (int i = 2; i < count && i < 34; ++i) {
        arguments[command.arguments._length++] =
            argument(typeOf(models, agent, simplex->type), words[1], words[i]);
    }
    int64_t due = 0;  // said again until its end is known: it is executed once all the same
    for (int64_t end = now() + 11 * second; now() < end;) {
        if (now() >= due) {
            dds_write(tool->commands, &command);
            due = now() + second / 5;
        }
        step(tool);
        bool running = false;
        const int result = answer(tool, &command, &running);
        if (result >= 0) return result;
        if (running) end = now() + 11 * second;
    }
    printf("Unknown\n");
    return 1;
}

// --- people --------------------------------------------------------------------------------------

static int ask(Tool* tool, const char* person, const char* prefix) {
    tool->person = person;
    tool->asks = prefix;
    int told = 0;
    for (const int64_t end = now() + 40 * second; now() < end;) {
        step(tool);
        for (; told < tool->peopleCount; ++told) {
            printf("%s is used by %s\n", tool->people[told].tool, tool->people[told].person);
        }
        for (int i = 0; i < told; ++i) {
            if (!tool->people[i].refused) continue;
            printf("%s refuses\n", tool->people[i].tool);
            return 1;
        }
    }
    return 3;
}

// --- the past ------------------------------------------------------------------------------------

// Prints a part of it; false: it is none that was asked for.
static bool takePast(const cortex_Past* past, const Tool* tool, const Agent* agent,
                     uint64_t after) {
    if (strcmp(past->tool, tool->name) != 0 || strcmp(past->name, agent->name) != 0 ||
        past->epoch != agent->epoch || past->ask != 1 || past->after != after) {
        return false;
    }
    for (uint32_t i = 0; i < past->events._length; ++i) {
        const cortex_PastEvent* each = &past->events._buffer[i];
        printf("%s %s %s %s\n", each->kind, each->severity, each->path, each->text);
    }
    if (past->more) return true;
    for (uint32_t i = 0; i < past->kept._length; ++i) {
        printf("kept %s %" PRId64 "\n", past->kept._buffer[i].kind, past->kept._buffer[i].since);
    }
    return true;
}

static int past(Tool* tool, const Agent* agent) {
    uint64_t after = 0;
    bool more = true;
    for (const int64_t end = now() + 20 * second; more && now() < end;) {
        char ask[160];
        snprintf(ask, sizeof ask, "1 0 %" PRId64 " %" PRIu64 " %s", INT64_MAX, after, agent->name);
        tool->past = ask;
        step(tool);
        tool->past = NULL;
        void* samples[16] = {NULL};
        dds_sample_info_t infos[16];
        const int count = dds_take(tool->pasts, samples, infos, 16, 16);
        for (int i = 0; i < count && more; ++i) {
            const cortex_Past* part = samples[i];
            if (!infos[i].valid_data || !takePast(part, tool, agent, after)) continue;
            after = part->last;
            more = part->more;
            tool->presenceDue = 0;
        }
        if (count > 0) dds_return_loan(tool->pasts, samples, count);
    }
    return more ? 3 : 0;
}

int main(int count, char** words) {
    if (count < 3) return usage();
    const char* verb = words[2];
    Tool tool;
    join(&tool, (dds_domainid_t)atoi(words[1]));
    Models models = waitForModels(&tool);
    int result = 2;
    if (strcmp(verb, "list") == 0 && count == 3) {
        result = list(&tool, &models);
    } else if (strcmp(verb, "values") == 0 && (count == 4 || count == 5)) {
        result = values(&tool, &models, words[3], count == 5 ? atoi(words[4]) : 1);
    } else if (strcmp(verb, "summary") == 0 && count == 4) {
        result = summary(&tool, &models, words[3]);
    } else if (strcmp(verb, "call") == 0 && count >= 5) {
        result = call(&tool, &models, count - 3, words + 3);
    } else if (strcmp(verb, "ask") == 0 && count == 5) {
        result = ask(&tool, words[3], words[4]);
    } else if (strcmp(verb, "past") == 0 && count == 4) {
        result = past(&tool, ownerOf(&tool, &models, words[3]));
    } else {
        usage();
    }
    letGo(&tool, &models);
    leave(&tool);
    return result;
}
