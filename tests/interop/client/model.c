// SPDX-License-Identifier: Apache-2.0
#include "model.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool isOf(const cortex_Model* model, const Agent* agent) {
    return model->agent != NULL && strcmp(model->agent, agent->name) == 0 &&
           model->epoch == agent->epoch;
}

const cortex_TypeModel* typeOf(const Models* models, const Agent* agent, const char* name) {
    for (int i = 0; i < models->count; ++i) {
        const cortex_Model* model = models->samples[i];
        for (uint32_t k = 0; isOf(model, agent) && k < model->types._length; ++k) {
            if (strcmp(model->types._buffer[k].name, name) == 0) return &model->types._buffer[k];
        }
    }
    return NULL;
}

const cortex_SimplexModel* simplexAt(const Models* models, const Agent* agent, const char* path) {
    for (int i = 0; i < models->count; ++i) {
        const cortex_Model* model = models->samples[i];
        for (uint32_t k = 0; isOf(model, agent) && k < model->simplexes._length; ++k) {
            const cortex_SimplexModel* each = &model->simplexes._buffer[k];
            if (strcmp(each->path, path) == 0) return each;
        }
    }
    return NULL;
}

const cortex_SimplexModel* simplexOf(const Models* models, const Agent* agent, uint32_t index) {
    for (int i = 0; i < models->count; ++i) {
        const cortex_Model* model = models->samples[i];
        for (uint32_t k = 0; isOf(model, agent) && k < model->simplexes._length; ++k) {
            if (model->simplexes._buffer[k].index == index) return &model->simplexes._buffer[k];
        }
    }
    return NULL;
}

static int byPath(const void* a, const void* b) {
    const cortex_SimplexModel *const *left = a, *const *right = b;
    return strcmp((*left)->path, (*right)->path);
}

static int byName(const void* a, const void* b) {
    const cortex_TypeModel *const *left = a, *const *right = b;
    return strcmp((*left)->name, (*right)->name);
}

const cortex_SimplexModel** simplexesOf(const Models* models, const Agent* agent, uint32_t* count) {
    size_t most = 1;
    for (int i = 0; i < models->count; ++i) {
        most += ((const cortex_Model*)models->samples[i])->simplexes._length;
    }
    const cortex_SimplexModel** list = calloc(most, sizeof *list);
    *count = 0;
    for (int i = 0; i < models->count; ++i) {
        const cortex_Model* model = models->samples[i];
        for (uint32_t k = 0; isOf(model, agent) && k < model->simplexes._length; ++k) {
            list[(*count)++] = &model->simplexes._buffer[k];
        }
    }
    qsort(list, *count, sizeof *list, byPath);
    return list;
}

