// SPDX-License-Identifier: Apache-2.0
// A tool on a network of CorteX agents, with nothing but Cyclone DDS and docs/protocol.md.
#pragma once

#include "model.h"

#include <dds/dds.h>

enum { mostAgents = 64, mostPeople = 16 };

// Another tool that says who uses it.
typedef struct {
    char tool[64], person[64], asks[144];
    bool refused;  // what this tool asks for
} Person;

typedef struct {
    char name[64];
    int64_t epoch;
    dds_entity_t participant, presences, presenceReader, interests, modelReader, blocks, summaries,
        commands, answers, pasts;
    int64_t presenceDue;  // ns
    Agent agents[mostAgents];
    int agentCount;
    Person people[mostPeople];
    int peopleCount;
    // Who uses this tool, what it asks for, and what of the past; NULL: not said.
    const char *person, *asks, *past;
} Tool;

int64_t now(void);  // ns, of this process alone

// On the loopback interface. Ends the program, with words, if there is no network.
void join(Tool* tool, dds_domainid_t domain);
void leave(Tool* tool);
// A hundredth of a second: says that the tool is there, listens who else is.
void step(Tool* tool);

// All that agents have told; to be let go again.
Models modelsOf(const Tool* tool);
void letGo(const Tool* tool, Models* models);

// Says what the tool wants from now on: values at and below a path, 30 times a second.
void view(Tool* tool, const char* prefix);
// Or how all simplexes of all agents are, five times a second.
void viewSummary(Tool* tool);
