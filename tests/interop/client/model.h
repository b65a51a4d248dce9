// SPDX-License-Identifier: Apache-2.0
// What agents publish of themselves: who is there, what they consist of, and where a value lies.
#pragma once

#include "cortex.h"
#include "hash.h"

#include <stdbool.h>

// Everything that was published so far; Cyclone keeps the newest sample of each key.
typedef struct {
    void** samples;
    int count;
} Models;

typedef struct {
    char name[128];
    int64_t epoch, cycle, period;
    uint32_t types, simplexes;
    uint8_t typesHash[16], structureHash[16];
    int64_t heard;  // ns
} Agent;

// Whether everything that the agent says to have is here, by its numbers and its hashes.
bool complete(const Agent* agent, const Models* models);

const cortex_TypeModel* typeOf(const Models* models, const Agent* agent, const char* name);
const cortex_SimplexModel* simplexAt(const Models* models, const Agent* agent, const char* path);
const cortex_SimplexModel* simplexOf(const Models* models, const Agent* agent, uint32_t index);
// The simplexes of an agent by path; the caller frees the list.
const cortex_SimplexModel** simplexesOf(const Models* models, const Agent* agent, uint32_t* count);
bool isBelow(const char* path, const char* prefix);

// Prints every item of a simplex, a line each; false: the values do not fit the type.
bool printValues(const cortex_TypeModel* type, const cortex_SimplexModel* simplex,
                 const cortex_SimplexData* data);
void printNamed(const char* before, const cortex_NamedValue* value);
