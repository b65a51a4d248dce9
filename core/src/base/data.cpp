// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/data.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/text_faults.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

namespace cortex {

namespace {

std::atomic<std::uint64_t> changes{0}, faults{0};

constexpr std::array cellTypes{"std::int64_t", "double", "bool", "std::string_view"};

}  // namespace

UnboundHandle::UnboundHandle(const std::string& handle, const void* at)
    : Error{"handle " + handle + " is not bound (forgotten in populate()?)"},
      handle_{std::make_shared<const std::string>(handle)},
      at_{at} {}

void throwUnbound(const HandleWords& handle, const void* at) {
    const char* cellType = cellTypes[static_cast<std::size_t>(handle.kind)];
    throw UnboundHandle{
        std::string{handle.form} + '<' + (handle.reads ? "const " : "") + cellType + '>', at};
}

std::uint64_t textChanges() { return changes.load(std::memory_order_relaxed); }

void countTextChange() { changes.fetch_add(1, std::memory_order_relaxed); }

std::uint64_t textFaults() { return faults.load(std::memory_order_relaxed); }

const char* textFault(std::string_view text) {
    const auto isPlain = [](char c) { return static_cast<signed char>(c) > 0; };
    if (std::ranges::all_of(text, isPlain)) return nullptr;
    if (text.find('\0') != std::string_view::npos) return "has the octet 0";
    return isUtf8(text) ? nullptr : "is not UTF-8";
}

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
    if (textFault(view()) != nullptr) faults.fetch_add(1, std::memory_order_relaxed);
    countTextChange();
}

}  // namespace cortex
