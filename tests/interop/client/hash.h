// SPDX-License-Identifier: Apache-2.0
// SHA-256 and the ids made of it, as docs/protocol.md has them.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint8_t octets[16];
} Id;

// A text that grows.
typedef struct {
    char* text;
    size_t size, room;
} Text;

void append(Text* text, const char* format, ...) __attribute__((format(printf, 2, 3)));
void appendOctets(Text* text, const void* octets, size_t size);
void clear(Text* text);

// The first 16 octets of the SHA-256 of the text.
Id hashOf(const Text* text);
// That of up to three words joined by a line feed; NULL: no more words.
Id idOf(const char* first, const char* second, const char* third);
// The 32 hexadecimal digits of an id; the result is good until the next call.
const char* hex(const uint8_t id[16]);
// The shortest text that reads back as this number; of plain and scientific the shorter.
void appendNumber(Text* text, double number);