bool isBelow(const char* path, const char* prefix) {
    size_t length = strlen(prefix);
    while (length > 0 && prefix[length - 1] == '/') --length;
    return strncmp(path, prefix, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

// --- the hashes of a presence --------------------------------------------------------------------

static bool typesAgree(const Agent* agent, const Models* models) {
    size_t most = 1;
    for (int i = 0; i < models->count; ++i) {
        most += ((const cortex_Model*)models->samples[i])->types._length;
    }
    const cortex_TypeModel** list = calloc(most, sizeof *list);
    uint32_t count = 0;
    for (int i = 0; i < models->count; ++i) {
        const cortex_Model* model = models->samples[i];
        for (uint32_t k = 0; isOf(model, agent) && k < model->types._length; ++k) {
            list[count++] = &model->types._buffer[k];
        }
    }
    qsort(list, count, sizeof *list, byName);
    Text text = {0};
    for (uint32_t i = 0; i < count; ++i) {
        append(&text, "%s %s\n", list[i]->name, hex(list[i]->hash));
    }
    const Id hash = hashOf(&text);
    clear(&text);
    free(list);
    return count == agent->types && memcmp(hash.octets, agent->typesHash, 16) == 0;
}

static void appendConstant(Text* text, const cortex_NamedValue* value) {
    append(text, "constant %s %s", value->name, value->kind);
    for (uint32_t i = 0; i < value->ints._length; ++i) {
        append(text, " %" PRId64, value->ints._buffer[i]);
    }
    for (uint32_t i = 0; i < value->floats._length; ++i) {
        append(text, " ");
        appendNumber(text, value->floats._buffer[i]);
    }
    for (uint32_t i = 0; i < value->bools._length; ++i) {
        append(text, " %s", value->bools._buffer[i] ? "true" : "false");
    }
    for (uint32_t i = 0; i < value->strings._length; ++i) {
        const char* each = value->strings._buffer[i];
        append(text, " %zu:", strlen(each));
        appendOctets(text, each, strlen(each));
    }
    append(text, "\n");
}

static void appendSimplex(Text* text, const cortex_SimplexModel* simplex) {
    append(text, "simplex %s %" PRIu32 " %s %s %s %" PRIu32 " %" PRId32 "\n", simplex->path,
           simplex->index, simplex->type, hex(simplex->typeHash), simplex->role, simplex->every,
           simplex->phase);
    for (uint32_t i = 0; i < simplex->relationships._length; ++i) {
        const cortex_Relationship* each = &simplex->relationships._buffer[i];
        append(text, "relate %s %s%s%s\n", each->rule, each->target,
               each->delayed ? " delayed" : "", each->remote ? " remote" : "");
    }
    for (uint32_t i = 0; i < simplex->constants._length; ++i) {
        appendConstant(text, &simplex->constants._buffer[i]);
    }
}

static bool simplexesAgree(const Agent* agent, const Models* models) {
    uint32_t count = 0;
    const cortex_SimplexModel** list = simplexesOf(models, agent, &count);
    Text text = {0};
    for (uint32_t i = 0; i < count; ++i) appendSimplex(&text, list[i]);
    const Id hash = hashOf(&text);
    clear(&text);
    free(list);
    return count == agent->simplexes && memcmp(hash.octets, agent->structureHash, 16) == 0;
}

bool complete(const Agent* agent, const Models* models) {
    return typesAgree(agent, models) && simplexesAgree(agent, models);
}

// --- values --------------------------------------------------------------------------------------

static const char* qualityName(uint8_t quality) {
    static const char* names[] = {"good", "stale", "bad", "lost"};
    return quality < 4 ? names[quality] : "unknown";
}

typedef struct {
    uint32_t ints, floats, bools, strings;
} Place;

// Prints one element and goes on to the next; false: there is none.
static bool printElement(const char* kind, const cortex_SimplexData* data, Place* place) {
    if (strcmp(kind, "int") == 0) {
        if (place->ints >= data->ints._length) return false;
        return printf(" %" PRId64, data->ints._buffer[place->ints++]) > 0;
    }
    if (strcmp(kind, "float") == 0) {
        if (place->floats >= data->floats._length) return false;
        return printf(" %.17g", data->floats._buffer[place->floats++]) > 0;
    }
    if (strcmp(kind, "bool") == 0) {
        if (place->bools >= data->bools._length) return false;
        return printf(" %s", data->bools._buffer[place->bools++] ? "true" : "false") > 0;
    }
    if (place->strings >= data->strings._length) return false;
    return printf(" \"%s\"", data->strings._buffer[place->strings++]) > 0;
}

bool printValues(const cortex_TypeModel* type, const cortex_SimplexModel* simplex,
                 const cortex_SimplexData* data) {
    Place place = {0};
    for (uint32_t i = 0; i < type->data._length; ++i) {
        const cortex_DataItem* item = &type->data._buffer[i];
        if (item->constant) continue;
        printf("%s.%s =", simplex->path, item->name);
        for (uint32_t k = 0; k < item->length; ++k) {
            if (!printElement(item->kind, data, &place)) return false;
        }
        printf(" [%s] %s\n", item->unit, qualityName(data->quality));
    }
    for (uint32_t i = 0; i < simplex->constants._length; ++i) {
        printNamed(simplex->path, &simplex->constants._buffer[i]);
    }
    return place.ints == data->ints._length && place.floats == data->floats._length &&
           place.bools == data->bools._length && place.strings == data->strings._length;
}

void printNamed(const char* before, const cortex_NamedValue* value) {
    const cortex_SimplexData data = {.ints = value->ints,
                                     .floats = value->floats,
                                     .bools = value->bools,
                                     .strings = value->strings};
    Place place = {0};
    printf("%s.%s =", before, value->name);
    while (printElement(value->kind, &data, &place)) {
    }
    printf("\n");
}
