// SPDX-License-Identifier: Apache-2.0
#include "hash.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void appendOctets(Text* text, const void* octets, size_t size) {
    if (text->size + size + 1 > text->room) {
        text->room = 2 * (text->size + size) + 64;
        text->text = realloc(text->text, text->room);
        if (text->text == NULL) abort();
    }
    memcpy(text->text + text->size, octets, size);
    text->size += size;
    text->text[text->size] = '\0';
}

void append(Text* text, const char* format, ...) {
    char buffer[8192];
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    if (size < 0 || (size_t)size >= sizeof buffer) abort();
    appendOctets(text, buffer, (size_t)size);
}

void clear(Text* text) {
    free(text->text);
    memset(text, 0, sizeof *text);
}

// --- FIPS 180-4 ----------------------------------------------------------------------------------

static const uint32_t roundConstants[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t turned(uint32_t word, int bits) { return word >> bits | word << (32 - bits); }

static void addChunk(uint32_t state[8], const uint8_t chunk[64]) {
    uint32_t w[64], s[8];
    for (int i = 0; i < 16; ++i) {
        const uint8_t* at = chunk + 4 * i;
        w[i] = (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
    }
    for (int i = 16; i < 64; ++i) {
        const uint32_t a = turned(w[i - 15], 7) ^ turned(w[i - 15], 18) ^ w[i - 15] >> 3;
        const uint32_t b = turned(w[i - 2], 17) ^ turned(w[i - 2], 19) ^ w[i - 2] >> 10;
        w[i] = w[i - 16] + a + w[i - 7] + b;
    }
    memcpy(s, state, sizeof s);
    for (int i = 0; i < 64; ++i) {
        const uint32_t e = turned(s[4], 6) ^ turned(s[4], 11) ^ turned(s[4], 25);
        const uint32_t chosen = (s[4] & s[5]) ^ (~s[4] & s[6]);
        const uint32_t first = s[7] + e + chosen + roundConstants[i] + w[i];
        const uint32_t a = turned(s[0], 2) ^ turned(s[0], 13) ^ turned(s[0], 22);
        const uint32_t second = a + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
        memmove(s + 1, s, 7 * sizeof *s);
        s[4] += first;
        s[0] = first + second;
    }
    for (int i = 0; i < 8; ++i) state[i] += s[i];
}

Id hashOf(const Text* text) {
    uint32_t state[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    uint8_t last[128] = {0};
    const size_t whole = text->size / 64 * 64, rest = text->size - whole;
    const size_t end = rest < 56 ? 64 : 128;
    for (size_t i = 0; i < whole; i += 64) addChunk(state, (const uint8_t*)text->text + i);
    if (rest > 0) memcpy(last, text->text + whole, rest);
    last[rest] = 0x80;
    for (size_t i = 0; i < 8; ++i) last[end - 1 - i] = (uint8_t)((uint64_t)text->size * 8 >> 8 * i);
    for (size_t i = 0; i < end; i += 64) addChunk(state, last + i);
    Id id;
    for (int i = 0; i < 16; ++i) id.octets[i] = (uint8_t)(state[i / 4] >> (24 - 8 * (i % 4)));
    return id;
}

// --- ids and numbers -----------------------------------------------------------------------------

Id idOf(const char* first, const char* second, const char* third) {
    Text text = {0};
    append(&text, "%s", first);
    if (second != NULL) append(&text, "\n%s", second);
    if (third != NULL) append(&text, "\n%s", third);
    const Id id = hashOf(&text);
    clear(&text);
    return id;
}

const char* hex(const uint8_t id[16]) {
    static char digits[33];
    for (int i = 0; i < 16; ++i) snprintf(digits + 2 * i, 3, "%02x", id[i]);
    return digits;
}

// `digits` without a point, which stands after the first of them, times ten to the `exponent`.
static void appendPlain(Text* text, const char* digits, int exponent, double number) {
    const int count = (int)strlen(digits);
    if (exponent >= count - 1) {
        append(text, "%.0f", number);
    } else if (exponent >= 0) {
        append(text, "%.*s.%s", exponent + 1, digits, digits + exponent + 1);
    } else {
        append(text, "0.");
        for (int i = -1; i > exponent; --i) append(text, "0");
        append(text, "%s", digits);
    }
}

void appendNumber(Text* text, double number) {
    char scientific[40], digits[40];
    int precision = 0;
    do {
        snprintf(scientific, sizeof scientific, "%.*e", precision, number);
    } while (strtod(scientific, NULL) != number && ++precision < 17);
    const char* from = scientific;
    if (*from == '-') {
        append(text, "-");
        number = -number;
        ++from;
    }
    size_t count = 0;
    for (; *from != 'e'; ++from) {
        if (*from != '.') digits[count++] = *from;
    }
    digits[count] = '\0';
    Text plain = {0};
    appendPlain(&plain, digits, atoi(from + 1), number);
    const char* unsign = scientific + (scientific[0] == '-');
    append(text, "%s", plain.size <= strlen(unsign) ? plain.text : unsign);
    clear(&plain);
}
