// SPDX-License-Identifier: Apache-2.0
// Stand in for functions of the C and C++ libraries, in the whole process.
#include "hook_checker/interposed.hpp"

#include "hook_checker/offence.hpp"

#include <cerrno>
#include <cstddef>
#include <typeinfo>

#include <pthread.h>
#include <semaphore.h>

using cortex::cs::note;
using cortex::cs::Offence;
using cortex::cs::Quiet;
using cortex::cs::setUnwinding;

// NOLINTBEGIN(bugprone-*,cert-dcl50-cpp,readability-identifier-naming)
extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    note(Offence::Allocation, static_cast<std::int64_t>(size), nullptr);
    const Quiet quiet;  // what it asks the system for belongs to it
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    note(Offence::Allocation, static_cast<std::int64_t>(count * size), nullptr);
    const Quiet quiet;
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    note(Offence::Allocation, static_cast<std::int64_t>(size), nullptr);
    const Quiet quiet;
    return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    note(Offence::Allocation, static_cast<std::int64_t>(size), nullptr);
    const Quiet quiet;
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    *memory = memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
    if (memory != nullptr) note(Offence::Release, 0, nullptr);
    const Quiet quiet;
    __libc_free(memory);
}

#define CORTEX_LOCK(name, Argument)         \
    int name(Argument* argument) {          \
        note(Offence::Lock, 0, #name);      \
        const Quiet quiet;                  \
        return CORTEX_NEXT(name)(argument); \
    }
#define CORTEX_WAIT(name, First, Second)         \
    int name(First* first, Second* second) {     \
        note(Offence::Lock, 0, #name);           \
        const Quiet quiet;                       \
        return CORTEX_NEXT(name)(first, second); \
    }

CORTEX_LOCK(pthread_mutex_lock, pthread_mutex_t)
CORTEX_LOCK(pthread_mutex_trylock, pthread_mutex_t)
CORTEX_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
CORTEX_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
CORTEX_LOCK(pthread_cond_signal, pthread_cond_t)
CORTEX_LOCK(pthread_cond_broadcast, pthread_cond_t)
CORTEX_LOCK(sem_wait, sem_t)
CORTEX_LOCK(sem_post, sem_t)
CORTEX_WAIT(pthread_cond_wait, pthread_cond_t, pthread_mutex_t)
CORTEX_WAIT(pthread_mutex_timedlock, pthread_mutex_t, const timespec)

int pthread_spin_lock(pthread_spinlock_t* lock) {
    note(Offence::Lock, 0, "pthread_spin_lock");
    return CORTEX_NEXT(pthread_spin_lock)(lock);
}

// The exception's memory belongs to the throw, and what unwinding needs.
void* __cxa_allocate_exception(std::size_t size) {
    const Quiet quiet;
    return CORTEX_NEXT(__cxa_allocate_exception)(size);
}
[[noreturn]] void __cxa_throw(void* exception, std::type_info* type, void (*destroy)(void*)) {
    note(Offence::Throw, 0, type->name());
    setUnwinding(true);
    CORTEX_NEXT(__cxa_throw)(exception, type, destroy);
    __builtin_unreachable();
}
void* __cxa_begin_catch(void* exception) {
    void* result = CORTEX_NEXT(__cxa_begin_catch)(exception);
    setUnwinding(false);
    return result;
}
void __cxa_end_catch() {
    const Quiet quiet;
    CORTEX_NEXT(__cxa_end_catch)();
}

}  // extern "C"
// NOLINTEND(bugprone-*,cert-dcl50-cpp,readability-identifier-naming)
