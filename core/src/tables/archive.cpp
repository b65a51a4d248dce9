// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/archive.hpp"

#include <algorithm>
#include <cstring>

namespace cortex {

EventText& Archive::begin() {
    problem_.emplace(class_.empty() ? std::string_view{"what is kept"} : class_);
    if (place_ > 0) *problem_ << ", value " << place_;
    return *problem_ << ": ";
}

void Archive::describe(EventText& text, const Head& head) {
    constexpr const char* names[] = {"nothing",  "a class", "bool",  "int",
                                     "unsigned", "float",   "bytes", "structs"};
    text << head.length << " "
         << (static_cast<std::size_t>(head.field) < std::size(names)
                 ? names[static_cast<std::size_t>(head.field)]
                 : "of something unknown");
    if (head.width > 1) text << " of " << head.width << " bytes";
}

bool Archive::handBytes(void* bytes, std::size_t size, bool restores) {
    if (problem_) return false;
    const std::size_t from = size_;
    size_ += size;
    if (purpose_ == Purpose::Measure) return true;
    if (size_ > (purpose_ == Purpose::Save ? room_.size() : saved_.size())) {
        begin() << (reads() ? "nothing more was saved" : "there is no room for it");
        return false;
    }
    if (size == 0) return true;
    if (purpose_ == Purpose::Save)
        std::memcpy(room_.data() + from, bytes, size);
    else if (restores)
        std::memcpy(bytes, saved_.data() + from, size);
    return true;
}

bool Archive::handHead(const Head& head) {
    ++place_;
    Head found = head;
    if (!handBytes(&found, sizeof found, true)) return false;
    if (found == head) return true;
    EventText& text = begin();
    text << "it keeps ";
    describe(text, head);
    text << ", saved was ";
    describe(text, found);
    return false;
}

void Archive::hand(const Head& head, void* values) {
    if (problem_ || !handHead(head)) return;
    const std::size_t from = size_;
    const std::size_t size = std::size_t{head.length} * head.width;
    if (!handBytes(values, size, purpose_ == Purpose::Restore)) return;
    if (purpose_ != Purpose::Check || head.field != Field::Bool) return;
    const auto isBool = [](std::byte byte) { return byte <= std::byte{1}; };
    if (!std::ranges::all_of(saved_.subspan(from, size), isBool)) begin() << "no bool was saved";
}

std::uint16_t Archive::version(std::string_view className, std::uint16_t number) {
    if (problem_) return number;
    class_ = className;
    place_ = 0;
    const Head head{Field::Class, 1, number, static_cast<std::uint32_t>(className.size())};
    Head found = head;
    const std::size_t from = size_ + sizeof found;
    if (!handBytes(&found, sizeof found, true)) return number;
    Head named = found;
    named.version = number;
    if (named != head) {
        begin() << "saved was another class";
        return number;
    }
    // The name is only read: a view of it serves all purposes.
    if (!handBytes(const_cast<char*>(className.data()), className.size(), false)) return number;
    if (reads() && std::memcmp(saved_.data() + from, className.data(), className.size()) != 0) {
        begin() << "saved was another class";
    } else if (found.version > number) {
        begin() << "version " << found.version << " was saved, this one knows up to " << number;
    }
    return found.version;
}

Archive& Archive::time(std::int64_t& value) {
    std::int64_t ago = now_ - value;
    numbers(&ago, 1);
    if (purpose_ == Purpose::Restore && !problem_) value = now_ - ago;
    return *this;
}

void Archive::finish() {
    if (problem_ || !reads() || size_ == saved_.size()) return;
    begin() << "more was saved than it keeps";
}

}  // namespace cortex
