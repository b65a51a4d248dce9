// SPDX-License-Identifier: Apache-2.0
#include "memory_text.hpp"

#include "cortex/core/printable.hpp"
#include "cortex/core/xml_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <limits>
#include <optional>
#include <vector>

#include <unistd.h>

namespace cortex::toolkit {
namespace {

constexpr std::string_view mark = "cortex-agent memory\t", markOfThis = "cortex-agent memory\t1\t";
constexpr std::string_view sinceMark = "since";
constexpr std::string_view endMark = "ended";
constexpr std::size_t longestName = 64;  // that is told
constexpr std::size_t longestLine = std::size_t{1} << 20U, chunkSize = std::size_t{64} << 10U;

std::string escaped(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    constexpr unsigned char firstPlain = 0x20, deletion = 0x7f;
    std::string result;
    for (const char c : text) {
        const auto octet = static_cast<unsigned char>(c);
        if (octet >= firstPlain && octet != deletion && c != '\\') {
            result += c;
        } else {
            result += {'\\', 'x', digits[octet / 16], digits[octet % 16]};
        }
    }
    return result;
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = line.find('\t');
        fields.push_back(line.substr(0, end));
        if (end != std::string_view::npos) line.remove_prefix(end + 1);
    }
    return fields;
}

template <class Number>
bool read(std::string_view text, Number& number) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && stop == end;
}

std::optional<KeptEvent> entryFrom(std::string_view line) {
    constexpr std::size_t count = 8;
    const auto fields = fieldsOf(line);
    KeptEvent event;
    if (fields.size() != count || !read(fields[0], event.epoch) || !read(fields[1], event.number) ||
        !read(fields[2], event.cycle) || !read(fields[3], event.wallClock)) {
        return {};
    }
    const auto severity = severityFromName(fields[4]);
    const auto kind = eventKindFromName(fields[5]);
    const auto path = withoutEscapes(fields[6]), text = withoutEscapes(fields[7]);
    if (!severity || !kind || !path || !text) return {};
    event.severity = *severity;
    event.kind = *kind;
    event.path = *path;
    event.text = *text;
    return event;
}

// Whether it is such a line.
bool takeSince(std::string_view line, EventMemory::Times& since) {
    const auto fields = fieldsOf(line);
    std::int64_t time = 0;
    if (fields.size() != 3 || fields[0] != sinceMark || !read(fields[2], time)) return false;
    const auto kind = eventKindFromName(fields[1]);
    const auto* const found =
        kind ? std::ranges::find(EventMemory::kinds, *kind) : EventMemory::kinds.end();
    if (found == EventMemory::kinds.end()) return false;
    auto& known = since[static_cast<std::size_t>(found - EventMemory::kinds.begin())];
    known = std::max(known, time);
    return true;
}

// Lines of a file. Of one that is too long only the begin is kept, so that it cannot be read.
class Lines {
public:
    explicit Lines(int file) : file_{file} {}

    bool next(std::string& line) {
        line.clear();
        while (true) {
            if (at_ == size_ && !fill()) {
                torn_ = torn_ || !line.empty();
                return !line.empty();
            }
            const std::string_view rest{chunk_.data() + at_, size_ - at_};
            const std::size_t length = std::min(rest.find('\n'), rest.size());
            line += rest.substr(0, std::min(length, longestLine - line.size()));
            at_ += length;
            if (at_ == size_) continue;
            ++at_;
            return true;
        }
    }
    bool torn() const { return torn_; }
    std::size_t bytes() const { return bytes_; }

private:
    bool fill() {
        ssize_t size = 0;
        do {
            size = ::read(file_, chunk_.data(), chunk_.size());
        } while (size < 0 && errno == EINTR);
        at_ = 0;
        size_ = size > 0 ? static_cast<std::size_t>(size) : 0;
        bytes_ += size_;
        return size_ > 0;
    }

    int file_;
    std::vector<char> chunk_ = std::vector<char>(chunkSize);
    std::size_t at_ = 0, size_ = 0, bytes_ = 0;
    bool torn_ = false;
};

// Of lines that cannot be read: what stood there was at the latest at the time of the next entry.
class Loss {
public:
    void line() { open_ = true; }
    void entry(std::int64_t time) {
        newest_ = std::max(newest_, time);
        if (open_) until_ = newest_ == EventMemory::always ? newest_ : newest_ + 1;
        open_ = false;
    }
    std::int64_t until(std::int64_t begin) const { return open_ ? begin : until_; }

private:
    bool open_ = false;
    std::int64_t newest_ = MemoryRead::unsaid, until_ = MemoryRead::unsaid;
};

}  // namespace

std::string memoryHeader(const std::string& agent) {
    return std::string{markOfThis} + escaped(agent) + '\n';
}

std::string lineOf(const KeptEvent& event) {
    return std::to_string(event.epoch) + '\t' + std::to_string(event.number) + '\t' +
           std::to_string(event.cycle) + '\t' + std::to_string(event.wallClock) + '\t' +
           name(event.severity) + '\t' + name(event.kind) + '\t' + escaped(event.path) + '\t' +
           escaped(event.text) + '\n';
}

std::string endLine() { return std::string{endMark} + '\n'; }

std::string sinceLine(EventKind kind, std::int64_t since) {
    return std::string{sinceMark} + '\t' + name(kind) + '\t' + std::to_string(since) + '\n';
}

std::string otherThanMemory(const std::filesystem::path& file, std::string_view firstLine,
                            const std::string& agent) {
    const std::string header = memoryHeader(agent);
    if (firstLine == std::string_view{header}.substr(0, header.size() - 1)) return "";
    const std::string rest = ", and would be written over: name another file, or move it away";
    if (firstLine.starts_with(markOfThis)) {
        return file.string() + " is what the agent " +
               printable(firstLine.substr(markOfThis.size(), longestName)) + " remembers" + rest;
    }
    return file.string() +
           (firstLine.starts_with(mark) ? " is of another version of cortex-agent"
                                        : " is no file of what an agent remembers") +
           rest;
}

std::string firstLineOf(const OpenFile& file) {
    std::string line;
    if (file) Lines{file.number()}.next(line);
    return line;
}

MemoryRead readMemory(const OpenFile& file, std::int64_t begin,
                      const std::function<void(KeptEvent)>& take) {
    MemoryRead result;
    result.since.fill(MemoryRead::unsaid);
    Lines lines{file.number()};
    Loss loss;
    std::string line;
    lines.next(line);  // the header
    while (lines.next(line)) {
        if (lines.torn()) break;
        result.ended = line == endMark;
        if (result.ended) continue;
        if (auto event = entryFrom(line)) {
            result.epoch = event->epoch;
            loss.entry(event->wallClock);
            take(std::move(*event));
        } else if (!takeSince(line, result.since)) {
            loss.line();
            ++result.unreadable;
        }
    }
    result.torn = lines.torn();
    result.bytes = lines.bytes();
    for (std::int64_t& each : result.since) each = std::max(each, loss.until(begin));
    return result;
}

}  // namespace cortex::toolkit
