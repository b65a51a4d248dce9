// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/data.hpp"

#include "cortex/core/error.hpp"

#include <atomic>
#include <cstring>
#include <limits>
#include <string>

namespace cortex {

namespace {

std::atomic<std::uint64_t> changes{0};

const char* handleOf(Kind kind) {
    switch (kind) {
        case Kind::Int:
            return "Data<std::int64_t>";
        case Kind::Float:
            return "Data<double>";
        case Kind::Bool:
            return "Data<bool>";
        case Kind::String:
            break;
    }
    return "Data<std::string_view>";
}

}  // namespace

UnboundHandle::UnboundHandle(const char* handle)
    : Error{std::string{"handle "} + handle + " is not bound (forgotten in populate()?)"},
      handle_{handle} {}

void throwUnbound(Kind kind) { throw UnboundHandle{handleOf(kind)}; }

std::uint64_t textChanges() { return changes.load(std::memory_order_relaxed); }

void countTextChange() { changes.fetch_add(1, std::memory_order_relaxed); }

std::size_t fittingLength(std::string_view text, std::size_t capacity) {
    if (text.size() <= capacity) return text.size();
    constexpr unsigned continuationMask = 0xc0U, continuation = 0x80U;
    std::size_t length = capacity;
    while (length > 0 &&
           (static_cast<unsigned char>(text[length]) & continuationMask) == continuation) {
        --length;
    }
    return length;
}

void StringCell::assign(std::string_view value) {
    const std::size_t fitting = fittingLength(value, capacity);
    if (fitting == value.size() && value == view()) return;
    if (fitting < value.size() && cuts < std::numeric_limits<std::uint32_t>::max()) ++cuts;
    if (fitting > 0) std::memmove(text(), value.data(), fitting);
    length = static_cast<std::uint16_t>(fitting);
    countTextChange();
}

}  // namespace cortex
