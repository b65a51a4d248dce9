// SPDX-License-Identifier: Apache-2.0
// Stand in for the functions of stdio that write, which std::cout and std::cerr end in as well.
#include "hook_checker/interposed.hpp"
#include "hook_checker/offence.hpp"

#include <cstdarg>
#include <cstdint>
#include <cstdio>

#include <unistd.h>

#undef putc
#undef putchar

using cortex::cs::note;
using cortex::cs::Offence;
using cortex::cs::Quiet;

namespace {

std::int64_t descriptorOf(const FILE* stream) {
    if (stream == stdout) return STDOUT_FILENO;
    return stream == stderr ? STDERR_FILENO : -1;
}

int print(const char* name, FILE* stream, const char* format, va_list arguments) {
    note(Offence::Output, descriptorOf(stream), name);
    const Quiet quiet;
    return CORTEX_NEXT(vfprintf)(stream, format, arguments);
}

}  // namespace

// NOLINTBEGIN(bugprone-*,cert-dcl50-cpp,readability-identifier-naming)
extern "C" {

#define CORTEX_PRINT(name, stream, Parameters)                      \
    int name Parameters {                                           \
        va_list arguments;                                          \
        va_start(arguments, format);                                \
        const int result = print(#name, stream, format, arguments); \
        va_end(arguments);                                          \
        return result;                                              \
    }

CORTEX_PRINT(printf, stdout, (const char* format, ...))
CORTEX_PRINT(fprintf, stream, (FILE * stream, const char* format, ...))
CORTEX_PRINT(__printf_chk, stdout, (int /*flag*/, const char* format, ...))
CORTEX_PRINT(__fprintf_chk, stream, (FILE * stream, int /*flag*/, const char* format, ...))

int vprintf(const char* format, va_list arguments) {
    return print("vprintf", stdout, format, arguments);
}
int vfprintf(FILE* stream, const char* format, va_list arguments) {
    return print("vfprintf", stream, format, arguments);
}
int __vfprintf_chk(FILE* stream, int /*flag*/, const char* format, va_list arguments) {
    return print("vfprintf", stream, format, arguments);
}
int puts(const char* text) {
    note(Offence::Output, STDOUT_FILENO, "puts");
    const Quiet quiet;
    return CORTEX_NEXT(puts)(text);
}
int putchar(int character) {
    note(Offence::Output, STDOUT_FILENO, "putchar");
    const Quiet quiet;
    return CORTEX_NEXT(putchar)(character);
}
int fputs(const char* text, FILE* stream) {
    note(Offence::Output, descriptorOf(stream), "fputs");
    const Quiet quiet;
    return CORTEX_NEXT(fputs)(text, stream);
}
int fputc(int character, FILE* stream) {
    note(Offence::Output, descriptorOf(stream), "fputc");
    const Quiet quiet;
    return CORTEX_NEXT(fputc)(character, stream);
}
int putc(int character, FILE* stream) {
    note(Offence::Output, descriptorOf(stream), "putc");
    const Quiet quiet;
    return CORTEX_NEXT(putc)(character, stream);
}
std::size_t fwrite(const void* data, std::size_t size, std::size_t count, FILE* stream) {
    note(Offence::Output, descriptorOf(stream), "fwrite");
    const Quiet quiet;
    return CORTEX_NEXT(fwrite)(data, size, count, stream);
}
int fflush(FILE* stream) {
    note(Offence::Output, descriptorOf(stream), "fflush");
    const Quiet quiet;
    return CORTEX_NEXT(fflush)(stream);
}

}  // extern "C"
// NOLINTEND(bugprone-*,cert-dcl50-cpp,readability-identifier-naming)
